// SPDX-License-Identifier: BSD-2-Clause
#include "core/lights/emission_cone.h"

#include <algorithm>
#include <cmath>

namespace exphoton {

// The sphere round the box is seen from the apex under the half-angle asin(radius / distance).
bool EmissionCone::MayHit(const Bounds3& box) const {
  constexpr double kMargin = 1e-3;  // radians; far more than the rounding of a direction
  const Vector3 diagonal = box.max - box.min, towards = box.Center() - apex;
  const double radius = std::sqrt(double(LengthSquared(diagonal))) / 2;
  const double distance = std::sqrt(double(LengthSquared(towards)));
  if (!std::isfinite(radius) || !(distance > radius)) return true;
  const double toCenter = std::acos(std::clamp(double(Dot(towards, axis)) / distance, -1., 1.));
  const double halfAngle = std::asin(std::clamp(radius / distance, 0., 1.));
  return !(toCenter > angle + halfAngle + kMargin);
}

}  // namespace exphoton
