// SPDX-License-Identifier: BSD-2-Clause
// Transform checks for singular matrices in its construction, and bounds rounding errors in its
// application.
#include "core/math/transform.h"

#include <cmath>

namespace exphoton {

bool AllFinite(const Matrix4& a) {
  for (const auto& row : a.m)
    for (double v : row)
      if (!std::isfinite(v)) return false;
  return true;
}

namespace {

double MaxAbs(const Matrix4& a) {
  double largest = 0;
  for (const auto& row : a.m)
    for (double v : row) largest = std::max(largest, std::abs(v));
  return largest;
}

double Determinant3(const Matrix4& a) {
  const auto& m = a.m;
  return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
         m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
         m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

}  // namespace

Matrix4 operator*(const Matrix4& a, const Matrix4& b) {
  Matrix4 c;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) {
      double sum = 0;
      for (std::size_t k = 0; k < 4; ++k) sum += a.m[i][k] * b.m[k][j];
      c.m[i][j] = sum;
    }
  return c;
}

Matrix4 Transpose(const Matrix4& a) {
  Matrix4 t;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) t.m[i][j] = a.m[j][i];
  return t;
}

// Gauss-Jordan elimination with row equilibration and partial pivoting. The equilibration scales
// each row by a power of two, so that scales of 1e-6 and 1e6 side by side stay regular. A pivot
// below 1e-30 counts as 0.
std::optional<Matrix4> Inverse(const Matrix4& a) {
  if (!AllFinite(a) || MaxAbs(a) == 0) return std::nullopt;
  std::array<std::array<double, 8>, 4> w{};
  for (std::size_t i = 0; i < 4; ++i) {
    double rowMax = 0;
    for (double v : a.m[i]) rowMax = std::max(rowMax, std::abs(v));
    if (rowMax == 0) return std::nullopt;
    int exponent;
    std::frexp(rowMax, &exponent);  // scaling by a power of two is exact
    for (std::size_t j = 0; j < 4; ++j) w[i][j] = std::ldexp(a.m[i][j], -exponent);
    w[i][i + 4] = std::ldexp(1.0, -exponent);
  }
  for (std::size_t col = 0; col < 4; ++col) {
    std::size_t pivot = col;
    for (std::size_t i = col + 1; i < 4; ++i)
      if (std::abs(w[i][col]) > std::abs(w[pivot][col])) pivot = i;
    if (!(std::abs(w[pivot][col]) > 1e-30)) return std::nullopt;
    std::swap(w[pivot], w[col]);
    const double inverse = 1 / w[col][col];
    for (double& v : w[col]) v *= inverse;
    for (std::size_t i = 0; i < 4; ++i) {
      if (i == col) continue;
      const double factor = w[i][col];
      if (factor == 0) continue;
      for (std::size_t j = 0; j < 8; ++j) w[i][j] -= factor * w[col][j];
    }
  }
  Matrix4 result;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) result.m[i][j] = w[i][j + 4];
  if (!AllFinite(result)) return std::nullopt;
  // Dependent rows leave rounding noise as pivots. The product with the inverse is then far from
  // the identity. This check also rejects condition numbers beyond the resolution of double. The
  // last column holds lengths, whose errors are relative to the translation.
  const Matrix4 product = a * result;
  double translation = 1;
  for (std::size_t i = 0; i < 3; ++i) translation = std::max(translation, std::abs(a.m[i][3]));
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) {
      const double tolerance = i < 3 && j == 3 ? 1e-4 * translation : 1e-4;
      if (!(std::abs(product.m[i][j] - (i == j ? 1.0 : 0.0)) < tolerance)) return std::nullopt;
    }
  return result;
}

Transform::Transform(const Matrix4& m, const Matrix4& inverse) : m_(m), inverse_(inverse) {}

std::optional<Transform> Transform::FromMatrix(const Matrix4& m) {
  const auto inverse = Inverse(m);
  if (!inverse) return std::nullopt;
  return Transform(m, *inverse);
}

Transform Transform::Translate(const Vector3& delta) {
  Matrix4 m, inverse;
  for (std::size_t i = 0; i < 3; ++i) {
    m.m[i][3] = double(delta[int(i)]);
    inverse.m[i][3] = -double(delta[int(i)]);
  }
  return {m, inverse};
}

std::optional<Transform> Transform::Scale(double x, double y, double z) {
  Matrix4 m, inverse;
  const double s[3] = {x, y, z};
  for (std::size_t i = 0; i < 3; ++i) {
    if (s[i] == 0 || !std::isfinite(s[i]) || !std::isfinite(1 / s[i])) return std::nullopt;
    m.m[i][i] = s[i];
    inverse.m[i][i] = 1 / s[i];
  }
  return Transform(m, inverse);
}

std::optional<Transform> Transform::Rotate(double degrees, const Vector3& axis) {
  const double ax = double(axis.x), ay = double(axis.y), az = double(axis.z);
  const double length = std::hypot(ax, ay, az);
  if (!(length > 0) || !std::isfinite(length) || !std::isfinite(degrees)) return std::nullopt;
  const double a[3] = {ax / length, ay / length, az / length};
  const double radians = degrees * (3.14159265358979323846 / 180);
  const double s = std::sin(radians), c = std::cos(radians);
  Matrix4 m;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) m.m[i][j] = a[i] * a[j] * (1 - c) + (i == j ? c : 0.0);
  m.m[0][1] -= a[2] * s;
  m.m[1][0] += a[2] * s;
  m.m[0][2] += a[1] * s;
  m.m[2][0] -= a[1] * s;
  m.m[1][2] -= a[0] * s;
  m.m[2][1] += a[0] * s;
  return Transform(m, Transpose(m));
}

