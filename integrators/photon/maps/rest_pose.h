// SPDX-License-Identifier: BSD-2-Clause
// RestPose: where photons of moving surfaces are kept: not where they arrived, but where that part
// of the surface was as it began to move. Photons of all times lie close together there, as they do
// on a surface at rest, and a lookup at any time finds them. Surfaces at rest pay one comparison.
// What a map then says of a point is the mean over the exposure of what arrives there as it moves.
#pragma once

#include <optional>

#include "core/geometry/placement.h"
#include "core/math/motion.h"

namespace exphoton {

class RestPose {
 public:
  // Of a point that is hit at `time`; motion null: of a surface at rest.
  RestPose(const Motion* motion, Real time) {
    if (!motion) [[likely]]
      return;
    toRest_ = motion->ToStart(time);
    fromRest_ = toRest_->Inverted();
  }
  explicit RestPose(const SurfaceInteraction& surface) : RestPose(surface.motion, surface.time) {}

  bool IsMoved() const { return toRest_.has_value(); }
  Point3 Point(const Point3& p) const { return toRest_ ? toRest_->ApplyPoint(p) : p; }
  Normal3 Normal(const Normal3& n) const {
    return toRest_ ? NormalizeOr(toRest_->ApplyNormal(n), n) : n;
  }
  Vector3 Direction(const Vector3& w) const {
    return toRest_ ? NormalizeOr(toRest_->ApplyVector(w), w) : w;
  }
  Vector3 DirectionBack(const Vector3& w) const {
    return fromRest_ ? NormalizeOr(fromRest_->ApplyVector(w), w) : w;
  }
  // Of the power of a photon, where the surface is stretched: its density is per area now.
  Real PowerScale(const Normal3& ng) const { return toRest_ ? AreaScale(*toRest_, ng) : Real(1); }

 private:
  std::optional<Transform> toRest_, fromRest_;
};

}  // namespace exphoton
