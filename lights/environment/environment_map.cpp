// SPDX-License-Identifier: BSD-2-Clause
// EnvironmentMap: construction, lookup, sampling and the exact integral.
#include "lights/environment/environment_map.h"

#include <algorithm>
#include <cmath>

namespace exphoton {
namespace {

constexpr double kPiDouble = 3.14159265358979323846;

// Returns the integral of sin(theta) times the weight of row `row` in the interpolation over theta.
// The weight is a hat of half-width h about the row's centre. Towards a pole the outermost rows
// have the weight 1, because the texels beyond the pole are texels of the same row.
double RowWeight(int row, int height) {
  const double h = kPiDouble / height, theta = (row + .5) * h;
  const double sine = std::sin(theta), cosine = std::cos(theta);
  const double above = row == 0 ? 1 - cosine : -cosine + (sine - std::sin(theta - h)) / h;
  const double below = row == height - 1 ? 1 + cosine : cosine - (std::sin(theta + h) - sine) / h;
  return above + below;
}

}  // namespace

EnvironmentMap::EnvironmentMap(std::vector<Spectrum> texels, int width, int height)
    : texels_(std::move(texels)), width_(width), height_(height) {
  std::vector<double> weights;
  weights.reserve(texels_.size());
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const Spectrum mean = CellMean(x, y);
      const double solidAngle = CellSolidAngle(y);
      for (int c = 0; c < Spectrum::kChannels; ++c)
        cells_[std::size_t(c)] += double(mean[c]) * solidAngle;
      for (int c = 0; c < Spectrum::kChannels; ++c)
        largest_[c] = std::max(largest_[c], Texel(x, y)[c]);
      weights.push_back(double(mean.MaxComponent()) * solidAngle);
    }
  }
  distribution_ = PiecewiseConstant2D(weights, width_, height_);
}

Spectrum EnvironmentMap::Integral() const {
  std::array<double, 3> sum{};
  for (int y = 0; y < height_; ++y) {
    const double weight = RowWeight(y, height_) * 2 * kPiDouble / width_;
    for (int x = 0; x < width_; ++x)
      for (int c = 0; c < Spectrum::kChannels; ++c)
        sum[std::size_t(c)] += weight * double(Texel(x, y)[c]);
  }
  return {Real(sum[0]), Real(sum[1]), Real(sum[2])};
}

// The density is constant within a cell. The interpolant is bilinear in each quarter of a cell, so
// it is largest at a corner of a quarter: at the texel, or midway to its neighbours.
Spectrum EnvironmentMap::LargestWeight() const {
  Spectrum largest;
  for (int y = 0; y < height_; ++y) {
    for (int x = 0; x < width_; ++x) {
      const Point2 centre{Real((x + .5) / width_), Real((y + .5) / height_)};
      const double pdf =
          double(distribution_.Pdf(centre)) / (double(width_) * height_ * CellSolidAngle(y));
      if (!(pdf > 0)) continue;
      for (int j = -1; j <= 1; ++j) {
        for (int i = -1; i <= 1; ++i) {
          const Spectrum value =
              (Texel(x, y) + Texel(x + i, y) + Texel(x, y + j) + Texel(x + i, y + j)) / 4;
          for (int c = 0; c < Spectrum::kChannels; ++c)
            largest[c] = std::max(largest[c], Real(double(value[c]) / pdf));
        }
      }
    }
  }
  return largest;
}

Spectrum EnvironmentMap::Evaluate(const Vector3& w) const {
  const Coordinates c = ToMap(w);
  const double x = c.x - .5, y = c.y - .5;
  const int x0 = int(std::floor(x)), y0 = int(std::floor(y));
  const Real fx = Real(x - x0), fy = Real(y - y0);
  return Lerp(fy, Lerp(fx, Texel(x0, y0), Texel(x0 + 1, y0)),
              Lerp(fx, Texel(x0, y0 + 1), Texel(x0 + 1, y0 + 1)));
}

Real EnvironmentMap::Pdf(const Vector3& w) const {
  const Coordinates c = ToMap(w);
  const int column = std::min(int(c.x), width_ - 1), row = std::min(int(c.y), height_ - 1);
  const Point2 centre{Real((column + .5) / width_), Real((row + .5) / height_)};
  return Real(double(distribution_.Pdf(centre)) / (double(width_) * height_ * CellSolidAngle(row)));
}

Vector3 EnvironmentMap::Sample(Point2 u) const {
  const Point2 p = distribution_.Sample(u);
  const double y = double(p.y) * height_;
  const int row = std::min(int(y), height_ - 1);
  // 1 - cos is linear in the position within the cell, and has no cancellation at the pole z = 1.
  const double a = OneMinusCosOfRow(row), b = OneMinusCosOfRow(row + 1);
  const double t = a + (y - row) * (b - a);
  const double sinTheta = std::sqrt(std::max(t * (2 - t), 0.0));
  const double phi = 2 * kPiDouble * double(p.x);
  return {Real(sinTheta * std::cos(phi)), Real(sinTheta * std::sin(phi)), Real(1 - t)};
}

EnvironmentMap::Coordinates EnvironmentMap::ToMap(const Vector3& w) const {
  double phi = std::atan2(double(w.y), double(w.x));
  if (phi < 0) phi += 2 * kPiDouble;
  const double theta = std::atan2(std::hypot(double(w.x), double(w.y)), double(w.z));
  return {phi / (2 * kPiDouble) * width_, theta / kPiDouble * height_};
}

double EnvironmentMap::OneMinusCosOfRow(int row) const {
  const double s = std::sin(kPiDouble * row / height_ / 2);
  return 2 * s * s;
}

double EnvironmentMap::CellSolidAngle(int row) const {
  return 2 * kPiDouble / width_ * (OneMinusCosOfRow(row + 1) - OneMinusCosOfRow(row));
}

// Columns wrap around. Beyond a pole the same row continues, rotated by half a turn.
Spectrum EnvironmentMap::Texel(int x, int y) const {
  if (y < 0 || y >= height_) {
    y = std::clamp(y, 0, height_ - 1);
    x += width_ / 2;
  }
  x = (x % width_ + width_) % width_;
  return texels_[std::size_t(y) * std::size_t(width_) + std::size_t(x)];
}

// Returns the mean of the bilinear interpolant over a cell: weights 1/8, 6/8, 1/8 per axis.
Spectrum EnvironmentMap::CellMean(int x, int y) const {
  constexpr Real kWeights[3] = {Real(.125), Real(.75), Real(.125)};
  Spectrum sum;
  for (int j = -1; j <= 1; ++j)
    for (int i = -1; i <= 1; ++i) sum += kWeights[i + 1] * kWeights[j + 1] * Texel(x + i, y + j);
  return sum;
}

}  // namespace exphoton
