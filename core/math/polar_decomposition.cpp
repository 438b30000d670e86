// SPDX-License-Identifier: BSD-2-Clause
// This file has the polar decomposition by Newton's iteration, and the conversion between rotation
// matrices and turns about an axis.
#include "core/math/polar_decomposition.h"

#include <algorithm>
#include <cmath>

namespace exphoton {
namespace {

double LargestEntry(const Matrix3& a) {
  double largest = 0;
  for (const auto& row : a)
    for (const double v : row) largest = std::max(largest, std::abs(v));
  return largest;
}

bool AllFinite(const Matrix3& a) {
  for (const auto& row : a)
    for (const double v : row)
      if (!std::isfinite(v)) return false;
  return true;
}

Matrix3 Scaled(const Matrix3& a, double factor) {
  Matrix3 b = a;
  for (auto& row : b)
    for (double& v : row) v *= factor;
  return b;
}

// Returns the unit quaternion (w, x, y, z) of a rotation, with w >= 0. It divides by the largest
// component, which avoids cancellation.
std::array<double, 4> QuaternionOf(const Matrix3& r) {
  const double trace = r[0][0] + r[1][1] + r[2][2];
  // `squares` holds 4 q_i^2 - 1 for each component q_i.
  const std::array<double, 4> squares{trace, 2 * r[0][0] - trace, 2 * r[1][1] - trace,
                                      2 * r[2][2] - trace};
  const auto largest =
      std::size_t(std::max_element(squares.begin(), squares.end()) - squares.begin());
  const double twice = std::sqrt(1 + squares[largest]), rest = .5 / twice;
  std::array<double, 4> q;
  if (largest == 0) {
    q = {twice / 2, (r[2][1] - r[1][2]) * rest, (r[0][2] - r[2][0]) * rest,
         (r[1][0] - r[0][1]) * rest};
  } else {
    const std::size_t i = largest - 1, j = (i + 1) % 3, k = (i + 2) % 3;
    q[0] = (r[k][j] - r[j][k]) * rest;
    q[i + 1] = twice / 2;
    q[j + 1] = (r[i][j] + r[j][i]) * rest;
    q[k + 1] = (r[i][k] + r[k][i]) * rest;
  }
  if (q[0] < 0)
    for (double& v : q) v = -v;
  return q;
}

}  // namespace

Matrix3 operator*(const Matrix3& a, const Matrix3& b) {
  Matrix3 c;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      c[i][j] = a[i][0] * b[0][j] + a[i][1] * b[1][j] + a[i][2] * b[2][j];
  return c;
}

Matrix3 Transpose(const Matrix3& a) {
  Matrix3 t;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) t[i][j] = a[j][i];
  return t;
}

double Determinant(const Matrix3& a) {
  return a[0][0] * (a[1][1] * a[2][2] - a[1][2] * a[2][1]) -
         a[0][1] * (a[1][0] * a[2][2] - a[1][2] * a[2][0]) +
         a[0][2] * (a[1][0] * a[2][1] - a[1][1] * a[2][0]);
}

Matrix3 Inverse(const Matrix3& a) {
  const double inverse = 1 / Determinant(a);
  Matrix3 b;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      const std::size_t i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
      b[j][i] = (a[i1][j1] * a[i2][j2] - a[i1][j2] * a[i2][j1]) * inverse;
    }
  return b;
}

std::optional<PolarParts> PolarDecomposition(const Matrix3& a) {
  // Near convergence each step squares the distance of the singular values from 1. The scaling by
  // `balance` brings them near 1.
  constexpr int kMaxSteps = 60;
  constexpr double kConverged = 1e-15;
  const double size = LargestEntry(a);
  if (!AllFinite(a) || size == 0) return std::nullopt;
  Matrix3 r = Scaled(a, 1 / size);
  bool isScaled = true;
  for (int step = 0; step < kMaxSteps; ++step) {
    if (Determinant(r) == 0) return std::nullopt;
    const Matrix3 inverse = Transpose(Inverse(r));
    if (!AllFinite(inverse)) return std::nullopt;
    const double balance = isScaled ? std::sqrt(LargestEntry(inverse) / LargestEntry(r)) : 1;
    double change = 0;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) {
        const double next = (r[i][j] * balance + inverse[i][j] / balance) / 2;
        change = std::max(change, std::abs(next - r[i][j]));
        r[i][j] = next;
      }
    if (change < 1e-2) isScaled = false;
    if (change <= kConverged) break;
    if (step + 1 == kMaxSteps && change > 1e-12) return std::nullopt;
  }
  if (Determinant(r) < 0) r = Scaled(r, -1);
  const Matrix3 product = Transpose(r) * a;
  PolarParts parts{r, product};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) parts.stretch[i][j] = (product[i][j] + product[j][i]) / 2;
  return parts;
}

AxisAngle AxisAngleOf(const Matrix3& rotation) {
  const auto q = QuaternionOf(rotation);
  const double sine = std::hypot(q[1], q[2], q[3]);
  if (!(sine > 0)) return {};
  return {{q[1] / sine, q[2] / sine, q[3] / sine}, 2 * std::atan2(sine, q[0])};
}

Matrix3 RotationOf(const AxisAngle& axisAngle) {
  const auto& a = axisAngle.axis;
  const double s = std::sin(axisAngle.angle), c = std::cos(axisAngle.angle);
  Matrix3 r;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) r[i][j] = a[i] * a[j] * (1 - c) + (i == j ? c : 0.);
  r[0][1] -= a[2] * s, r[1][0] += a[2] * s;
  r[0][2] += a[1] * s, r[2][0] -= a[1] * s;
  r[1][2] -= a[0] * s, r[2][1] += a[0] * s;
  return r;
}

}  // namespace exphoton
