// SPDX-License-Identifier: BSD-2-Clause
// AnimatedTransform decomposes transformations, interpolates them and bounds the volume that they
// sweep.
#include "core/math/animated_transform.h"

#include <cmath>

namespace exphoton {
namespace {

Matrix3 LinearPart(const Matrix4& a) {
  Matrix3 b;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) b[i][j] = a.m[i][j];
  return b;
}

bool IsAffine(const Matrix4& a) {
  return a.m[3][0] == 0 && a.m[3][1] == 0 && a.m[3][2] == 0 && a.m[3][3] == 1;
}

Matrix3 Mix(const Matrix3& a, const Matrix3& b, double u) {
  Matrix3 c;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) c[i][j] = (1 - u) * a[i][j] + u * b[i][j];
  return c;
}

std::array<double, 3> Apply(const Matrix3& a, const Point3& p) {
  std::array<double, 3> q;
  for (std::size_t i = 0; i < 3; ++i)
    q[i] = a[i][0] * double(p.x) + a[i][1] * double(p.y) + a[i][2] * double(p.z);
  return q;
}

}  // namespace

std::optional<AnimatedTransform> AnimatedTransform::Between(const Transform& start,
                                                            const Transform& end, Interval times,
                                                            const char** problem) {
  AnimatedTransform animated(start);
  if (start == end) return animated;
  const auto fail = [&](const char* text) { return *problem = text, std::nullopt; };
  if (!AllFinite(start.Matrix()) || !AllFinite(end.Matrix()))
    return fail("its matrix is not finite at one end");
  if (!std::isfinite(times.min) || !std::isfinite(times.max) || times.max <= times.min)
    return fail("its times are not in order");
  if (!IsAffine(start.Matrix()) || !IsAffine(end.Matrix()))
    return fail("its matrix is projective at one end");
  if (start.SwapsHandedness() != end.SwapsHandedness())
    return fail("it is mirrored at one end and not at the other, and would be flat in between");
  animated.end_ = end;
  animated.times_ = times;
  animated.moves_ = true;
  const Matrix3 linear[2] = {LinearPart(start.Matrix()), LinearPart(end.Matrix())};
  animated.isTranslation_ = linear[0] == linear[1];
  if (animated.isTranslation_) return animated;
  const auto first = PolarDecomposition(linear[0]), last = PolarDecomposition(linear[1]);
  if (!first || !last) return fail("its matrix is singular at one end");
  animated.rotation_ = first->rotation;
  animated.relativeRotation_ = AxisAngleOf(last->rotation * Transpose(first->rotation));
  animated.stretches_[0] = first->stretch;
  animated.stretches_[1] = last->stretch;
  return animated;
}

bool AnimatedTransform::IsHalfTurn() const {
  return relativeRotation_.angle > (1 - 1e-6) * 3.14159265358979323846;
}

Transform AnimatedTransform::At(Real time) const {
  if (!moves_ || !(time > times_.min)) return start_;
  if (time >= times_.max) return end_;
  return Within((double(time) - double(times_.min)) / (double(times_.max) - double(times_.min)));
}

Transform AnimatedTransform::Within(double u) const {
  if (isTranslation_)
    return Compose(LinearPart(start_.Matrix()), LinearPart(start_.InverseMatrix()), u);
  const Matrix3 rotation =
      RotationOf({relativeRotation_.axis, u * relativeRotation_.angle}) * rotation_;
  const Matrix3 stretch = Mix(stretches_[0], stretches_[1], u);
  return Compose(rotation * stretch, Inverse(stretch) * Transpose(rotation), u);
}

Transform AnimatedTransform::Compose(const Matrix3& linear, const Matrix3& inverse,
                                     double u) const {
  Matrix4 forward, backward;
  std::array<double, 3> shift;
  for (std::size_t i = 0; i < 3; ++i)
    shift[i] = (1 - u) * start_.Matrix().m[i][3] + u * end_.Matrix().m[i][3];
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      forward.m[i][j] = linear[i][j];
      backward.m[i][j] = inverse[i][j];
    }
    forward.m[i][3] = shift[i];
    backward.m[i][3] =
        -(inverse[i][0] * shift[0] + inverse[i][1] * shift[1] + inverse[i][2] * shift[2]);
  }
  return {forward, backward};
}

// A corner x moves along f(u) = T(u) + Q(u) y(u). T and y = S(u) x are linear in u, and Q turns by
// angle a, so |f''| <= a^2 max |y| + 2 a |y'|. Between two neighbours of n + 1 equally spaced
// places, f stays within |f''| / (8 n^2) of the chord.
Bounds3 AnimatedTransform::ApplyBounds(const Bounds3& box) const {
  Bounds3 bounds = start_.ApplyBounds(box);
  if (!moves_ || bounds.IsEmpty()) return bounds;
  bounds.Extend(end_.ApplyBounds(box));
  constexpr double kPiecesPerRadian = 16;
  const double angle = relativeRotation_.angle;
  const int pieces = std::max(1, int(std::ceil(angle * kPiecesPerRadian)));
  if (!isTranslation_)  // includes both ends as recomposed, which rounding changes
    for (int i = 0; i <= pieces; ++i) bounds.Extend(Within(double(i) / pieces).ApplyBounds(box));
  double bulge = 0;
  for (int corner = 0; angle > 0 && corner < 8; ++corner) {
    const auto y0 = Apply(stretches_[0], box.Corner(corner));
    const auto y1 = Apply(stretches_[1], box.Corner(corner));
    const double reach = std::max(std::hypot(y0[0], y0[1], y0[2]), std::hypot(y1[0], y1[1], y1[2]));
    const double speed = std::hypot(y1[0] - y0[0], y1[1] - y0[1], y1[2] - y0[2]);
    bulge = std::max(bulge, angle * angle * reach + 2 * angle * speed);
  }
  const Vector3 margin(NextUp(Real(bulge / (8. * pieces * pieces))));
  if (bulge > 0) bounds = {bounds.min - margin, bounds.max + margin};
  // This margin covers the rounding of composing and applying a transformation.
  const Vector3 size = Max(Abs(bounds.min), Abs(bounds.max));
  const Vector3 rounding(MaxComponent(size) * Gamma(16));
  return {bounds.min - rounding, bounds.max + rounding};
}

}  // namespace exphoton
