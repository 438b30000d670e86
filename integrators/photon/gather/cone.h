// SPDX-License-Identifier: BSD-2-Clause
// Cone: the directions within an angle of an axis. Small angles lose nothing: an angle is kept as
// one minus its cosine, and tested by the chord.
#pragma once

#include "core/math/sampling/sampling.h"

namespace exphoton {

class Cone {
 public:
  Cone() = default;
  explicit Cone(Real halfAngle) : oneMinusCos_(OneMinusCos(halfAngle)) {}  // in (0, pi/2]

  // Holds w where |w - axis|^2 is no more than this: 4 sin^2(a/2).
  Real Chord2() const { return 2 * oneMinusCos_; }
  // Uniform over the directions that it holds.
  Vector3 Sample(const Vector3& axis, Point2 u) const {
    return Frame::FromZ(axis).ToWorld(SampleUniformCone(u, oneMinusCos_));
  }
  Real Pdf() const { return UniformConePdf(oneMinusCos_); }  // of Sample, per solid angle

 private:
  Real oneMinusCos_ = 1;
};

}  // namespace exphoton
