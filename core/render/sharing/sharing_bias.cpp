// SPDX-License-Identifier: BSD-2-Clause
// SharingBias: checks single pixels, and averages them over the picture.
#include "core/render/sharing/sharing_bias.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace exphoton {
namespace {

constexpr int kBlock = 16;  // pixels

// Returns whether this is the checked pixel of its square of 2 x 2 pixels: the first and the last
// pixel of a square by turns, like the fields of a chessboard, so that no row or column of pixels
// is left out.
bool IsChecked(Point2i pixel) {
  const int corner = ((pixel.x >> 1) + (pixel.y >> 1)) & 1;
  return (pixel.x & 1) == corner && (pixel.y & 1) == corner;
}

// The weight of a fragment's light in its pixel. Parts of a divided sample count as parts.
std::vector<Spectrum> WeightsOf(const GatherFragments::Pixel& gathered, double samples) {
  std::vector<Spectrum> weights(gathered.fragments.size());
  for (const GatherSample& sample : gathered.samples)
    weights[sample.fragment] += sample.weight * Real(double(sample.sampleWeight) / samples);
  return weights;
}

bool HasRecords(const GatherFragments::Pixel& pixel, int group) {
  return std::any_of(pixel.fragments.begin(), pixel.fragments.end(),
                     [&](const GatherFragment& fragment) { return fragment.HasGroup(group); });
}

double RelativeProduct(const CheckedPixel& checked, std::size_t direction, const Film& film) {
  const auto mean = film.MeanOf(checked.pixel);
  double sum = 0;
  for (std::size_t c = 0; c < Spectrum::kChannels; ++c)
    sum += checked.products[direction][c] / (mean[c] * mean[c] + .01);
  return sum / Spectrum::kChannels;
}

double CheckedPixelsIn(const PixelBounds& crop) {
  int count = 0;
  for (int y = crop.y0; y < crop.y1; ++y)
    for (int x = crop.x0; x < crop.x1; ++x) count += IsChecked({x, y});
  return count;
}

// Estimates the bias from the products of one direction. Pixels without gathers have no bias.
std::optional<SharingBias> EstimateAlong(std::size_t direction,
                                         const std::vector<CheckedPixel>& checked,
                                         const Film& film) {
  std::map<std::pair<int, int>, double> blocks;
  double pixels = CheckedPixelsIn(film.Crop());
  for (const CheckedPixel& pixel : checked) {
    if (!film.Crop().Contains(pixel.pixel.x, pixel.pixel.y)) continue;
    if (const double product = RelativeProduct(pixel, direction, film); !std::isnan(product))
      blocks[{pixel.pixel.y / kBlock, pixel.pixel.x / kBlock}] += product;
    else
      --pixels;  // its bias is not known
  }
  if (blocks.size() < 2) return std::nullopt;
  const auto count = double(blocks.size());
  double sum = 0, squares = 0;
  for (const auto& [block, product] : blocks) sum += product;
  for (const auto& [block, product] : blocks)
    squares += (product - sum / count) * (product - sum / count);
  return SharingBias{sum / pixels, std::sqrt(squares * count / (count - 1)) / pixels};
}

}  // namespace

PixelCheck::PixelCheck(const GatherFragments::Pixel& gathered, double samples)
    : weights_(WeightsOf(gathered, samples)) {}

void PixelCheck::Add(std::size_t fragment, const Spectrum& difference) {
  if (!sum_) sum_.emplace();
  *sum_ += weights_[fragment] * difference;
}

std::optional<int> SharingChecker::GroupOf(const GatherFragments& gathers, Point2i pixel,
                                           const PixelBounds& window) {
  if (!window.Contains(pixel.x, pixel.y)) return std::nullopt;
  if (IsChecked(pixel)) return kCheckingGroups[0];
  for (const Point2i checked : {Point2i{pixel.x - 1, pixel.y}, Point2i{pixel.x, pixel.y - 1}})
    if (window.Contains(checked.x, checked.y) && IsChecked(checked) &&
        HasRecords(gathers.At(checked), kCheckingGroups[0]))
      return kCheckingGroups[1];
  return std::nullopt;
}

std::optional<CheckedPixel> SharingChecker::Check(Point2i pixel, const PixelDifferences* known,
                                                  FitNeighbours* scratch) const {
  if (!IsChecked(pixel)) return std::nullopt;
  const auto difference = [&](Point2i at, int group) {
    return known && known->Window().Contains(at.x, at.y) ? known->At(at)
                                                         : Difference(at, group, scratch);
  };
  const auto own = difference(pixel, kCheckingGroups[0]);
  if (!own) return std::nullopt;
  const auto neighbour = [&](int x, int y) {
    return gathers_.Bounds().Contains(x, y) ? difference({x, y}, kCheckingGroups[1]) : std::nullopt;
  };
  const auto right = neighbour(pixel.x + 1, pixel.y), below = neighbour(pixel.x, pixel.y + 1);
  CheckedPixel checked{pixel, {}};
  if (!right && !below) {
    for (auto& products : checked.products) products.fill(std::nan(""));
    return checked;
  }
  // A neighbour that is missing counts as the other one.
  const std::array<const Spectrum*, 2> others{right ? &*right : &*below, below ? &*below : &*right};
  for (std::size_t i = 0; i < others.size(); ++i)
    for (int c = 0; c < Spectrum::kChannels; ++c)
      checked.products[i][std::size_t(c)] = double((*own)[c]) * double((*others[i])[c]);
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
  PixelCheck check(gathered, samples_);
  for (std::size_t i = 0; i < gathered.fragments.size(); ++i) {
    const GatherFragment& fragment = gathered.fragments[i];
    if (!fragment.HasGroup(group)) continue;
    const WindowFit fit(rows_, choice_.Windows(), {pixel, fragment}, scratch);
    const Spectrum difference = fit.Difference(group);
    check.Add(i, difference * choice_.ShareOf(pixel, fit.Target(), fit.Window(), scratch));
  }
  return check.Difference();
}

std::optional<SharingBias> EstimateSharingBias(const std::vector<CheckedPixel>& checked,
                                               const Film& film) {
  const auto rows = EstimateAlong(0, checked, film), columns = EstimateAlong(1, checked, film);
  return rows && columns->squared > rows->squared ? columns : rows;
}

}  // namespace exphoton
