// SPDX-License-Identifier: BSD-2-Clause
// Cone is the set of directions within an angle of an axis. It stores one minus the cosine of the
// angle and tests chord lengths, which keeps small angles exact.
#pragma once

#include "core/math/sampling/sampling.h"

namespace exphoton {

class Cone {
 public:
  Cone() = default;
  explicit Cone(Real halfAngle) : oneMinusCos_(OneMinusCos(halfAngle)) {}  // in (0, pi/2]

  // A cone holds w if |w - axis|^2 is at most this: 4 sin^2(a/2).
  Real Chord2() const { return 2 * oneMinusCos_; }
  // Samples a direction uniformly in the cone about `axis`.
  Vector3 Sample(const Vector3& axis, Point2 u) const {
    return Frame::FromZ(axis).ToWorld(SampleUniformCone(u, oneMinusCos_));
  }
  Real Pdf() const { return UniformConePdf(oneMinusCos_); }  // density of Sample per solid angle

 private:
  Real oneMinusCos_ = 1;
};

}  // namespace exphoton
