// SPDX-License-Identifier: BSD-2-Clause
// Certificate: relative corrections of the groups, and the texts.
#include "core/render/certificate/certificate.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/format.h"
#include "core/imaging/metrics/metrics.h"

namespace exphoton {
namespace {

constexpr double kLeastWanted = .01 * .01;  // relMSE
// Few corrections are noisy, so they change the radiance of a block by this factor at most.
constexpr double kLeastFactor = .5;

double Part(const std::optional<SharingBias>& sharing) {
  return sharing ? std::max(sharing->squared, 0.) : 0;
}

// Returns how far a bound lies from the estimate, for two independent estimates that are added.
double Distance(double distance, const std::optional<SharingBias>& sharing, double quantile) {
  return std::hypot(distance, sharing ? quantile * sharing->standardError : 0);
}

// Returns the upper end of the squared bias where no gather ray was corrected. The gathers that
// need corrections, because their rays meet surfaces, are then an unknown share q of all gathers.
// None of them was chosen, which has the probability exp(-expected q). Their light may be as wrong
// as the picture is bright.
double UnseenBias(double expected, double quantile) {
  if (!(expected > 0)) return 0;
  return -std::log(std::erfc(quantile / std::numbers::sqrt2) / 2) / expected;
}

// Larger errors have no digits.
constexpr double kMostShown = 10;
// A bias of this size is as large as the picture.
constexpr double kSaysNothing = 1;

std::string Percent(double squared) {
  const double error = BlockBias::Root(squared), percent = 100 * error;
  if (!(error <= kMostShown)) return Format("over %.0f %%", 100 * kMostShown);
  return Format(percent < .995 ? "%.2f %%" : percent < 99.5 ? "%.1f %%" : "%.0f %%", percent);
}

std::string Digits(double squared) {
  std::string text = Percent(squared);
  return text.substr(0, text.find(" %"));
}

// The mean corrections of the groups: of each pixel, three channels.
class GroupMeans {
 public:
  explicit GroupMeans(const Corrections& corrections)
      : width_(corrections.Crop().Width()), height_(corrections.Crop().Height()) {
    const auto groups = corrections.Groups();
    double samples = 0;
    for (const auto* group : groups) samples += double(group->samplesPerPixel);
    for (const auto* group : groups) {
      std::vector<double>& means = groups_.emplace_back(corrections.SumsOf(*group));
      for (double& mean : means) mean /= double(group->samplesPerPixel);
      shares_.push_back(double(group->samplesPerPixel) / samples);
    }
  }

  // Returns an estimator of the bias relative to levels r^2.
  BlockBiasEstimator RelativeTo(std::span<const double> levels, double quantile) const {
    std::vector<std::vector<float>> relative;
    std::vector<BlockBiasEstimator::Group> inputs;
    for (const std::vector<double>& means : groups_) {
      std::vector<float>& values = relative.emplace_back(levels.size());
      for (std::size_t i = 0; i < levels.size(); ++i)
        values[i] = float(means[i] / std::sqrt(levels[i] + kRelMseOffset));
    }
    for (std::size_t g = 0; g < groups_.size(); ++g) inputs.push_back({relative[g], shares_[g]});
    return BlockBiasEstimator(width_, height_, inputs, quantile);
  }

  // Returns the levels of the true picture. Those of the picture contain its bias: a picture that
  // is 30 % too bright has a bias of 30 % of the truth, which is 23 % of the picture. In each block
  // and channel, the radiance is corrected by the factor that its mean corrections give.
  std::vector<double> TrueLevels(std::span<const double> levels, std::size_t blockWidth) const {
    const auto width = std::size_t(width_);
    const std::size_t columns = (width + blockWidth - 1) / blockWidth;
    const auto placeOf = [&](std::size_t i) {
      const std::size_t x = i / 3 % width, y = i / 3 / width;
      return 3 * (y / blockWidth * columns + x / blockWidth) + i % 3;
    };
    std::vector<Block> blocks(placeOf(levels.size() - 1) / 3 * 3 + 3);
    for (std::size_t i = 0; i < levels.size(); ++i) {
      Block& block = blocks[placeOf(i)];
      block.picture += std::sqrt(levels[i]);
      block.corrections.resize(groups_.size());
      for (std::size_t g = 0; g < groups_.size(); ++g)
        block.corrections[g] += shares_[g] * groups_[g][i];
    }
    std::vector<double> corrected(levels.begin(), levels.end());
    for (std::size_t i = 0; i < levels.size(); ++i) {
      const double factor = FactorOf(blocks[placeOf(i)]);
      corrected[i] *= factor * factor;
    }
    return corrected;
  }

