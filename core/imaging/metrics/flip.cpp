// SPDX-License-Identifier: BSD-2-Clause
// FLIP as published: pictures are blurred by the eye's contrast sensitivity and compared in CIELAB.
// The difference of edges and points is an exponent. Section numbers refer to the paper. All
// filters are sums of separable filters.
#include "core/imaging/metrics/flip.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>

#include "core/imaging/metrics/metrics.h"

namespace exphoton {
namespace {

using Triple = std::array<double, 3>;
using Plane = std::vector<double>;
constexpr double kPixelsPerDegree = 67.02;  // 0.7 m from a display with 3840 pixels on 0.7 m
constexpr double kCirclePi = std::numbers::pi;

constexpr std::array<Triple, 3> kToXyz = {
    {{10135552. / 24577794, 8788810. / 24577794, 4435075. / 24577794},
     {2613072. / 12288897, 8788810. / 12288897, 887015. / 12288897},
     {1425312. / 73733382, 8788810. / 73733382, 70074185. / 73733382}}};
constexpr std::array<Triple, 3> kFromXyz = {{{3.241003275, -1.537398934, -0.498615861},
                                             {-0.969224334, 1.875930071, 0.041554224},
                                             {0.055639423, -0.204011202, 1.057148933}}};

Triple Multiply(const std::array<Triple, 3>& m, const Triple& v) {
  Triple r{};
  for (std::size_t i = 0; i < 3; ++i) r[i] = m[i][0] * v[0] + m[i][1] * v[1] + m[i][2] * v[2];
  return r;
}

Triple White() { return Multiply(kToXyz, {1, 1, 1}); }

// Converts to the linearised Lab of section 4.1.1: achromatic, red-green, blue-yellow.
Triple ToOpponent(const Triple& rgb) {
  const Triple xyz = Multiply(kToXyz, rgb), white = White();
  const double x = xyz[0] / white[0], y = xyz[1] / white[1], z = xyz[2] / white[2];
  return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

Triple FromOpponent(const Triple& v) {
  const Triple white = White();
  const double y = (v[0] + 16) / 116, x = y + v[1] / 500, z = y - v[2] / 200;
  return Multiply(kFromXyz, {x * white[0], y * white[1], z * white[2]});
}

// Converts to CIELAB with the Hunt adjustment of section 4.1.2.
Triple ToHuntLab(const Triple& rgb) {
  const Triple xyz = Multiply(kToXyz, rgb), white = White();
  const auto f = [](double t) {
    constexpr double kDelta = 6. / 29;
    return t > kDelta * kDelta * kDelta ? std::cbrt(t) : t / (3 * kDelta * kDelta) + 4. / 29;
  };
  const double x = f(xyz[0] / white[0]), y = f(xyz[1] / white[1]), z = f(xyz[2] / white[2]);
  const double lightness = 116 * y - 16;
  return {lightness, .01 * lightness * 500 * (x - y), .01 * lightness * 200 * (y - z)};
}

double HyAb(const Triple& a, const Triple& b) {
  return std::abs(a[0] - b[0]) + std::hypot(a[1] - b[1], a[2] - b[2]);
}

struct Grid {
  int width = 0, height = 0;
  std::size_t Size() const { return std::size_t(width) * std::size_t(height); }
};

// Correlates rows with one kernel and columns with another; edge pixels are repeated.
Plane Filter(const Plane& in, Grid grid, const Plane& rows, const Plane& columns) {
  const auto pass = [&](const Plane& from, const Plane& kernel, bool isRow) {
    const int radius = int(kernel.size() / 2);
    Plane to(from.size());
    for (int y = 0; y < grid.height; ++y) {
      for (int x = 0; x < grid.width; ++x) {
        double sum = 0;
        for (int k = -radius; k <= radius; ++k) {
          const int u = isRow ? std::clamp(x + k, 0, grid.width - 1) : x;
          const int v = isRow ? y : std::clamp(y + k, 0, grid.height - 1);
          sum += kernel[std::size_t(k + radius)] *
                 from[std::size_t(v) * std::size_t(grid.width) + std::size_t(u)];
        }
        to[std::size_t(y) * std::size_t(grid.width) + std::size_t(x)] = sum;
      }
    }
    return to;
  };
  return pass(pass(in, rows, true), columns, false);
}

Plane Tabulate(int radius, const std::function<double(double)>& f) {
  Plane kernel;
  for (int i = -radius; i <= radius; ++i) kernel.push_back(f(i));
  return kernel;
}

// Scales positive weights to a sum of 1, and negative weights to a sum of -1.
Plane Normalized(Plane kernel) {
  double above = 0, below = 0;
  for (const double w : kernel) (w > 0 ? above : below) += std::abs(w);
  for (double& w : kernel) w /= w > 0 ? above : std::max(below, 1e-300);
  return kernel;
}

// One Gaussian of a contrast sensitivity function: a sqrt(pi/b) exp(-pi^2 d^2 / b).
struct Lobe {
  double a, b;
};

// Applies the contrast sensitivity function of table 1 and section 4.1.1.
Plane Sensitivity(const Plane& in, Grid grid, const std::vector<Lobe>& lobes) {
  constexpr double kWidest = .04;
  const int radius =
      int(std::ceil(3 * std::sqrt(kWidest / (2 * kCirclePi * kCirclePi)) * kPixelsPerDegree));
  Plane out(in.size(), 0);
  double total = 0;
  for (const Lobe& lobe : lobes) {
    const Plane kernel = Tabulate(radius, [&](double i) {
      const double d = i / kPixelsPerDegree;
      return std::exp(-kCirclePi * kCirclePi * d * d / lobe.b);
    });
    double sum = 0;
    for (const double w : kernel) sum += w;
    const double factor = lobe.a * std::sqrt(kCirclePi / lobe.b);
    const Plane part = Filter(in, grid, kernel, kernel);
    for (std::size_t i = 0; i < in.size(); ++i) out[i] += factor * part[i];
    total += factor * sum * sum;
  }
  for (double& v : out) v /= total;
  return out;
}

struct Prepared {
  std::vector<Triple> lab;  // after the contrast sensitivity filter
  Plane edges, points;      // magnitudes of first and second derivatives
};

Prepared Prepare(const std::vector<Triple>& rgb, Grid grid) {
  std::array<Plane, 3> opponent;
  for (Plane& plane : opponent) plane.resize(grid.Size());
  Plane lightness(grid.Size());
  for (std::size_t i = 0; i < grid.Size(); ++i) {
    const Triple v = ToOpponent(rgb[i]);
    for (std::size_t c = 0; c < 3; ++c) opponent[c][i] = v[c];
    lightness[i] = (v[0] + 16) / 116;
  }
  opponent[0] = Sensitivity(opponent[0], grid, {{1, .0047}});
  opponent[1] = Sensitivity(opponent[1], grid, {{1, .0053}});
  opponent[2] = Sensitivity(opponent[2], grid, {{34.1, .04}, {13.5, .025}});
  Prepared result;
  for (std::size_t i = 0; i < grid.Size(); ++i) {
    Triple color = FromOpponent({opponent[0][i], opponent[1][i], opponent[2][i]});
    for (double& v : color) v = std::clamp(v, 0., 1.);
    result.lab.push_back(ToHuntLab(color));
  }
  // Section 4.2: features are about 0.082 degrees wide.
  const double deviation = .5 * .082 * kPixelsPerDegree;
  const int radius = int(std::ceil(3 * deviation));
  const auto gauss = [=](double x) { return std::exp(-x * x / (2 * deviation * deviation)); };
  const Plane smooth = Normalized(Tabulate(radius, gauss));
  const Plane slope = Normalized(Tabulate(radius, [&](double x) { return -x * gauss(x); }));
  const Plane bend = Normalized(
      Tabulate(radius, [&](double x) { return (x * x / (deviation * deviation) - 1) * gauss(x); }));
  const auto magnitude = [&](const Plane& kernel) {
    const Plane dx = Filter(lightness, grid, kernel, smooth);
    const Plane dy = Filter(lightness, grid, smooth, kernel);
    Plane both(grid.Size());
    for (std::size_t i = 0; i < both.size(); ++i) both[i] = std::hypot(dx[i], dy[i]);
    return both;
  };
  result.edges = magnitude(slope);
  result.points = magnitude(bend);
  return result;
}

// Maps [0, largest] to [0, 1]; small differences get most of the range (section 4.1.3).
double Redistribute(double difference, double largest) {
  constexpr double kPower = .7, kKnee = .4, kAtKnee = .95;
  const double v = std::pow(difference, kPower), knee = kKnee * largest;
  return v < knee ? kAtKnee / knee * v : kAtKnee + (v - knee) / (largest - knee) * (1 - kAtKnee);
}

std::vector<float> Flip(const std::vector<Triple>& a, const std::vector<Triple>& b, Grid grid) {
  const Prepared first = Prepare(a, grid), second = Prepare(b, grid);
  const double largest = std::pow(HyAb(ToHuntLab({0, 1, 0}), ToHuntLab({0, 0, 1})), .7);
  std::vector<float> map(grid.Size());
  for (std::size_t i = 0; i < map.size(); ++i) {
    const double color = Redistribute(HyAb(first.lab[i], second.lab[i]), largest);
    const double feature = std::max(std::abs(first.edges[i] - second.edges[i]),
                                    std::abs(first.points[i] - second.points[i]));
    const double exponent = 1 - std::sqrt(feature / std::numbers::sqrt2);
    map[i] = float(std::clamp(std::pow(color, exponent), 0., 1.));
  }
  return map;
}

std::vector<Triple> Displayed(const Image& image, const std::array<int, 3>& colors, double scale) {
  std::vector<Triple> pixels;
  for (int y = 0; y < image.Height(); ++y) {
    for (int x = 0; x < image.Width(); ++x) {
      Triple pixel;
      for (std::size_t c = 0; c < 3; ++c) {
        const double v = double(image.At(x, y, colors[c])) * scale;
        pixel[c] = std::isfinite(v) ? std::clamp(v, 0., 1.) : 0;
      }
      pixels.push_back(pixel);
    }
  }
  return pixels;
}

std::vector<float> MapAt(const Image& reference, const Image& image, double scale) {
  if (reference.Width() != image.Width() || reference.Height() != image.Height())
    throw ImageError("the pictures differ in size");
  const auto from = FindColors(reference, "the reference"), to = FindColors(image, "the picture");
  return Flip(Displayed(reference, from, scale), Displayed(image, to, scale),
              {image.Width(), image.Height()});
}

}  // namespace

std::vector<float> FlipMapOfDisplayed(const Image& reference, const Image& image) {
  return MapAt(reference, image, 1);
}

std::vector<float> FlipMap(const Image& reference, const Image& image) {
  return MapAt(reference, image, DisplayScale(reference));
}

double FlipError(const Image& reference, const Image& image) {
  const std::vector<float> map = FlipMap(reference, image);
  double sum = 0;
  for (const float v : map) sum += double(v);
  return map.empty() ? 0 : sum / double(map.size());
}

double DisplayScale(const Image& reference) {
  constexpr double kMiddleGrey = .18;
  const std::array<int, 3> colors = FindColors(reference, "the reference");
  double sum = 0;
  long long count = 0;
  for (int y = 0; y < reference.Height(); ++y) {
    for (int x = 0; x < reference.Width(); ++x) {
      const double luminance = .2126 * double(reference.At(x, y, colors[0])) +
                               .7152 * double(reference.At(x, y, colors[1])) +
                               .0722 * double(reference.At(x, y, colors[2]));
      if (!std::isfinite(luminance)) continue;
      sum += luminance;
      ++count;
    }
  }
  return sum > 0 ? kMiddleGrey * double(count) / sum : 1;
}

}  // namespace exphoton
