// SPDX-License-Identifier: BSD-2-Clause
// RestPose maps points of moving surfaces to the pose at the start of the motion, in which the maps
// store photons. Photons of all times then lie close together, as on a surface at rest, and a
// lookup at any time finds them. The approximation: a map holds the mean, over the shutter
// interval, of the light that arrives at a point of the moving surface. For surfaces at rest each
// call costs one comparison.
#pragma once

#include <optional>

#include "core/geometry/placement.h"
#include "core/math/motion.h"

namespace exphoton {

class RestPose {
 public:
  // The pose of a surface that is hit at `time`. motion is null for a surface at rest.
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
  // Returns the factor for the power of a photon on a surface that the motion stretches. It is the
  // area at rest divided by the current area. Density estimates divide by areas at rest, so the
  // factor turns the result into power per current area. ng is the normal in the current pose.
  Real PowerScale(const Normal3& ng) const { return toRest_ ? AreaScale(*toRest_, ng) : Real(1); }

 private:
  std::optional<Transform> toRest_, fromRest_;
};

}  // namespace exphoton
