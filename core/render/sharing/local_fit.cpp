// SPDX-License-Identifier: BSD-2-Clause
// LocalFit: collects neighbours and solves the normal equations.
#include "core/render/sharing/local_fit.h"

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <utility>

namespace exphoton {
namespace {

// The normal equations get these multiples of the total weight on their diagonal, so that features
// that do not vary, or vary together, do no harm. Film features are of the order of the radius, in
// units of 8 pixels.
constexpr double kFilmRidge = 1e-3, kTiltRidge = 2e-4;

using Matrix = std::array<std::array<double, kFitFeatures>, kFitFeatures>;

// Calls use(0), use(1) ... with constants, so that the compiler unrolls the loops in `use`.
template <std::size_t kCount, class Use>
void ForConstants(const Use& use) {
  [&use]<std::size_t... i>(std::index_sequence<i...>) {
    (use(std::integral_constant<std::size_t, i>()), ...);
  }
  (std::make_index_sequence<kCount>());
}

// Fills the lower triangle of the first rows.
template <std::size_t kSize>
void SetNormalMatrix(const FitMoments& moments, double filmVariance, Matrix* matrix) {
  Matrix& m = *matrix;
  ForConstants<kSize>([&](auto j) {
    constexpr std::size_t kDiagonal = j * kFitFeatures - j * (j - 1) / 2;
    for (std::size_t i = j; i < kSize; ++i) m[i][j] = double(moments.matrix[kDiagonal + i - j]);
  });
  const double total = m[0][0];
  for (std::size_t i = 1; i < std::min(kSize, std::size_t(3)); ++i)
    m[i][i] += total * kFilmRidge * filmVariance;
  for (std::size_t i = 3; i < kSize; ++i) m[i][i] += total * kTiltRidge;
}

// Turns the first rows and columns of a positive definite matrix into their Cholesky factor, in the
// lower triangle. The diagonal has the reciprocals, because divisions are slow.
template <std::size_t kSize>
void Factor(Matrix* matrix) {
  Matrix& m = *matrix;
  ForConstants<kSize>([&](auto j) {
    for (std::size_t k = 0; k < j; ++k) m[j][j] -= m[j][k] * m[j][k];
    m[j][j] = 1 / std::sqrt(std::max(m[j][j], 1e-30));
    for (std::size_t i = j + 1; i < kSize; ++i) {
      for (std::size_t k = 0; k < j; ++k) m[i][j] -= m[i][k] * m[j][k];
      m[i][j] *= m[j][j];
    }
  });
}

// The right sides of all channels. The fourth one belongs to one record with the light 1 at the
// target.
using Channels = std::array<double, 4>;
using RightSides = std::array<Channels, kFitFeatures>;

void SubtractMultiple(double factor, const Channels& from, Channels* to) {
  for (std::size_t c = 0; c < 4; ++c) (*to)[c] -= factor * from[c];
}

// Solves the first rows for all channels at a time, in place.
template <std::size_t kSize>
void Solve(const Matrix& factor, RightSides* sides) {
  RightSides& right = *sides;
  ForConstants<kSize>([&](auto i) {
    for (std::size_t k = 0; k < i; ++k) SubtractMultiple(factor[i][k], right[k], &right[i]);
    for (double& value : right[i]) value *= factor[i][i];
  });
  ForConstants<kSize>([&](auto fromLast) {
    constexpr std::size_t i = kSize - 1 - fromLast;
    for (std::size_t k = i + 1; k < kSize; ++k) SubtractMultiple(factor[k][i], right[k], &right[i]);
    for (double& value : right[i]) value *= factor[i][i];
  });
}

// Solves the first normal equations. The solution of the others is 0.
template <std::size_t kSize>
RightSides SolutionOf(const FitMoments& moments, double filmVariance) {
  Matrix matrix;
  SetNormalMatrix<kSize>(moments, filmVariance, &matrix);
  Factor<kSize>(&matrix);
  RightSides sides{};
  for (std::size_t i = 0; i < kSize; ++i)
    for (std::size_t c = 0; c < Spectrum::kChannels; ++c) sides[i][c] = double(moments.right[i][c]);
  sides[0][3] = 1;
  Solve<kSize>(matrix, &sides);
  return sides;
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
  if (first.size() >= count) return;
  for (auto& column : columns) column.resize(2 * count * kRun);
  first.resize(2 * count);
  tilted.resize(2 * count);
}

namespace {

// Lists the ranges of fragments that hold the neighbours.
void Begin(const FragmentRows& rows, const LocalFit::Place& place, FitNeighbours* out) {
  const int reach = int(std::ceil(place.radius));
  out->rows = &rows;
  out->radius = place.radius;
  out->ranges.clear();
  std::size_t fragments = 0;
  rows.ForRowsAround(place.pixel, reach, [&](const FragmentRows::Range& range) {
    out->ranges.push_back(range);
    fragments += range.end - range.begin;
  });
  out->Reserve(fragments / FitNeighbours::kRun + out->ranges.size());
}

}  // namespace

void LocalFit::Collect(const FragmentRows& rows, const Place& place, FitNeighbours* out) {
  Begin(rows, place, out);
  Loops().back()->describe(place.target, out);
}

void LocalFit::CollectPlaces(const FragmentRows& rows, const Place& place, FitNeighbours* out) {
  Begin(rows, place, out);
  Loops().back()->locate(place.target, out);
}

LocalFit::LocalFit(const FitNeighbours& neighbours, Real radius, FragmentRows::Column set) {
  FitMoments moments;
  Loops().back()->accumulate(neighbours, radius, set, &moments);
  total_ = moments.matrix[0];
  if (IsEmpty()) return;
  const double filmVariance = double(Square(radius * FitTarget::kFilmScale));
  // Without tilt, the equations of the tilt are 0 but for their diagonal.
  const RightSides solution = neighbours.tiltedRuns > 0
                                  ? SolutionOf<kFitFeatures>(moments, filmVariance)
                                  : SolutionOf<3>(moments, filmVariance);
  for (std::size_t i = 0; i < kFitFeatures; ++i)
    coefficients_[i] = {Real(solution[i][0]), Real(solution[i][1]), Real(solution[i][2])};
  influence_ = Real(solution[0][3]);
}

Spectrum LocalFit::At(const FitFeatures& features) const {
  Spectrum light;
  for (std::size_t i = 0; i < kFitFeatures; ++i) light += coefficients_[i] * features[i];
  return Clamp(light, 0, std::numeric_limits<Real>::max());
}

}  // namespace exphoton
