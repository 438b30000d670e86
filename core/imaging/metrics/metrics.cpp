// SPDX-License-Identifier: BSD-2-Clause
// Differences between images, summed in double precision over the pixels that are finite in both.
#include "core/imaging/metrics/metrics.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/imaging/metrics/flip.h"

namespace exphoton {
namespace {

std::string SizeText(const Image& image) {
  return std::to_string(image.Width()) + " x " + std::to_string(image.Height());
}

// Two images with their colour channels, checked once.
struct Pair {
  Pair(const Image& reference, const Image& other) : a(reference), b(other) {
    if (a.Width() != b.Width() || a.Height() != b.Height())
      throw ImageError("the pictures differ in size: " + SizeText(a) + " and " + SizeText(b));
    from = FindColors(a, "the reference");
    to = FindColors(b, "the picture");
  }
  // Calls visit(x, y, r[3], v[3], isFinite) for every pixel.
  template <class Visit>
  void ForPixels(Visit&& visit) const {
    for (int y = 0; y < a.Height(); ++y) {
      for (int x = 0; x < a.Width(); ++x) {
        std::array<double, 3> r, v;
        bool isFinite = true;
        for (std::size_t c = 0; c < 3; ++c) {
          r[c] = a.At(x, y, from[c]);
          v[c] = b.At(x, y, to[c]);
          isFinite &= std::isfinite(r[c]) && std::isfinite(v[c]);
        }
        visit(x, y, r, v, isFinite);
      }
    }
  }

  const Image &a, &b;
  std::array<int, 3> from, to;
};

// Computes the mean without the worst thousandth, and the square root of the 99 % quantile. Sorts
// the errors.
void ComputeTailStatistics(std::vector<double>* errors, ImageDifference* difference) {
  const std::size_t count = errors->size();
  std::sort(errors->begin(), errors->end());
  const std::size_t kept = count - count / 1000;
  double sum = 0;
  for (std::size_t i = 0; i < kept; ++i) sum += (*errors)[i];
  difference->trimmedRelMse = sum / double(kept);
  const auto at = std::size_t(std::ceil(.99 * double(count)));
  difference->p99 = std::sqrt((*errors)[std::max<std::size_t>(at, 1) - 1]);
}

}  // namespace

std::array<int, 3> FindColors(const Image& image, const std::string& name) {
  const std::array<int, 3> found = {image.FindChannel("R"), image.FindChannel("G"),
                                    image.FindChannel("B")};
  std::string missing, there;
  for (std::size_t c = 0; c < 3; ++c)
    if (found[c] < 0) missing += (missing.empty() ? "" : ", ") + std::string(1, "RGB"[c]);
  if (missing.empty()) return found;
  for (const std::string& channel : image.channels) there += (there.empty() ? "" : ", ") + channel;
  throw ImageError(name + " lacks channel " + missing + " (it has " +
                   (there.empty() ? "none" : there) + ")");
}

ImageDifference CompareImages(const Image& reference, const Image& image) {
  ImageDifference difference;
  std::vector<double> errors;  // per pixel: mean over the colours
  Pair(reference, image).ForPixels([&](int, int, const auto& r, const auto& v, bool isFinite) {
    if (!isFinite) {
      ++difference.nonFinitePixels;
      return;
    }
    double relative = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      const double error = v[c] - r[c];
      difference.mse += error * error;
      relative += error * error * RelMseWeight(r[c]);
      difference.meanError += error;
      difference.meanReference += r[c];
    }
    difference.relMse += relative;
    errors.push_back(relative / 3);
  });
  if (errors.empty()) return difference;
  const double values = 3 * double(errors.size());
  difference.mse /= values;
  difference.relMse /= values;
  difference.meanError /= values;
  difference.meanReference /= values;
  ComputeTailStatistics(&errors, &difference);
  if (difference.meanError != 0) {
    difference.relativeMeanError =
        difference.meanReference != 0
            ? difference.meanError / difference.meanReference
            : std::copysign(std::numeric_limits<double>::infinity(), difference.meanError);
  }
  return difference;
}

Image DifferenceImage(const Image& reference, const Image& image) {
  const Pair pair(reference, image);
  Image result(image.data, image.display,
               {"R", "G", "B", "relative.R", "relative.G", "relative.B", "relMSE.Y", "FLIP.Y"});
  const std::vector<float> flip = FlipMap(reference, image);
  pair.ForPixels([&](int x, int y, const auto& r, const auto& v, bool) {
    double square = 0;
    for (int c = 0; c < 3; ++c) {
      const double error = v[std::size_t(c)] - r[std::size_t(c)];
      const double relative = error * std::sqrt(RelMseWeight(r[std::size_t(c)]));
      result.At(x, y, c) = float(error);
      result.At(x, y, 3 + c) = float(relative);
      square += relative * relative / 3;
    }
    result.At(x, y, 6) = float(square);
    result.At(x, y, 7) = flip[std::size_t(y) * std::size_t(image.Width()) + std::size_t(x)];
  });
  result.attributes["comments"] = std::string(
      "R,G,B: picture - reference; relative: divided by sqrt(reference^2 + 0.01); relMSE: its "
      "square, mean of the colours; FLIP: LDR-FLIP, mean luminance of the reference at 0.18");
  return result;
}

Image SignedErrorImage(const Image& reference, const Image& image, double fullScale,
                       std::optional<int> channel) {
  const Pair pair(reference, image);
  Image result(image.data, image.display, {"R", "G", "B"});
  pair.ForPixels([&](int x, int y, const auto& r, const auto& v, bool isFinite) {
    double error = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      const double weight = !channel ? 1. / 3 : *channel == int(c) ? 1 : 0;
      error += weight * (v[c] - r[c]) * std::sqrt(RelMseWeight(r[c]));
    }
    const double t = std::clamp(error / fullScale, -1., 1.);
    // Blends from white to a pure hue, in linear light.
    const std::array<double, 3> color =
        !isFinite ? std::array<double, 3>{1, .8, 0}
        : t >= 0  ? std::array<double, 3>{1 - .4 * t * t, (1 - t) * (1 - t), (1 - t) * (1 - t)}
                  : std::array<double, 3>{(1 + t) * (1 + t), (1 + t) * (1 + t), 1 - .4 * t * t};
    for (int c = 0; c < 3; ++c) result.At(x, y, c) = float(color[std::size_t(c)]);
  });
  return result;
}

}  // namespace exphoton
