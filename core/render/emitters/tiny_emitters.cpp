// SPDX-License-Identifier: BSD-2-Clause
#include "core/render/emitters/tiny_emitters.h"

#include <algorithm>
#include <tuple>

namespace exphoton {
namespace {

// Rays and boxes are rounded differently.
constexpr double kMargin = 1e-3;  // in pixels

// Returns the integral of a filter over its support, by the midpoint rule.
Real IntegralOf(const Filter& filter) {
  constexpr int kSteps = 128;
  const Real dx = 2 * filter.XWidth() / kSteps, dy = 2 * filter.YWidth() / kSteps;
  double sum = 0;
  for (int y = 0; y < kSteps; ++y)
    for (int x = 0; x < kSteps; ++x)
      sum += double(filter.Evaluate({(Real(x) + Real(.5)) * dx - filter.XWidth(),
                                     (Real(y) + Real(.5)) * dy - filter.YWidth()}));
  return Real(sum) * dx * dy;
}

}  // namespace

bool TinyEmitters::Add(Emitter emitter, const PixelBounds& crop) {
  const double xWidth = double(filter_.XWidth()), yWidth = double(filter_.YWidth());
  emitter.box = emitter.box.Grown(kMargin);
  const double area = 4 * xWidth * yWidth;
  if (emitter.box.IsEmpty() || !(emitter.box.Area() <= area)) return false;
  if (!(integral_ > 0)) integral_ = IntegralOf(filter_);
  emitter.places = emitter.box.Area() <= kFewShare * area ? kFewPlaces : kManyPlaces;
  const PixelBounds shown = emitter.box.Pixels(crop, xWidth, yWidth);
  for (int y = shown.y0; y < shown.y1; ++y)
    for (int x = shown.x0; x < shown.x1; ++x)
      pixels_.push_back({x, y, std::uint32_t(emitters_.size())});
  emitters_.push_back(emitter);
  return true;
}

std::vector<Point2i> TinyEmitters::RemoveCrowds() {
  std::ranges::sort(pixels_, {},
                    [](const InPixel& one) { return std::tuple(one.y, one.x, one.emitter); });
  std::vector<Point2i> crowded;
  for (std::size_t begin = 0, end; begin < pixels_.size(); begin = end) {
    const auto isOther = [&](const InPixel& one) {
      return one.x != pixels_[begin].x || one.y != pixels_[begin].y;
    };
    end =
        std::size_t(std::find_if(pixels_.begin() + std::ptrdiff_t(begin), pixels_.end(), isOther) -
                    pixels_.begin());
    if (end - begin > kMost) crowded.push_back({pixels_[begin].x, pixels_[begin].y});
  }
  std::erase_if(pixels_, [&](const InPixel& one) {
    const auto before = [](Point2i a, Point2i b) {
      return std::tie(a.y, a.x) < std::tie(b.y, b.x);
    };
    return std::ranges::binary_search(crowded, Point2i{one.x, one.y}, before);
  });
  return crowded;
}

EmittedLight TinyEmitters::Without(std::span<const InPixel> emitters, EmittedLight light) const {
  const auto isLamp = [&](const InPixel& one) { return (*this)[one].light == light.lamp; };
  if (std::ranges::any_of(emitters, isLamp)) light.first = {};
  return light;
}

std::span<const TinyEmitters::InPixel> TinyEmitters::In(Point2i pixel) const {
  const auto [begin, end] =
      std::ranges::equal_range(pixels_, std::tuple(pixel.y, pixel.x), {},
                               [](const InPixel& one) { return std::tuple(one.y, one.x); });
  return {begin, end};
}

}  // namespace exphoton
