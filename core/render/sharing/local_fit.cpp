// SPDX-License-Identifier: BSD-2-Clause
// LocalFit: collects neighbours and solves the normal equations.
#include "core/render/sharing/local_fit.h"

#include <algorithm>
#include <cmath>

namespace exphoton {
namespace {

// The normal equations get these multiples of the total weight on their diagonal, so that features
// that do not vary, or vary together, do no harm. Film features are of the order of the radius, in
// units of 8 pixels.
constexpr double kFilmRidge = 1e-3, kTiltRidge = 2e-4;

using Matrix = std::array<std::array<double, kFitFeatures>, kFitFeatures>;

Matrix NormalMatrix(const FitMoments& moments, double filmVariance) {
  Matrix matrix{};
  std::size_t k = 0;
  for (std::size_t i = 0; i < kFitFeatures; ++i)
    for (std::size_t j = i; j < kFitFeatures; ++j)
      matrix[i][j] = matrix[j][i] = double(moments.matrix[k++]);
  const double total = matrix[0][0];
  for (const std::size_t i : {1u, 2u}) matrix[i][i] += total * kFilmRidge * filmVariance;
  for (const std::size_t i : {3u, 4u}) matrix[i][i] += total * kTiltRidge;
  return matrix;
}

// Turns a positive definite matrix into its Cholesky factor, in the lower triangle.
void Factor(Matrix* matrix) {
  Matrix& m = *matrix;
  for (std::size_t j = 0; j < kFitFeatures; ++j) {
    for (std::size_t k = 0; k < j; ++k) m[j][j] -= m[j][k] * m[j][k];
    m[j][j] = std::sqrt(std::max(m[j][j], 1e-30));
    for (std::size_t i = j + 1; i < kFitFeatures; ++i) {
      for (std::size_t k = 0; k < j; ++k) m[i][j] -= m[i][k] * m[j][k];
      m[i][j] /= m[j][j];
    }
  }
}

std::array<double, kFitFeatures> Solve(const Matrix& factor,
                                       std::array<double, kFitFeatures> right) {
  for (std::size_t i = 0; i < kFitFeatures; ++i) {
    for (std::size_t k = 0; k < i; ++k) right[i] -= factor[i][k] * right[k];
    right[i] /= factor[i][i];
  }
  for (std::size_t i = kFitFeatures; i-- > 0;) {
    for (std::size_t k = i + 1; k < kFitFeatures; ++k) right[i] -= factor[k][i] * right[k];
    right[i] /= factor[i][i];
  }
  return right;
}

}  // namespace

FitTarget::FitTarget(const GatherFragment& fragment)
    : film(fragment.film),
      p(fragment.p),
      n(fragment.n),
      ng(fragment.ng),
      depth(Real(fragment.depth)) {
  const Frame frame = Frame::FromZ(ng);
  s = frame.x;
  t = frame.y;
}

FitFeatures FitTarget::FeaturesOf(Point2 samplePosition, const Normal3& sampleNormal) const {
  const Normal3 tilt = sampleNormal - n;
  return {1, (samplePosition.x - film.x) * kFilmScale, (samplePosition.y - film.y) * kFilmScale,
          Dot(tilt, s), Dot(tilt, t)};
}

void FitNeighbours::Reserve(std::size_t count) {
  if (columns[0].size() >= size + count) return;
  for (auto& column : columns) column.resize(2 * (size + count));
}

void LocalFit::Collect(const FragmentRows& rows, const Place& place,
                       std::span<const FragmentRows::Column> sets, FitNeighbours* out) {
  const LocalFitLoops& loops = *Loops().back();
  out->Clear();
  const int reach = int(std::ceil(place.radius));
  const Point2i pixel = place.pixel;
  for (int y = pixel.y - reach; y <= pixel.y + reach; ++y) {
    const FragmentRows::Range range = rows.Fragments(pixel.x - reach, pixel.x + reach + 1, y);
    if (range.begin == range.end) continue;
    out->Reserve(range.end - range.begin + FitNeighbours::kRun);
    loops.describe(rows, range, place.target, sets, out);
  }
}

LocalFit::LocalFit(const FitNeighbours& neighbours, Real radius, int set) {
  FitMoments moments;
  Loops().back()->accumulate(neighbours, radius, set, &moments);
  total_ = moments.matrix[0];
  if (IsEmpty()) return;
  Matrix matrix = NormalMatrix(moments, double(Square(radius * FitTarget::kFilmScale)));
  Factor(&matrix);
  for (int c = 0; c < Spectrum::kChannels; ++c) {
    std::array<double, kFitFeatures> right;
    for (std::size_t i = 0; i < kFitFeatures; ++i)
      right[i] = double(moments.right[i][std::size_t(c)]);
    const auto solution = Solve(matrix, right);
    for (std::size_t i = 0; i < kFitFeatures; ++i) coefficients_[i][c] = Real(solution[i]);
  }
}

Spectrum LocalFit::At(const FitFeatures& features) const {
  Spectrum light;
  for (std::size_t i = 0; i < kFitFeatures; ++i) light += coefficients_[i] * features[i];
  return Clamp(light, 0, std::numeric_limits<Real>::max());
}

}  // namespace exphoton
