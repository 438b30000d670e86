// SPDX-License-Identifier: BSD-2-Clause
// PolarDecomposition splits a linear map into a stretch followed by a rotation, so that maps can be
// interpolated: rotations by their angle, stretches entry by entry. Source: Shoemake and Duff 1992,
// "Matrix Animation and Polar Decomposition"; the iteration is from Higham 1986, "Computing the
// Polar Decomposition".
#pragma once

#include <array>
#include <optional>

namespace exphoton {

using Matrix3 = std::array<std::array<double, 3>, 3>;

Matrix3 operator*(const Matrix3& a, const Matrix3& b);
Matrix3 Transpose(const Matrix3& a);
double Determinant(const Matrix3& a);
// Uses cofactors. The result is not finite if the determinant is 0.
Matrix3 Inverse(const Matrix3& a);

struct PolarParts {
  Matrix3 rotation;  // proper: determinant 1
  Matrix3 stretch;   // symmetric; positive definite, or negative definite if the map mirrors
};

// Decomposes a = rotation * stretch. Returns nullopt if a is singular to working precision or not
// finite.
std::optional<PolarParts> PolarDecomposition(const Matrix3& a);

// AxisAngle is a rotation by `angle` (radians, 0 to pi) about the unit `axis`, in the sense of
// Transform::Rotate.
struct AxisAngle {
  std::array<double, 3> axis{0, 0, 1};
  double angle = 0;
};
AxisAngle AxisAngleOf(const Matrix3& rotation);
Matrix3 RotationOf(const AxisAngle& axisAngle);

}  // namespace exphoton
