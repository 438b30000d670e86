// SPDX-License-Identifier: BSD-2-Clause
// PassNoise: the variance between groups, relative to its squared radiance.
#include "core/imaging/film/pass_noise.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/files/byte_archive.h"
#include "core/imaging/film/local_square.h"
#include "core/imaging/metrics/metrics.h"

namespace exphoton {
namespace {

// Returns sum(w), bounded from below for division. Filters with negative lobes can make it small by
// chance.
double SafeWeight(double weight, double samples) { return std::max(weight, .5 * samples); }

// Sums of values over square cells of pixels.
class VarianceCells {
 public:
  VarianceCells(const std::vector<double>& values, std::size_t width)
      : columns_((width + kWidth - 1) / kWidth) {
    for (std::size_t i = 0; i < values.size(); ++i) {
      const std::size_t cell = i / width / kWidth * columns_ + i % width / kWidth;
      if (cell >= sums_.size()) sums_.resize((cell / columns_ + 1) * columns_, 0.);
      sums_[cell] += values[i];
    }
  }

  std::size_t Count() const { return sums_.size(); }
  double Sum() const { return std::accumulate(sums_.begin(), sums_.end(), 0.); }
  double Squares() const {
    double squares = 0;
    for (const double sum : sums_) squares += sum * sum;
    return squares;
  }
  // Returns the sum over all cells of half the squared difference from a neighbour, as far as it
  // can be known from all pairs of neighbours; infinity without pairs.
  double Differences() const {
    double squares = 0;
    std::size_t pairs = 0;
    const auto add = [&](double a, double b) { squares += (a - b) * (a - b) / 2, ++pairs; };
    for (std::size_t i = 0; i < sums_.size(); ++i) {
      if (i % columns_ + 1 < columns_) add(sums_[i], sums_[i + 1]);
      if (i + columns_ < sums_.size()) add(sums_[i], sums_[i + columns_]);
    }
    return pairs > 0 ? squares * double(sums_.size()) / double(pairs)
                     : std::numeric_limits<double>::infinity();
  }

 private:
  static constexpr std::size_t kWidth = 8;  // pixels

