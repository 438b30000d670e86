// SPDX-License-Identifier: BSD-2-Clause
// SharingBias: checks single pixels, and averages them over the picture.
#include "core/render/sharing/sharing_bias.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace exphoton {
namespace {

constexpr int kStride = 2;  // pixels between checks, along rows and columns
constexpr int kBlock = 16;  // pixels

// The weight of a fragment's light in its pixel. Parts of a divided sample count as parts.
std::vector<Spectrum> WeightsOf(const GatherFragments::Pixel& gathered, double samples) {
  std::vector<Spectrum> weights(gathered.fragments.size());
  for (const GatherSample& sample : gathered.samples)
    weights[sample.fragment] += sample.weight * Real(double(sample.sampleWeight) / samples);
  return weights;
}

double RelativeProduct(const CheckedPixel& checked, const Film& film) {
  const auto mean = film.MeanOf(checked.pixel);
  double sum = 0;
  for (int c = 0; c < Spectrum::kChannels; ++c)
    sum += checked.product[std::size_t(c)] / (mean[std::size_t(c)] * mean[std::size_t(c)] + .01);
  return sum / Spectrum::kChannels;
}

}  // namespace

std::optional<CheckedPixel> SharingChecker::Check(Point2i pixel, FitNeighbours* scratch) const {
  const Point2i next{pixel.x + 1, pixel.y};
  if (pixel.x % kStride != 0 || pixel.y % kStride != 0) return std::nullopt;
  if (!gathers_.Bounds().Contains(next.x, next.y)) return std::nullopt;
  const auto a = Difference(pixel, kCheckingGroups[0], scratch);
  if (!a) return std::nullopt;
  const auto b = Difference(next, kCheckingGroups[1], scratch);
  if (!b) return std::nullopt;
  CheckedPixel checked{pixel, {}};
  for (int c = 0; c < Spectrum::kChannels; ++c)
    checked.product[std::size_t(c)] = double((*a)[c]) * double((*b)[c]);
  return checked;
}

Spectrum SharingChecker::Bias(Point2i pixel, FitNeighbours* scratch) const {
  // Each pixel has the samples of one checking group only.
  for (const int group : kCheckingGroups)
    if (const auto difference = Difference(pixel, group, scratch)) return *difference;
  return {};
}

std::optional<Spectrum> SharingChecker::Difference(Point2i pixel, int group,
                                                   FitNeighbours* scratch) const {
  const GatherFragments::Pixel& gathered = gathers_.At(pixel);
  const std::vector<Spectrum> weights = WeightsOf(gathered, samples_);
  const FragmentRows::Column set = FragmentRows::OfGroup(group);
  std::optional<Spectrum> sum;
  for (std::size_t i = 0; i < gathered.fragments.size(); ++i) {
    const GatherFragment& fragment = gathered.fragments[i];
    if (!fragment.HasGroup(group)) continue;
    if (!sum) sum.emplace();
    const SharingWindows::Window window = windows_.At(pixel, fragment);
    if (!(window.share > 0)) continue;
    LocalFit::Collect(rows_, {FitTarget(fragment), pixel, window.radius}, {&set, 1}, scratch);
    const Spectrum fitted = LocalFit(*scratch, window.radius, 0).AtTarget();
    *sum += weights[i] * (fitted - fragment.Mean(group)) * window.share;
  }
  return sum;
}

std::optional<SharingBias> EstimateSharingBias(const std::vector<CheckedPixel>& checked,
                                               const Film& film) {
  std::map<std::pair<int, int>, double> blocks;
  for (const CheckedPixel& pixel : checked)
    if (film.Crop().Contains(pixel.pixel.x, pixel.pixel.y))
      blocks[{pixel.pixel.y / kBlock, pixel.pixel.x / kBlock}] += RelativeProduct(pixel, film);
  if (blocks.size() < 2) return std::nullopt;
  const auto count = double(blocks.size());
  double sum = 0, squares = 0;
  for (const auto& [block, product] : blocks) sum += product;
  for (const auto& [block, product] : blocks)
    squares += (product - sum / count) * (product - sum / count);
  const auto pixels = double(checked.size());
  return SharingBias{sum / pixels, std::sqrt(squares * count / (count - 1)) / pixels};
}

}  // namespace exphoton
