// SPDX-License-Identifier: BSD-2-Clause
// The estimator: each group's distance from the mean of all, and denominators that do not know it.
#include "core/imaging/pass_noise.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace exphoton {
namespace {

constexpr double kRelMseOffset = 0.01;  // as in metrics.cpp

// sum(w) where it may be divided by. Filters with negative lobes can make it small by chance.
double SafeWeight(double weight, double samples) { return std::max(weight, .5 * samples); }

}  // namespace

PassNoise::PassNoise(const PixelBounds& crop, int groups)
    : pixelCount_(std::size_t(crop.Width()) * std::size_t(crop.Height())),
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
}

int PassNoise::SmallestGroup() const {
  return int(std::min_element(samples_.begin(), samples_.end()) - samples_.begin());
}

std::vector<PassNoise::Group> PassNoise::Groups() const {
  double total = 0;
  for (const std::int64_t count : samples_) total += double(count);
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
  const std::vector<Group> groups = Groups();
  if (groups.size() < 2) return std::numeric_limits<double>::infinity();
  double samples = 0, sum = 0;
  for (const std::int64_t count : samples_) samples += double(count);
  for (std::size_t i = 0; i < pixelCount_; ++i) {
    const Sums total = TotalOf(groups, i);
    const double weight = SafeWeight(double(total.weight), samples);
    for (int c = 0; c < 3; ++c) {
      const double mean = double(total.rgb[c]) / weight;
      for (const Group& group : groups) {
        const Sums& own = group.pixels[i];
        const double distance = (double(own.rgb[c]) - mean * double(own.weight)) / weight;
        // The picture without this group: its error is independent of the group's.
        const double rest =
            std::max(0., double(total.rgb[c] - own.rgb[c])) /
            SafeWeight(double(total.weight - own.weight), samples * (1 - group.share));
        sum += distance * distance / ((1 - group.share) * (rest * rest + kRelMseOffset));
      }
    }
  }
  return sum / (3 * double(pixelCount_));
}

std::vector<float> PassNoise::Variances() const {
  const std::vector<Group> groups = Groups();
  std::vector<float> variances(3 * pixelCount_);
  if (groups.size() < 2) return variances;
  double samples = 0;
  for (const std::int64_t count : samples_) samples += double(count);
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
