// SPDX-License-Identifier: BSD-2-Clause
// Pictures are divided by sqrt(r^2 + 0.01), and averaged over blocks. The inner product of two such
// pictures is then the mean over values of a product of relative errors.
#include "core/app/budget/error_budget.h"

#include <algorithm>
#include <cmath>

#include "core/imaging/metrics/metrics.h"

namespace exphoton::cli {
namespace {

constexpr int kMostBlockWidth = 16;
constexpr double kWantedPrecision = .1;  // of the squared bias, relative to the error

// Maps pictures to relative block means.
class Blocks {
 public:
  Blocks(const BudgetFrame& frame, int blockWidth)
      : levels_(frame.levels),
        width_(std::size_t(frame.width)),
        block_(std::size_t(blockWidth)),
        columns_((width_ + block_ - 1) / block_),
        counts_(3 * columns_ * ((Height() + block_ - 1) / block_)) {
    for (std::size_t i = 0; i < levels_.size(); ++i) ++counts_[BlockOf(i)];
  }

  // The squared length of the result is the mean over values of the squared block mean.
  PictureValues Means(const PictureValues& values) const {
    PictureValues means(counts_.size());
    for (std::size_t i = 0; i < values.size(); ++i)
      means[BlockOf(i)] += values[i] * std::sqrt(RelMseWeightOfLevel(levels_[i]));
    for (std::size_t k = 0; k < means.size(); ++k)
      if (counts_[k] > 0) means[k] /= std::sqrt(counts_[k] * double(levels_.size()));
    return means;
  }
  double Count() const { return double(counts_.size()) / 3; }

 private:
  static double RelMseWeightOfLevel(double level) { return 1 / (level + kRelMseOffset); }
  std::size_t Height() const { return levels_.size() / 3 / width_; }
  std::size_t BlockOf(std::size_t value) const {
    const std::size_t pixel = value / 3, x = pixel % width_, y = pixel / width_;
    return 3 * (y / block_ * columns_ + x / block_) + value % 3;
  }

  const std::vector<double>& levels_;
  std::size_t width_, block_, columns_;
  std::vector<double> counts_;  // values of each block and channel
};

PictureValues Difference(const PictureValues& a, const PictureValues& b) {
  PictureValues difference(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) difference[i] = a[i] - b[i];
  return difference;
}

// The noise of the pairs of pictures with the same photons.
class PairNoise {
 public:
  PairNoise(const std::vector<SeedErrors>& seeds, const Blocks& pixels,
            std::array<PictureValues, 2> SeedErrors::*pair) {
    std::vector<PictureValues> first, second, differences;
    for (const SeedErrors& seed : seeds) {
      first.push_back(pixels.Means((seed.*pair)[0]));
      second.push_back(pixels.Means((seed.*pair)[1]));
      differences.push_back(Difference(first.back(), second.back()));
    }
    products_.emplace_back(first, second);
    products_.emplace_back(differences, differences);
  }

  // The variance between pictures with the same photons.
  double Within(std::span<const std::size_t> kept) const {
    return products_[1].OfSameSeed(kept) / 2;
  }
  // The covariance of pictures with the same photons.
  double Common(std::span<const std::size_t> kept) const {
    return products_[0].OfSameSeed(kept) - products_[0].OfOtherSeeds(kept);
  }

 private:
  std::vector<PairProducts> products_;
};

// The products of the biases in blocks.
class BiasProducts {
 public:
  BiasProducts(const std::vector<SeedErrors>& seeds, const BudgetFrame& frame, int blockWidth) {
    const Blocks blocks(frame, blockWidth);
    std::vector<std::vector<PictureValues>> biases(frame.biasCauses.size());
    std::vector<PictureValues> sums;
    for (const SeedErrors& seed : seeds) {
      PictureValues sum(blocks.Means(PictureValues(frame.levels.size())));
      for (std::size_t i = 0; i < biases.size(); ++i) {
        biases[i].push_back(blocks.Means(seed.biases[i]));
        std::transform(sum.begin(), sum.end(), biases[i].back().begin(), sum.begin(),
                       std::plus<>());
      }
      sums.push_back(std::move(sum));
    }
    for (const std::vector<PictureValues>& bias : biases) {
      withSum_.emplace_back(bias, sums);
      squares_.emplace_back(bias, bias);
    }
  }

