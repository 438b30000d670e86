// SPDX-License-Identifier: BSD-2-Clause
// This file reduces, crops and encodes the report's pictures.
#include "core/app/report/page_pictures.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "core/app/analysis/numbers.h"
#include "core/app/report/markup.h"
#include "core/base/format.h"
#include "core/imaging/files/png.h"
#include "core/imaging/metrics/metrics.h"

namespace exphoton::study {
namespace {

constexpr int kMaxWidth = 640;

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

// Returns the width of a window: an eighth of the picture's, at least 32 pixels and at most a
// third.
int WindowWidth(int width) {
  constexpr int kFewest = 32;
  return std::max(1, std::min(width / 3, std::max(width / 8, kFewest)));
}

// Returns the sum of the relMSE terms of each pixel over all pictures, each term at most 1.
std::vector<double> ErrorsOf(const std::vector<Image>& images, const Image& reference) {
  std::vector<double> errors(std::size_t(reference.Width()) * std::size_t(reference.Height()));
  const auto from = FindColors(reference, "the reference");
  for (const Image& image : images) {
    const auto to = FindColors(image, "the picture");
    std::size_t i = 0;
    for (int y = 0; y < reference.Height(); ++y)
      for (int x = 0; x < reference.Width(); ++x, ++i)
        for (std::size_t c = 0; c < 3; ++c) {
          const double r = reference.At(x, y, from[c]), v = image.At(x, y, to[c]);
          const double error = (v - r) * (v - r) * RelMseWeight(r);
          if (std::isfinite(error)) errors[i] += std::min(error, 1.);
        }
  }
  return errors;
}

double SumOver(const PixelBounds& window, const std::vector<double>& values, int width) {
  double sum = 0;
  for (int y = window.y0; y < window.y1; ++y)
    for (int x = window.x0; x < window.x1; ++x) sum += values[std::size_t(y * width + x)];
  return sum;
}

// Returns whether a window is less than this many times its own size away from one of the others.
bool IsNearAny(const PixelBounds& a, const std::vector<PixelBounds>& others, double sizes) {
  const int x = int(sizes * a.Width()), y = int(sizes * a.Height());
  return std::any_of(others.begin(), others.end(), [&](const PixelBounds& b) {
    return a.x0 - x < b.x1 && b.x0 < a.x1 + x && a.y0 - y < b.y1 && b.y0 < a.y1 + y;
  });
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

std::string FalseColorStops() {
  std::string stops;
  for (int i = 0; i <= 10; ++i) {
    const auto c = FalseColor(i / 10.);
    stops += Format("%srgb(%.0f %.0f %.0f)", i ? "," : "", 255 * c[0], 255 * c[1], 255 * c[2]);
  }
  return stops;
}

Html ScalarPicture(const std::vector<float>& values, const Image& like, double high,
                   const std::string& alt) {
  Image shown(like.Width(), like.Height(), {"R", "G", "B"});
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto color = FalseColor(double(values[i]) / high);
    for (std::size_t c = 0; c < 3; ++c) shown.pixels[3 * i + c] = Decode(color[c]);
  }
  return Element(Shrink(shown, kMaxWidth), 0, alt, true);
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
                      {"legend", Fill("legend", {{"name", ""},
                                                 {"low", ShortNumber(low)},
                                                 {"stops", FalseColorStops()},
                                                 {"high", ShortNumber(high) + " " + map.unit}})},
                      {"title", map.title}});
}

std::vector<std::array<double, 4>> WorstWindows(const std::vector<Image>& images,
                                                const Image& reference, std::size_t count) {
  const std::vector<double> errors = ErrorsOf(images, reference);
  const int width = WindowWidth(reference.Width());
  const int height = std::max(1, width * reference.Height() / reference.Width());
  std::vector<PixelBounds> windows;
  for (int y = 0; y + height <= reference.Height(); y += std::max(1, height / 4))
    for (int x = 0; x + width <= reference.Width(); x += std::max(1, width / 4))
      windows.push_back({x, y, x + width, y + height});
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t i = 0; i < windows.size(); ++i)
    order.emplace_back(-SumOver(windows[i], errors, reference.Width()), i);
  std::sort(order.begin(), order.end());
  std::vector<PixelBounds> chosen;
  // Small pictures have no room for windows that are far apart.
  for (const double sizes : {1., .5, 0.})
    for (const auto& [sum, i] : order)
      if (chosen.size() < count && !IsNearAny(windows[i], chosen, sizes))
        chosen.push_back(windows[i]);
  std::vector<std::array<double, 4>> fractions;
  for (const PixelBounds& w : chosen)
    fractions.push_back({double(w.x0) / reference.Width(), double(w.x1) / reference.Width(),
                         double(w.y0) / reference.Height(), double(w.y1) / reference.Height()});
  return fractions;
}

}  // namespace exphoton::study