std::optional<Transform> Transform::LookAt(const Point3& eye, const Point3& look,
                                           const Vector3& up) {
  const Vector3 direction = NormalizeOr(look - eye, Vector3());
  const Vector3 unitUp = NormalizeOr(up, Vector3());
  const Vector3 cross = Cross(direction, unitUp);
  if (!(Length(cross) > Real(1e-6))) return std::nullopt;
  const Vector3 right = Normalize(cross);
  const Vector3 newUp = Cross(right, direction);
  Matrix4 cameraToWorld;
  for (int i = 0; i < 3; ++i) {
    auto& row = cameraToWorld.m[std::size_t(i)];
    row = {double(right[i]), double(newUp[i]), double(direction[i]), double(eye[i])};
  }
  const auto inverse = Inverse(cameraToWorld);
  if (!inverse) return std::nullopt;
  return Transform(*inverse, cameraToWorld);
}

Point3 Transform::ApplyPoint(const Point3& p) const {
  const double x = double(p.x), y = double(p.y), z = double(p.z);
  const auto& m = m_.m;
  const double px = m[0][0] * x + m[0][1] * y + m[0][2] * z + m[0][3];
  const double py = m[1][0] * x + m[1][1] * y + m[1][2] * z + m[1][3];
  const double pz = m[2][0] * x + m[2][1] * y + m[2][2] * z + m[2][3];
  const double w = m[3][0] * x + m[3][1] * y + m[3][2] * z + m[3][3];
  if (w == 1 || w == 0) return {Real(px), Real(py), Real(pz)};
  return {Real(px / w), Real(py / w), Real(pz / w)};
}

Point3 Transform::ApplyPoint(const Point3& p, const Vector3& pError, Vector3* error) const {
  // The evaluation is in double. The error consists of the propagated error, one rounding to Real
  // and a few roundings in double.
  const Point3 result = ApplyPoint(p);
  for (int i = 0; i < 3; ++i) {
    const auto& row = m_.m[std::size_t(i)];
    const double propagated = std::abs(row[0]) * double(pError.x) +
                              std::abs(row[1]) * double(pError.y) +
                              std::abs(row[2]) * double(pError.z);
    const double magnitude = std::abs(row[0] * double(p.x)) + std::abs(row[1] * double(p.y)) +
                             std::abs(row[2] * double(p.z)) + std::abs(row[3]);
    const double rounding =
        double(kMachineEpsilon) * std::abs(double(result[i])) + 8 * 1.2e-16 * magnitude;
    (*error)[i] = Real((propagated + rounding) * (1 + double(Gamma(2))));
  }
  return result;
}

Vector3 Transform::ApplyVector(const Vector3& v) const {
  const double x = double(v.x), y = double(v.y), z = double(v.z);
  const auto& m = m_.m;
  return {Real(m[0][0] * x + m[0][1] * y + m[0][2] * z),
          Real(m[1][0] * x + m[1][1] * y + m[1][2] * z),
          Real(m[2][0] * x + m[2][1] * y + m[2][2] * z)};
}

Normal3 Transform::ApplyNormal(const Normal3& n) const {
  const double x = double(n.x), y = double(n.y), z = double(n.z);
  const auto& m = inverse_.m;
  return {Real(m[0][0] * x + m[1][0] * y + m[2][0] * z),
          Real(m[0][1] * x + m[1][1] * y + m[2][1] * z),
          Real(m[0][2] * x + m[1][2] * y + m[2][2] * z)};
}

Bounds3 Transform::ApplyBounds(const Bounds3& b) const {
  Bounds3 result;
  if (b.IsEmpty()) return result;
  for (int i = 0; i < 8; ++i) {
    Vector3 error;
    const Point3 p = ApplyPoint(b.Corner(i), Vector3(), &error);
    result.Extend(p - error);
    result.Extend(p + error);
  }
  return result;
}

bool Transform::SwapsHandedness() const { return Determinant3(m_) < 0; }

double Transform::VolumeScale() const { return std::abs(Determinant3(m_)); }

std::optional<Real> Transform::SimilarityScale() const {
  double squared[3];
  for (std::size_t i = 0; i < 3; ++i) {
    squared[i] = 0;
    for (std::size_t k = 0; k < 3; ++k) squared[i] += m_.m[k][i] * m_.m[k][i];
  }
  for (std::size_t i = 0; i < 3; ++i) {
    if (std::abs(squared[i] - squared[0]) > 2e-4 * squared[0]) return std::nullopt;
    for (std::size_t j = 0; j < i; ++j) {
      double dot = 0;
      for (std::size_t k = 0; k < 3; ++k) dot += m_.m[k][i] * m_.m[k][j];
      if (std::abs(dot) > 1e-4 * squared[0]) return std::nullopt;
    }
  }
  return Real(std::sqrt(squared[0]));
}

}  // namespace exphoton