  double Share(std::size_t i, std::span<const std::size_t> kept) const {
    return withSum_[i].OfOtherSeeds(kept);
  }
  double Squared(std::size_t i, std::span<const std::size_t> kept) const {
    return squares_[i].OfOtherSeeds(kept);
  }
  double Sum(std::span<const std::size_t> kept) const {
    double sum = 0;
    for (std::size_t i = 0; i < withSum_.size(); ++i) sum += Share(i, kept);
    return sum;
  }

 private:
  std::vector<PairProducts> withSum_, squares_;
};

// The numbers from which a budget is made.
class BudgetStatistics {
 public:
  BudgetStatistics(const std::vector<SeedErrors>& seeds, const BudgetFrame& frame, int blockWidth)
      : frame_(frame),
        pixels_(frame, 1),
        noise_(seeds, pixels_, &SeedErrors::pictures),
        bias_(seeds, frame, blockWidth) {
    if (!seeds.front().withMoreRays[0].empty())
      withMoreRays_.emplace_back(seeds, pixels_, &SeedErrors::withMoreRays);
  }

  // Returns the noise parts, share and square of each bias, and the sums.
  std::vector<double> Compute(std::span<const std::size_t> kept) const {
    const double photons = noise_.Common(kept), within = noise_.Within(kept);
    double gather = 0;
    if (!withMoreRays_.empty())
      gather =
          (within - withMoreRays_.front().Within(kept)) * frame_.rayFactor / (frame_.rayFactor - 1);
    std::vector<double> values{within - gather, gather, photons};
    for (std::size_t i = 0; i < frame_.biasCauses.size(); ++i) {
      values.push_back(bias_.Share(i, kept));
      values.push_back(bias_.Squared(i, kept));
    }
    const double noise = photons + within, bias = bias_.Sum(kept);
    values.insert(values.end(), {noise, bias, noise + bias});
    return values;
  }

