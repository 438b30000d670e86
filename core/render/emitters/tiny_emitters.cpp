// SPDX-License-Identifier: BSD-2-Clause
#include "core/render/emitters/tiny_emitters.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

namespace exphoton {
namespace {

// Rays and boxes are rounded differently.
constexpr double kMargin = 1e-3;  // in pixels

// Returns the integral of an even filter over its support. The midpoints lie densely about the
// centre, where wide filters may have a narrow peak: x = width s^3.
Real IntegralOf(const Filter& filter) {
  constexpr int kSteps = 256;
  double sum = 0;
  for (int i = 0; i < kSteps * kSteps; ++i) {
    const double s = (i % kSteps + .5) / kSteps, t = (i / kSteps + .5) / kSteps;
    const Point2 offset{Real(s * s * s) * filter.XWidth(), Real(t * t * t) * filter.YWidth()};
    sum += double(filter.Evaluate(offset)) * 9 * s * s * t * t;
  }
  return Real(4 * sum / (kSteps * kSteps)) * filter.XWidth() * filter.YWidth();
}

}  // namespace

FilmBox TinyEmitters::BoxOf(const Bounds3& bounds, const Matrix4& projection) const {
  return FilmBox(bounds, projection, full_).Grown(kMargin);
}

FilmBox TinyEmitters::BoxThrough(const Emitter& emitter, Point2 lens) {
  if (emitter.border.empty()) return emitter.box;
  return FilmBox::Between({emitter.border[0], emitter.border[1], double(lens.x + 1) / 2},
                          {emitter.border[2], emitter.border[3], double(lens.y + 1) / 2});
}

bool TinyEmitters::Add(const Light& light, const Bounds3& bounds, const Lens& lens) {
  const double xWidth = double(filter_.XWidth()), yWidth = double(filter_.YWidth());
  Emitter emitter{&light, BoxOf(bounds, lens.centre), {}};
  const double area = 4 * xWidth * yWidth;
  if (emitter.box.IsEmpty() || !(emitter.box.Area() <= area)) return false;
  if (light.IsProvablyBlack()) return true;
  if (!(integral_ > 0)) integral_ = IntegralOf(filter_);
  counts_.resize(std::size_t(crop_.Width()) * std::size_t(crop_.Height()));
  FilmBox reach = emitter.box;  // through any point of the lens
  double largest = emitter.box.Area();
  for (const Matrix4& projection : lens.border) {
    emitter.border.push_back(BoxOf(bounds, projection));
    reach.Extend(emitter.border.back());
    largest = std::max(largest, emitter.border.back().Area());
  }
  emitter.places = largest <= kFewShare * area ? kFewPlaces : kManyPlaces;
  const double supports = lens.border.empty() ? 1 : std::ceil(reach.Area() / area);
  emitter.lensPlaces =
      int(std::bit_ceil(unsigned(std::clamp(supports, 1., double(kMostLensPlaces)))));
  CountIn(reach);
  emitters_.push_back(std::move(emitter));
  return true;
}

// Adds the next emitter to the pixels whose filters meet this box.
void TinyEmitters::CountIn(const FilmBox& reach) {
  const PixelBounds shown = reach.Pixels(crop_, double(filter_.XWidth()), double(filter_.YWidth()));
  for (int y = shown.y0; y < shown.y1; ++y) {
    for (int x = shown.x0; x < shown.x1; ++x) {
      const std::uint32_t pixel = IndexOf(x, y);
      if (counts_[pixel] > kMost) continue;
      const FilmBox met = NearPixel(reach, {Real(x) + Real(.5), Real(y) + Real(.5)});
      if (met.IsEmpty() || !(met.Area() > 0)) continue;
      ++counts_[pixel];
      pixels_.push_back({pixel, std::uint32_t(emitters_.size())});
    }
  }
}

std::vector<Point2i> TinyEmitters::RemoveCrowds() {
  std::vector<Point2i> crowded;
  for (int y = crop_.y0; y < crop_.y1 && !counts_.empty(); ++y)
    for (int x = crop_.x0; x < crop_.x1; ++x)
      if (counts_[IndexOf(x, y)] > kMost) crowded.push_back({x, y});
  std::erase_if(pixels_, [&](const InPixel& one) { return counts_[one.pixel] > kMost; });
  for (std::uint8_t& count : counts_)
    if (count > kMost) count = 0;
  std::ranges::stable_sort(pixels_, {}, &InPixel::pixel);
  return crowded;
}

EmittedLight TinyEmitters::Without(std::span<const InPixel> emitters, EmittedLight light) const {
  const auto isLamp = [&](const InPixel& one) { return (*this)[one].light == light.lamp; };
  if (std::ranges::any_of(emitters, isLamp)) light.first = {};
  return light;
}

std::span<const TinyEmitters::InPixel> TinyEmitters::In(Point2i pixel) const {
  if (counts_.empty() || !crop_.Contains(pixel.x, pixel.y)) return {};
  const std::uint32_t index = IndexOf(pixel.x, pixel.y);
  if (counts_[index] == 0) return {};
  const auto [begin, end] = std::ranges::equal_range(pixels_, index, {}, &InPixel::pixel);
  return {begin, end};
}

}  // namespace exphoton
