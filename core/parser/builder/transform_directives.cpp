// SPDX-License-Identifier: BSD-2-Clause
// ApplyTransform multiplies the current matrix from the right, as in pbrt version 1.
#include "core/parser/builder/transform_directives.h"

#include <cmath>

#include "core/parser/builder/graphics_state.h"

namespace exphoton {
namespace {

Vec3 VectorOf(const std::vector<double>& numbers, std::size_t first) {
  return {Real(numbers[first]), Real(numbers[first + 1]), Real(numbers[first + 2])};
}

Transform Require(const std::optional<Transform>& transform, const Directive& directive,
                  const std::string& problem) {
  if (!transform) FailAt(directive.Where(), std::string(directive.spec->name) + ": " + problem);
  return *transform;
}

// kRowNoise is the tolerance for the 4th, 8th and 12th number of a matrix, relative to the 16th. It
// allows for rounding in a program that computed the matrix in double precision.
constexpr double kRowNoise = 1e-12;

// Returns the affine map of a homogeneous matrix: all numbers divided by the last. Throws for
// projective matrices, because shapes, bounds and normals use only the first three rows.
Matrix4 AffineMatrix(const Matrix4& matrix, const Directive& directive) {
  const auto& last = matrix.m[3];
  for (std::size_t column = 0; column < 3; ++column) {
    if (std::abs(last[column]) <= kRowNoise * std::abs(last[3])) continue;
    throw Error(ExitStatus::Scene,
                std::string(directive.spec->name) + ": the matrix is projective: number " +
                    std::to_string(column * 4 + 4) + " is not 0",
                directive.Where(),
                "the matrix is given column by column; the 4th, 8th and 12th number must be 0");
  }
  Matrix4 affine;  // last row: 0 0 0 1
  for (std::size_t row = 0; row < 3; ++row)
    for (std::size_t column = 0; column < 4; ++column)
      affine.m[row][column] = matrix.m[row][column] / last[3];
  return affine;
}

// Reads sixteen numbers, column by column.
Transform MatrixOf(const Directive& directive) {
  Matrix4 matrix;
  for (std::size_t column = 0; column < 4; ++column)
    for (std::size_t row = 0; row < 4; ++row)
      matrix.m[row][column] = directive.numbers[column * 4 + row];
  // FromMatrix rejects a last row of zeros and numbers that are not finite.
  if (matrix.m[3] != std::array<double, 4>{0, 0, 0, 0} && std::isfinite(matrix.m[3][3]))
    matrix = AffineMatrix(matrix, directive);
  return Require(Transform::FromMatrix(matrix), directive, "the matrix is singular");
}

Transform LookAtOf(const Directive& directive, Dialect dialect) {
  const std::vector<double>& n = directive.numbers;
  const Transform lookAt = Require(
      Transform::LookAt(VectorOf(n, 0), VectorOf(n, 3), VectorOf(n, 6)), directive,
      "the eye is the point that it looks at, or \"up\" is parallel to the direction of view");
  if (dialect == Dialect::V1) return lookAt;
  return *Transform::Scale(-1, 1, 1) * lookAt;
}

bool IsFinite(const Transform& transform) {
  double sum = 0;  // not finite if any term is not finite
  for (const Matrix4* matrix : {&transform.Matrix(), &transform.InverseMatrix()})
    for (const auto& row : matrix->m)
      for (const double value : row) sum += std::abs(value) * 1e-3;
  return std::isfinite(sum);
}

}  // namespace

bool IsTransformDirective(DirectiveId id) {
  switch (id) {
    case DirectiveId::Identity:
    case DirectiveId::Translate:
    case DirectiveId::Scale:
    case DirectiveId::Rotate:
    case DirectiveId::LookAt:
    case DirectiveId::Transform:
    case DirectiveId::ConcatTransform:
      return true;
    default:
      return false;
  }
}

Transform ApplyTransform(const Transform& current, const Directive& directive, Dialect dialect) {
  const std::vector<double>& n = directive.numbers;
  Transform step;
  switch (directive.spec->id) {
    case DirectiveId::Identity:
      return {};
    case DirectiveId::Transform:
      return MatrixOf(directive);
    case DirectiveId::ConcatTransform:
      step = MatrixOf(directive);
      break;
    case DirectiveId::Translate:
      step = Transform::Translate(VectorOf(n, 0));
      break;
    case DirectiveId::Scale:
      step = Require(Transform::Scale(n[0], n[1], n[2]), directive, "a factor is 0");
      break;
    case DirectiveId::Rotate:
      step = Require(Transform::Rotate(n[0], VectorOf(n, 1)), directive, "the axis is 0 0 0");
      break;
    case DirectiveId::LookAt:
      step = LookAtOf(directive, dialect);
      break;
    default:
      return current;
  }
  const Transform result = current * step;
  if (!IsFinite(result))
    FailAt(directive.Where(), std::string(directive.spec->name) + ": the transformation overflows");
  return result;
}

}  // namespace exphoton