 private:
  const BudgetFrame& frame_;
  Blocks pixels_;
  PairNoise noise_;
  BiasProducts bias_;
  std::vector<PairNoise> withMoreRays_;  // at most one
};

ErrorBudget BudgetInBlocks(const std::vector<SeedErrors>& seeds, const BudgetFrame& frame,
                           int blockWidth) {
  const BudgetStatistics statistics(seeds, frame, blockWidth);
  const std::vector<study::Measured> values =
      Jackknife(seeds.size(), [&](auto kept) { return statistics.Compute(kept); });
  ErrorBudget budget;
  budget.blockWidth = blockWidth;
  constexpr std::array kNoise{ErrorCause::CameraSampling, ErrorCause::GatherDirections,
                              ErrorCause::PhotonNoise};
  const bool hasRays = !seeds.front().withMoreRays[0].empty();
  for (std::size_t i = 0; i < kNoise.size(); ++i)
    if (hasRays || kNoise[i] != ErrorCause::GatherDirections)
      budget.parts.push_back({kNoise[i], values[i], {}});
  std::size_t at = kNoise.size();
  for (const ErrorCause cause : frame.biasCauses) {
    budget.parts.push_back({cause, values[at], values[at + 1]});
    at += 2;
  }
  std::stable_sort(budget.parts.begin(), budget.parts.end(),
                   [](const ErrorPart& a, const ErrorPart& b) { return a.cause < b.cause; });
  budget.noise = values[at], budget.bias = values[at + 1], budget.sum = values[at + 2];
  return budget;
}

// The variance of <bias, bias> by the noise of the reference. The noise of a block is assumed to be
// the same everywhere.
double ReferenceVariance(const PictureValues& halfDifference, double bias, const Blocks& blocks) {
  double noise = 0;  // of a block, relative; halfDifference is (a - b) / 2 in blocks
  for (const double value : halfDifference) noise += value * value;
  return (2 * noise * noise + 4 * noise * std::max(bias, 0.)) / blocks.Count();
}

}  // namespace

const char* ErrorCauseName(ErrorCause cause) {
  switch (cause) {
    case ErrorCause::CameraSampling:
      return "camera sampling";
    case ErrorCause::GatherDirections:
      return "gather directions";
    case ErrorCause::PhotonNoise:
      return "photon noise";
    case ErrorCause::Blur:
      return "blur of the maps";
    case ErrorCause::CausticKernel:
      return "caustic kernel";
    case ErrorCause::Sharing:
      return "sharing";
    case ErrorCause::DepthLimits:
      return "depth limits";
    case ErrorCause::SkippedEffects:
      return "skipped effects";
  }
  return "";
}

ErrorBudget MakeBudget(const std::vector<SeedErrors>& seeds, const BudgetFrame& frame,
                       int blockWidth) {
  if (blockWidth > 0) return BudgetInBlocks(seeds, frame, blockWidth);
  ErrorBudget best;
  for (int width = 1; width <= kMostBlockWidth; width *= 2) {
    ErrorBudget budget = BudgetInBlocks(seeds, frame, width);
    const double error = budget.noise.value + std::max(budget.bias.value, 0.);
    const bool isFine = budget.bias.error <= kWantedPrecision * error;
    if (width == 1 || isFine || budget.bias.error < best.bias.error) best = std::move(budget);
    if (isFine) break;
  }
  return best;
}

MeasuredError MeasureError(const std::vector<PictureValues>& pictures,
                           const std::array<PictureValues, 2>& reference, const BudgetFrame& frame,
                           int blockWidth) {
  const Blocks pixels(frame, 1), blocks(frame, blockWidth);
  std::vector<PictureValues> scaled;
  std::array<std::vector<PictureValues>, 2> ofPixels, ofBlocks;  // errors against each half
  for (const PictureValues& picture : pictures) {
    scaled.push_back(pixels.Means(picture));
    for (std::size_t half = 0; half < 2; ++half) {
      const PictureValues error = Difference(picture, reference[half]);
      ofPixels[half].push_back(pixels.Means(error));
      ofBlocks[half].push_back(blocks.Means(error));
    }
  }
  const PairProducts noise(scaled, scaled), ofPixel(ofPixels[0], ofPixels[1]),
      ofBlock(ofBlocks[0], ofBlocks[1]);
  const std::vector<study::Measured> values = Jackknife(pictures.size(), [&](auto kept) {
    const double variance = noise.OfSameSeed(kept) - noise.OfOtherSeeds(kept);
    const double bias = ofBlock.OfOtherSeeds(kept);
    return std::vector{variance, bias, variance + bias, ofPixel.OfOtherSeeds(kept) - bias};
  });
  MeasuredError measured{values[0], values[1], values[2], values[3]};
  PictureValues half = Difference(reference[0], reference[1]);
  for (double& value : half) value /= 2;
  const double ofReference = ReferenceVariance(blocks.Means(half), measured.bias.value, blocks);
  for (study::Measured* with : {&measured.bias, &measured.sum})
    with->error = std::sqrt(with->error * with->error + ofReference);
  return measured;
}

study::Measured NoiseBetween(const std::vector<PictureValues>& pictures, const BudgetFrame& frame) {
  const Blocks pixels(frame, 1);
  std::vector<PictureValues> scaled;
  for (const PictureValues& picture : pictures) scaled.push_back(pixels.Means(picture));
  const PairProducts products(scaled, scaled);
  return Jackknife(pictures.size(),
                   [&](auto kept) {
                     return std::vector{products.OfSameSeed(kept) - products.OfOtherSeeds(kept)};
                   })
      .front();
}

double HalvingFactor(const ErrorPart& part) {
  const double squared = part.squared.value, others = part.share.value - squared;
  if (!(part.share.value > 0) || !(squared > 0)) return 0;
  // The factor t solves t^2 squared + t others = (squared + others) / 2.
  return (std::sqrt(others * others + 2 * squared * part.share.value) - others) / (2 * squared);
}

}  // namespace exphoton::cli