  std::size_t columns_;
  std::vector<double> sums_;
};

}  // namespace

PassNoise::PassNoise(const PixelBounds& crop, int groups)
    : width_(std::size_t(crop.Width())),
      pixelCount_(std::size_t(crop.Width()) * std::size_t(crop.Height())),
      sums_(std::size_t(groups)),
      samples_(std::size_t(groups), 0) {}

void PassNoise::Add(int group, const Film& pass, std::int64_t samplesPerPixel) {
  std::vector<Sums>& sums = sums_[std::size_t(group)];
  sums.resize(pixelCount_);
  for (std::size_t i = 0; i < pixelCount_; ++i) {
    const Film::Sums from = pass.SumsOf(i);
    Sums& to = sums[i];
    to.rgb[0] += float(from.r);
    to.rgb[1] += float(from.g);
    to.rgb[2] += float(from.b);
    to.weight += float(from.weight);
  }
  samples_[std::size_t(group)] += samplesPerPixel;
  levels_.clear();
}

void PassNoise::Join() {
  const std::vector<Group> groups = Groups();
  for (std::size_t i = 0; i < pixelCount_ && !groups.empty(); ++i) {
    const Sums total = TotalOf(groups, i);
    for (std::vector<Sums>& group : sums_)
      if (!group.empty()) group[i] = Sums();
    sums_[0][i] = total;
  }
  samples_[0] = std::int64_t(SampleCount());
  std::fill(samples_.begin() + 1, samples_.end(), 0);
  levels_.clear();
}

void PassNoise::Transfer(ByteArchive* archive) {
  archive->Same(std::uint64_t(pixelCount_));
  archive->Same(std::uint64_t(sums_.size()));
  for (std::int64_t& samples : samples_) archive->Values(&samples);
  for (std::vector<Sums>& group : sums_) {
    const std::size_t count = archive->Count(group.size(), sizeof(Sums));
    if (count != 0 && count != pixelCount_) throw ArchiveError("a group has other pixels");
    group.resize(count);
    for (Sums& sums : group)
      archive->Values(&sums.rgb[0], &sums.rgb[1], &sums.rgb[2], &sums.weight);
  }
  for (std::size_t g = 0; g < sums_.size(); ++g)
    if (samples_[g] < 0 || (samples_[g] > 0 && sums_[g].empty()))
      throw ArchiveError("a group has no pixels");
  levels_.clear();
}

double PassNoise::SampleCount() const {
  double total = 0;
  for (const std::int64_t count : samples_) total += double(count);
  return total;
}

std::vector<PassNoise::Group> PassNoise::Groups() const {
  const double total = SampleCount();
  std::vector<Group> groups;
  for (std::size_t g = 0; g < sums_.size(); ++g)
    if (samples_[g] > 0) groups.push_back({sums_[g].data(), double(samples_[g]) / total});
  return groups;
}

PassNoise::Sums PassNoise::TotalOf(const std::vector<Group>& groups, std::size_t pixel) const {
  Sums total;
  for (const Group& group : groups) {
    for (int c = 0; c < 3; ++c) total.rgb[c] += group.pixels[pixel].rgb[c];
    total.weight += group.pixels[pixel].weight;
  }
  return total;
}

double PassNoise::RelativeVariance() const {
  if (Groups().size() < 2) return std::numeric_limits<double>::infinity();
  double sum = 0;
  for (const double variance : RelativeVariances()) sum += variance;
  return sum / double(pixelCount_);
}

// Neighbouring pixels share photons and gathers, so their terms are added up in cells. Two
// estimates of the variance of the sum S of a cell are too large in the mean, and the smaller one
// is taken:
// - If all pixels of a cell had the same normal error, K groups would give a variance of S whose
//   unbiased estimate is 2 S^2 / (K + 1). For groups of different sizes, K is 1 / (sum of the
//   squared shares).
// - Half the squared difference of neighbouring cells contains their variance, and the difference
//   of their true noise.
double PassNoise::RelativeVarianceError() const {
  const std::vector<Group> groups = Groups();
  if (groups.size() < 2) return std::numeric_limits<double>::infinity();
  double squaredShares = 0;
  for (const Group& group : groups) squaredShares += group.share * group.share;
  const VarianceCells cells(RelativeVariances(), width_);
  const double common = 2 * cells.Squares() / (1 / squaredShares + 1);
  return std::sqrt(std::min(common, cells.Differences())) / double(pixelCount_);
}

// If all pixels of a cell have the same normal error, the variance of the cell's estimate is 2 /
// degrees, relative to the square of its expected value. K groups of equal size have K - 1 degrees.
double PassNoise::DegreesOfCell(const std::vector<Group>& groups) {
  double shares = 0, sum = 0, squares = 0;
  for (const Group& group : groups) {
    const double term = group.share * group.share / (1 - group.share);
    shares += group.share * group.share;
    sum += term, squares += term * term;
  }
  return 1 / (shares + sum * sum - squares);
}

// If only group g sees light in a pixel, Variances gives the mean's square times
//   V_g = (1 - w_g)^2 / (1 - s_g) + sum over the other groups j of w_j^2 / (1 - s_j).
// w_j is the group's part of the pixel's weight, and s_j its share of the samples.
std::vector<float> PassNoise::DeviationsOfOneGroup() const {
  const std::vector<Group> groups = Groups();
  if (groups.size() < 2) return {};  // there are no variances
  const double samples = SampleCount();
  std::vector<float> deviations(pixelCount_);
  std::vector<double> parts(groups.size());
  for (std::size_t i = 0; i < pixelCount_; ++i) {
    const double weight = SafeWeight(double(TotalOf(groups, i).weight), samples);
    for (std::size_t g = 0; g < groups.size(); ++g)
      parts[g] = double(groups[g].pixels[i].weight) / weight;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t g = 0; g < groups.size(); ++g) {
      double variance = 0;
      for (std::size_t j = 0; j < groups.size(); ++j) {
        const double distance = j == g ? 1 - parts[j] : parts[j];
        variance += distance * distance / (1 - groups[j].share);
      }
      least = std::min(least, variance);
    }
    deviations[i] = float(1 / std::sqrt(least));
  }
  return deviations;
}

