// SPDX-License-Identifier: BSD-2-Clause
// Tone curves, the automatic exposure, and the share of pixels that an exposure loses.
#include "core/imaging/files/tone.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/imaging/files/srgb.h"

namespace exphoton {
namespace {

constexpr double kMiddleGrey = .18;

// A rational fit of the ACES curve; reaches 1 near 7.2.
double Filmic(double x) {
  return std::min(x * (2.51 * x + .03) / (x * (2.43 * x + .59) + .14), 1.);
}

// Calls visit(r, g, b, alpha) for each pixel. Throws ImageError without channels R, G, B.
template <class Visit>
void ForEachPixel(const Image& image, const Visit& visit) {
  const std::array<int, 3> color{image.FindChannel("R"), image.FindChannel("G"),
                                 image.FindChannel("B")};
  if (color[0] < 0 || color[1] < 0 || color[2] < 0)
    throw ImageError("the picture has no channels R, G, B");
  const int alpha = image.FindChannel("A");
  for (int y = 0; y < image.Height(); ++y)
    for (int x = 0; x < image.Width(); ++x)
      visit(
          std::array<double, 3>{double(image.At(x, y, color[0])), double(image.At(x, y, color[1])),
                                double(image.At(x, y, color[2]))},
          alpha < 0 ? 1. : double(image.At(x, y, alpha)));
}

}  // namespace

double ToneMapping::Apply(double value) const {
  if (!(value > 0)) return 0;  // also for NaN
  const double scaled = std::min(value * std::exp2(double(exposure)), 1e6);
  return curve == ToneCurve::Filmic ? Filmic(scaled) : std::min(scaled, 1.);
}

float AutoExposure(const Image& image) {
  double sum = 0;
  long long count = 0;
  ForEachPixel(image, [&](const std::array<double, 3>& c, double alpha) {
    const double luminance =
        StraightFactor(image, alpha) * (.2126 * c[0] + .7152 * c[1] + .0722 * c[2]);
    if (!(luminance > 0) || !std::isfinite(luminance)) return;
    sum += std::log2(luminance);
    ++count;
  });
  if (count == 0) return 0;
  const double stops = std::log2(kMiddleGrey) - sum / double(count);
  return float(std::round(std::clamp(stops, -100., 100.) * 100) / 100);
}

ToneLoss MeasureToneLoss(const Image& image, const ToneMapping& tone) {
  const double scale = std::exp2(double(tone.exposure));
  // A filmic curve clips far above 1.
  const double limit = tone.curve == ToneCurve::Filmic ? 7.2 : 1;
  const double leastVisible = DecodeSrgb(.5 / 255);
  long long clipped = 0, black = 0;
  ForEachPixel(image, [&](const std::array<double, 3>& c, double alpha) {
    if (alpha == 0) return;
    const double greatest = StraightFactor(image, alpha) * std::max({c[0], c[1], c[2]});
    clipped += int(greatest * scale > limit);
    black += int(!(tone.Apply(greatest) >= leastVisible));
  });
  const double pixels = double(image.Width()) * double(image.Height());
  return {double(clipped) / pixels, double(black) / pixels};
}

}  // namespace exphoton
