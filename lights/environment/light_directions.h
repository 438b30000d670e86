// SPDX-License-Identifier: BSD-2-Clause
// LightDirections maps directions between world space and the space of a light. Lengths do not
// matter. A transformation that is not a similarity stretches solid angles.
#pragma once

#include "core/geometry/vec3d.h"
#include "core/math/transform.h"

namespace exphoton {

class LightDirections {
 public:
  explicit LightDirections(const Transform& lightToWorld)
      : toWorld_(lightToWorld),
        toLight_(lightToWorld.Inverted()),
        keepsSolidAngles_(lightToWorld.SimilarityScale().has_value()),
        determinant_(lightToWorld.VolumeScale()) {}

  Vector3 ToLight(const Vector3& w) const {
    return NormalizeOr(toLight_.ApplyVector(w), {0, 0, 1});
  }
  Vector3 ToWorld(const Vector3& local) const {
    return NormalizeOr(toWorld_.ApplyVector(local), {0, 0, 1});
  }
  // Returns whether DensityFactor is 1 everywhere, up to rounding.
  bool KeepsSolidAngles() const { return keepsSolidAngles_; }
  // Returns the factor from a density per solid angle at `local` in light space to the density in
  // world space. The transformation M stretches solid angles by |det M| / |M w|^3. Double precision
  // holds this cube for every scale.
  Real DensityFactor(const Vector3& local) const {
    const double stretch = Length(Vec3d(toWorld_.ApplyVector(local)));
    return Real(stretch * stretch * stretch / determinant_);
  }

 private:
  Transform toWorld_, toLight_;
  bool keepsSolidAngles_;
  double determinant_;
};

}  // namespace exphoton