// The degrees of a sum of independent estimates are 2 m^2 / v for the expected value m and the
// variance v of the sum (Satterthwaite 1946, "An Approximate Distribution of Estimates of Variance
// Components"). The square of the sum has the expected value m^2 + v. The estimates of v are those
// of RelativeVarianceError. Differences of few cells are too uncertain: they may be nearly 0 by
// chance.
double PassNoise::RelativeVarianceFreedom() const {
  constexpr std::size_t kManyCells = 32;
  constexpr double kMost = 1e9;
  const double ofCell = DegreesOfCell(Groups());
  const VarianceCells cells(RelativeVariances(), width_);
  double variance = 2 * cells.Squares() / (ofCell + 2);
  if (cells.Count() >= kManyCells) variance = std::min(variance, cells.Differences());
  const double sum = cells.Sum(), least = 2 * sum * sum / kMost;
  if (!(variance > least)) return sum > 0 ? kMost : ofCell;
  return std::max(2 * sum * sum / variance - 2, ofCell);
}

std::vector<double> PassNoise::RelativeVariances() const {
  const std::vector<float> variances = Variances();
  const std::vector<double>& squares = Levels();
  std::vector<double> relative(pixelCount_);
  for (std::size_t i = 0; i < variances.size(); ++i) {
    relative[i / 3] += double(variances[i]) / (3 * (squares[i] + kRelMseOffset));
  }
  return relative;
}

const std::vector<double>& PassNoise::Levels() const {
  if (levelsFrom_) return levelsFrom_->Levels();
  if (levels_.empty())
    levels_ = SquaredLevels(Means(), Variances(), width_, DeviationsOfOneGroup());
  return levels_;
}

std::vector<float> PassNoise::Means() const {
  const std::vector<Group> groups = Groups();
  std::vector<float> means(3 * pixelCount_);
  const double samples = SampleCount();
  for (std::size_t i = 0; i < pixelCount_; ++i) {
    const Sums total = TotalOf(groups, i);
    const double weight = SafeWeight(double(total.weight), samples);
    for (std::size_t c = 0; c < 3; ++c)
      means[3 * i + c] = float(std::max(0., double(total.rgb[c]) / weight));
  }
  return means;
}

std::vector<double> PassNoise::MeansOf(const std::vector<int>& groups) const {
  double samples = 0;
  std::vector<Group> chosen;
  for (const int group : groups) {
    chosen.push_back({sums_[std::size_t(group)].data(), 0});
    samples += double(SamplesOf(group));
  }
  std::vector<double> means(3 * pixelCount_);
  for (std::size_t i = 0; i < pixelCount_; ++i) {
    const Sums total = TotalOf(chosen, i);
    for (std::size_t c = 0; c < 3; ++c)
      means[3 * i + c] = double(total.rgb[c]) / SafeWeight(double(total.weight), samples);
  }
  return means;
}

std::vector<float> PassNoise::Variances() const {
  const std::vector<Group> groups = Groups();
  std::vector<float> variances(3 * pixelCount_);
  if (groups.size() < 2) return variances;
  const double samples = SampleCount();
  for (std::size_t i = 0; i < pixelCount_; ++i) {
    const Sums total = TotalOf(groups, i);
    const double weight = SafeWeight(double(total.weight), samples);
    for (std::size_t c = 0; c < 3; ++c) {
      const double mean = double(total.rgb[c]) / weight;
      double sum = 0;
      for (const Group& group : groups) {
        const Sums& own = group.pixels[i];
        const double distance = (double(own.rgb[c]) - mean * double(own.weight)) / weight;
        sum += distance * distance / (1 - group.share);
      }
      variances[3 * i + c] = float(sum);
    }
  }
  return variances;
}

}  // namespace exphoton
