// SPDX-License-Identifier: BSD-2-Clause
// A linear map as a stretch followed by a rotation, so that maps can be interpolated: rotations by
// their angle, stretches entry by entry. Source: Shoemake and Duff 1992, "Matrix Animation and
// Polar Decomposition"; iteration of Higham 1986, "Computing the Polar Decomposition".
#pragma once

#include <array>
#include <optional>

namespace exphoton {

using Matrix3 = std::array<std::array<double, 3>, 3>;

Matrix3 operator*(const Matrix3& a, const Matrix3& b);
Matrix3 Transpose(const Matrix3& a);
double Determinant(const Matrix3& a);
// By cofactors; not finite where the determinant is 0.
Matrix3 Inverse(const Matrix3& a);

struct PolarParts {
  Matrix3 rotation;  // proper: determinant 1
  Matrix3 stretch;   // symmetric; positive definite, or negative definite where the map mirrors
};

// a = rotation * stretch; nullopt where a is singular to working precision or not finite.
std::optional<PolarParts> PolarDecomposition(const Matrix3& a);

// A rotation by `angle` (radians, 0 to pi) about the unit `axis`, as Transform::Rotate turns.
struct Turn {
  std::array<double, 3> axis{0, 0, 1};
  double angle = 0;
};
Turn TurnOf(const Matrix3& rotation);
Matrix3 RotationOf(const Turn& turn);

}  // namespace exphoton
