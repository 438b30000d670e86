// SPDX-License-Identifier: BSD-2-Clause
// Affine and projective transformations with their inverses, both kept in double so that long
// chains do not drift. Matrices are stored row by row; scene files write them column by column.
#pragma once

#include <array>
#include <optional>

#include "core/math/bounds.h"
#include "core/math/vec.h"

namespace exphoton {

struct Matrix4 {
  std::array<std::array<double, 4>, 4> m{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}};

  friend bool operator==(const Matrix4&, const Matrix4&) = default;
};
Matrix4 operator*(const Matrix4& a, const Matrix4& b);
Matrix4 Transpose(const Matrix4& a);
// nullopt where the matrix is singular to working precision (relative pivots) or not finite.
std::optional<Matrix4> Inverse(const Matrix4& a);

class Transform {
 public:
  Transform() = default;  // identity
  Transform(const Matrix4& m, const Matrix4& inverse);

  // nullopt where singular or not finite.
  static std::optional<Transform> FromMatrix(const Matrix4& m);
  static Transform Translate(const Vector3& delta);
  static std::optional<Transform> Scale(double x, double y, double z);
  // Counter-clockwise about `axis` (left-handed coordinates as in pbrt); nullopt for axis 0.
  static std::optional<Transform> Rotate(double degrees, const Vector3& axis);
  // World to camera, v1 meaning: right = direction x up. nullopt where eye = look or up is
  // parallel.
  static std::optional<Transform> LookAt(const Point3& eye, const Point3& look, const Vector3& up);

  Point3 ApplyPoint(const Point3& p) const;
  // Also bounds the absolute error of the result, given that of p (per axis).
  Point3 ApplyPoint(const Point3& p, const Vector3& pError, Vector3* error) const;
  Vector3 ApplyVector(const Vector3& v) const;
  Normal3 ApplyNormal(const Normal3& n) const;  // by the inverse transpose; not normalised
  Bounds3 ApplyBounds(const Bounds3& b) const;

  bool SwapsHandedness() const;  // negative determinant of the upper 3x3 part
  double VolumeScale() const;    // its size
  bool IsIdentity() const { return m_ == Matrix4{}; }
  // Uniform scale factor where the transform is a similarity (to 1e-4 relative), else nullopt.
  std::optional<Real> SimilarityScale() const;

  const Matrix4& Matrix() const { return m_; }
  const Matrix4& InverseMatrix() const { return inverse_; }
  Transform Inverted() const { return {inverse_, m_}; }
  friend Transform operator*(const Transform& a, const Transform& b) {
    return {a.m_ * b.m_, b.inverse_ * a.inverse_};
  }
  friend bool operator==(const Transform&, const Transform&) = default;

 private:
  Matrix4 m_, inverse_;
};

}  // namespace exphoton