 private:
  struct Block {  // sums over the pixels of a block, in one channel
    double picture = 0;
    std::vector<double> corrections;  // of the groups, times their shares
  };

  // Returns the true radiance of a block relative to the picture's. The part of the corrections
  // that groups do not agree on is noise: the product of two groups has their squared mean without
  // noise as its expected value, and divided by the squared mean with noise it is the part to keep.
  double FactorOf(const Block& block) const {
    double mean = 0, own = 0, pairs = 1;
    for (std::size_t g = 0; g < shares_.size(); ++g) {
      mean += block.corrections[g];
      own += block.corrections[g] * block.corrections[g];
      pairs -= shares_[g] * shares_[g];
    }
    if (!(block.picture > 0) || !(mean * mean > 0)) return 1;
    const double kept = std::clamp((mean * mean - own) / (pairs * mean * mean), 0., 1.);
    return std::clamp(1 + kept * mean / block.picture, kLeastFactor, 1 / kLeastFactor);
  }

  int width_, height_;
  std::vector<std::vector<double>> groups_;
  std::vector<double> shares_;
};

}  // namespace

double Certificate::Bias() const { return std::max(bias.squared, 0.) + Part(sharing); }

double Certificate::LowerBias() const {
  const double distance = std::max(bias.squared, 0.) - bias.lower;
  return std::max(Bias() - Distance(distance, sharing, quantile), 0.);
}

double Certificate::UpperBias() const {
  return Bias() + Distance(bias.upper - std::max(bias.squared, 0.), sharing, quantile);
}

CertificateGoal CertificateGoal::ForNoise(double noise) {
  return {.smallest = std::max(noise / 4, kLeastWanted)};
}

std::optional<Certificate> Certify(const Corrections& corrections, std::span<const double> levels,
                                   double noise, const CertificateGoal& goal) {
  if (corrections.Groups().size() < 2) return std::nullopt;
  const GroupMeans means(corrections);
  const BlockBias first = means.RelativeTo(levels, goal.quantile).EstimateFor(goal.smallest);
  const std::vector<double> trueLevels = means.TrueLevels(levels, std::size_t(first.blockWidth));
  Certificate certificate;
  certificate.noise = noise;
  certificate.bias = means.RelativeTo(trueLevels, goal.quantile).Estimate(first.blockWidth);
  certificate.corrections = corrections.Count();
  const double unseen =
      certificate.corrections > 0 ? 0 : UnseenBias(corrections.ExpectedCount(), goal.quantile);
  certificate.bias.upper += unseen, certificate.bias.smallest += unseen;
  certificate.quantile = goal.quantile;
  return certificate;
}

bool Certificate::SaysNothing() const {
  return !(LowerBias() > 0) && !(UpperBias() < kSaysNothing);
}

std::string ErrorText(const Certificate& certificate) {
  if (certificate.SaysNothing())
    return "error unknown: noise " + Percent(certificate.noise) +
           ", and the bias may be as large as the picture";
  return "error " + Percent(certificate.Error()) + " = noise " + Percent(certificate.noise) +
         ", bias " + Percent(certificate.Bias()) + " (" + Digits(certificate.LowerBias()) + " to " +
         Percent(certificate.UpperBias()) + ")";
}

// The advice where the interval says nothing.
constexpr const char* kAdvice =
    "these corrections say nothing about the bias; more samples, a larger picture or a larger "
    "--certify-share do";

std::vector<std::string> DetailTexts(const Certificate& certificate) {
  const BlockBias& bias = certificate.bias;
  std::vector<std::string> texts{
      Format("bias of %d block%s of %d x %d pixels, from %lld corrected gather rays", bias.blocks,
             bias.blocks == 1 ? "" : "s", bias.blockWidth, bias.blockWidth,
             static_cast<long long>(certificate.corrections)),
      certificate.SaysNothing()
          ? kAdvice
          : "the interval (95 %) cannot certify a bias below " + Percent(bias.smallest)};
  if (certificate.sharing)
    texts.push_back("the bias includes " + Percent(certificate.sharing->squared) +
                    " by shared gathers");
  std::string notCovered = "not covered: bias of both signs inside a block";
  for (const std::string& text : certificate.notCovered) notCovered += "; " + text;
  texts.push_back(notCovered);
  return texts;
}

}  // namespace exphoton
