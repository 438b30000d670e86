// SPDX-License-Identifier: BSD-2-Clause
// This file reduces, crops and encodes the report's pictures.
#include "core/app/report/page_pictures.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "core/app/analysis/analysis.h"
#include "core/app/report/markup.h"
#include "core/base/format.h"
#include "core/imaging/files/png.h"
#include "core/imaging/metrics/metrics.h"

namespace exphoton::study {
namespace {

constexpr int kMaxWidth = 420;

Html Element(const Image& image, float exposure, const std::string& alt, bool isPixelated) {
  return Fill("picture", {{"data", Base64(EncodePng(image, {exposure}))},
                          {"width", image.Width()},
                          {"height", image.Height()},
                          {"alt", alt},
                          {"class", isPixelated ? Fill("enlarged") : Html()}});
}

// Maps [0, 1] to colours from dark violet over green to yellow, in nearly equal steps of lightness
// (after "viridis" by van der Walt and Smith). Values are sRGB, linear between anchors.
std::array<double, 3> FalseColor(double t) {
  constexpr std::array<std::array<double, 3>, 6> kAnchors = {{{.267, .005, .329},
                                                              {.254, .265, .530},
                                                              {.164, .471, .558},
                                                              {.134, .659, .518},
                                                              {.478, .821, .318},
                                                              {.993, .906, .144}}};
  const double place = std::clamp(t, 0., 1.) * (kAnchors.size() - 1);
  const auto i = std::min(std::size_t(place), kAnchors.size() - 2);
  std::array<double, 3> color{};
  for (std::size_t c = 0; c < 3; ++c)
    color[c] = kAnchors[i][c] + (place - double(i)) * (kAnchors[i + 1][c] - kAnchors[i][c]);
  return color;
}

// Inverts the sRGB encoding that EncodePng applies, so that false colours are kept.
float Decode(double v) {
  return float(v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4));
}

// Returns the colours of a CSS gradient.
std::string GradientStops() {
  std::string stops;
  for (int i = 0; i <= 10; ++i) {
    const auto c = FalseColor(i / 10.);
    stops += Format("%srgb(%.0f %.0f %.0f)", i ? "," : "", 255 * c[0], 255 * c[1], 255 * c[2]);
  }
  return stops;
}

struct MapScale {
  double low, high;
};

// Returns the 1st and the 99th percentile of the positive values, if there are any.
std::optional<MapScale> FindScale(const Image& image, int channel) {
  std::vector<float> values;
  for (int y = 0; y < image.Height(); ++y)
    for (int x = 0; x < image.Width(); ++x)
      if (const float v = image.At(x, y, channel); std::isfinite(v) && v > 0) values.push_back(v);
  if (values.empty()) return std::nullopt;
  std::sort(values.begin(), values.end());
  const auto quantile = [&](double q) {
    return double(values[std::size_t(q * double(values.size() - 1))]);
  };
  const double low = quantile(.01);
  return MapScale{low, std::max(quantile(.99), low * 1.01)};
}

}  // namespace

Image Shrink(const Image& image, int maxWidth) {
  const int factor = (image.Width() + maxWidth - 1) / maxWidth;
  if (factor <= 1) return image;
  Image small(std::max(1, image.Width() / factor), std::max(1, image.Height() / factor),
              image.channels);
  for (int y = 0; y < small.Height(); ++y) {
    for (int x = 0; x < small.Width(); ++x) {
      for (int c = 0; c < image.ChannelCount(); ++c) {
        double sum = 0;
        for (int v = 0; v < factor; ++v)
          for (int u = 0; u < factor; ++u) {
            const float value = image.At(std::min(x * factor + u, image.Width() - 1),
                                         std::min(y * factor + v, image.Height() - 1), c);
            if (std::isfinite(value)) sum += double(value);
          }
        small.At(x, y, c) = float(sum / (factor * factor));
      }
    }
  }
  return small;
}

Image CropOf(const Image& image, const std::array<double, 4>& f) {
  const auto edge = [](double fraction, int size) {
    return std::clamp(int(std::lround(fraction * size)), 0, size);
  };
  const int x0 = std::min(edge(f[0], image.Width()), image.Width() - 1);
  const int y0 = std::min(edge(f[2], image.Height()), image.Height() - 1);
  const int x1 = std::max(edge(f[1], image.Width()), x0 + 1);
  const int y1 = std::max(edge(f[3], image.Height()), y0 + 1);
  Image crop(x1 - x0, y1 - y0, image.channels);
  for (int y = y0; y < y1; ++y)
    for (int x = x0; x < x1; ++x)
      for (int c = 0; c < image.ChannelCount(); ++c) crop.At(x - x0, y - y0, c) = image.At(x, y, c);
  return crop;
}

Html PictureElement(const Image& image, double scale, const std::string& alt, bool isPixelated) {
  Image colors(image.data, image.display, {"R", "G", "B"});
  const auto from = FindColors(image, "the picture");
  for (int y = 0; y < image.Height(); ++y)
    for (int x = 0; x < image.Width(); ++x)
      for (std::size_t c = 0; c < 3; ++c) colors.At(x, y, int(c)) = image.At(x, y, from[c]);
  return Element(Shrink(colors, kMaxWidth), float(std::log2(scale)), alt, isPixelated);
}

Html MapFigure(const Image& image, const MapRecord& map) {
  const int from = image.FindChannel(map.channel);
  const auto scale = from < 0 ? std::nullopt : FindScale(image, from);
  if (!scale) return {};
  const auto [low, high] = *scale;
  Image shown(image.Width(), image.Height(), {"R", "G", "B"});
  for (int y = 0; y < image.Height(); ++y) {
    for (int x = 0; x < image.Width(); ++x) {
      const double v = image.At(x, y, from);
      const bool hasValue = std::isfinite(v) && v > 0;
      const auto color = hasValue ? FalseColor(std::log(v / low) / std::log(high / low))
                                  : std::array<double, 3>{.5, .5, .5};
      for (std::size_t c = 0; c < 3; ++c) shown.At(x, y, int(c)) = Decode(color[c]);
    }
  }
  return Fill("map", {{"picture", Element(Shrink(shown, kMaxWidth), 0, map.channel, false)},
                      {"low", ShortNumber(low)},
                      {"stops", GradientStops()},
                      {"high", ShortNumber(high) + " " + map.unit},
                      {"title", map.title}});
}

std::array<double, 4> WorstWindow(const Image& image, const Image& reference) {
  const int width = std::max(1, image.Width() / 4), height = std::max(1, image.Height() / 4);
  const auto from = FindColors(reference, "the reference"), to = FindColors(image, "the picture");
  std::array<double, 4> worst{0, .25, 0, .25};
  double most = -1;
  for (int y0 = 0; y0 + height <= image.Height(); y0 += std::max(1, height / 2)) {
    for (int x0 = 0; x0 + width <= image.Width(); x0 += std::max(1, width / 2)) {
      double sum = 0;
      for (int y = y0; y < y0 + height; ++y)
        for (int x = x0; x < x0 + width; ++x)
          for (std::size_t c = 0; c < 3; ++c) {
            const double r = reference.At(x, y, from[c]), v = image.At(x, y, to[c]);
            const double error = (v - r) * (v - r) * RelMseWeight(r);
            if (std::isfinite(error)) sum += std::min(error, 1.);
          }
      if (sum <= most) continue;
      most = sum;
      worst = {double(x0) / image.Width(), double(x0 + width) / image.Width(),
               double(y0) / image.Height(), double(y0 + height) / image.Height()};
    }
  }
  return worst;
}

}  // namespace exphoton::study
