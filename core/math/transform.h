// SPDX-License-Identifier: BSD-2-Clause
// Transform is an affine or projective transformation with its inverse. Both matrices are in
// double, so that long chains do not drift. Matrices are stored row by row; scene files write them
// column by column.
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
bool AllFinite(const Matrix4& a);
// Returns nullopt if the matrix is singular to working precision (relative pivots) or not finite.
std::optional<Matrix4> Inverse(const Matrix4& a);

class Transform {
 public:
  Transform() = default;  // identity
  Transform(const Matrix4& m, const Matrix4& inverse);

  // Returns nullopt if the matrix is singular or not finite.
  static std::optional<Transform> FromMatrix(const Matrix4& m);
  static Transform Translate(const Vector3& delta);
  static std::optional<Transform> Scale(double x, double y, double z);
  // Rotates counter-clockwise about `axis`, in left-handed coordinates as in pbrt. Returns nullopt
  // for axis 0.
  static std::optional<Transform> Rotate(double degrees, const Vector3& axis);
  // Returns the world-to-camera transformation of pbrt version 1: right = direction x up. Returns
  // nullopt if eye equals look or if up is parallel to the direction.
  static std::optional<Transform> LookAt(const Point3& eye, const Point3& look, const Vector3& up);

  Point3 ApplyPoint(const Point3& p) const;
  // Also writes a bound on the absolute error of the result to *error. pError bounds the absolute
  // error of p. Both bounds are per axis.
  Point3 ApplyPoint(const Point3& p, const Vector3& pError, Vector3* error) const;
  Vector3 ApplyVector(const Vector3& v) const;
  Normal3 ApplyNormal(const Normal3& n) const;  // by the inverse transpose; not normalised
  Bounds3 ApplyBounds(const Bounds3& b) const;

  bool SwapsHandedness() const;  // negative determinant of the upper 3x3 part
  double VolumeScale() const;    // absolute value of this determinant
  bool IsIdentity() const { return m_ == Matrix4{}; }
  // Returns the uniform scale factor if the transform is a similarity (to 1e-4 relative), else
  // nullopt.
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
