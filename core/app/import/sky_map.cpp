// SPDX-License-Identifier: BSD-2-Clause
// LatitudeMapOf averages several points of each pixel, so that small bright suns keep their power.
#include "core/app/import/sky_map.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace exphoton::cli {
namespace {

// Nearest pixel of the square image.
std::array<int, 2> PixelAt(const Image& image, const std::array<double, 2>& point) {
  const auto index = [](double t, int size) { return std::clamp(int(t * size), 0, size - 1); };
  return {index(point[0], image.Width()), index(point[1], image.Height())};
}

std::array<double, 3> DirectionOf(double theta, double phi) {
  return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

}  // namespace

std::array<double, 2> SquareOfDirection(const std::array<double, 3>& direction) {
  const double x = std::abs(direction[0]), y = std::abs(direction[1]);
  const double radius = std::sqrt(std::max(0., 1 - std::abs(direction[2])));
  const double share = x == 0 && y == 0 ? 0 : std::atan2(y, x) * 2 / std::numbers::pi;
  double v = share * radius, u = radius - v;
  if (direction[2] < 0) {
    const double lower = 1 - v;
    v = 1 - u;
    u = lower;
  }
  return {(std::copysign(u, direction[0]) + 1) / 2, (std::copysign(v, direction[1]) + 1) / 2};
}

Image LatitudeMapOf(const Image& square) {
  constexpr int kPoints = 4;  // along each side of a pixel
  const int height = square.Height(), width = 2 * height;
  const std::array<int, 3> channels{square.FindChannel("R"), square.FindChannel("G"),
                                    square.FindChannel("B")};
  Image map(width, height, {"R", "G", "B"});
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int i = 0; i < kPoints * kPoints; ++i) {
        const double theta = (y + (i / kPoints + .5) / kPoints) * std::numbers::pi / height;
        const double phi = (x + (i % kPoints + .5) / kPoints) * 2 * std::numbers::pi / width;
        const auto [column, row] = PixelAt(square, SquareOfDirection(DirectionOf(theta, phi)));
        for (int c = 0; c < 3; ++c)
          map.At(x, y, c) +=
              square.At(column, row, channels[std::size_t(c)]) / float(kPoints * kPoints);
      }
  return map;
}

}  // namespace exphoton::cli
