// SPDX-License-Identifier: BSD-2-Clause
// ConeMixture: directions round those of nearby photons: pick one of m axes uniformly, then a
// direction uniform in the cone about it (docs/exphotonmap.md, eq. 15). Sampling and density share
// one idea of what a cone holds; small angles lose nothing.
#pragma once

#include "core/math/sampling.h"
#include "integrators/photon/cone_axes.h"

namespace exphoton {

class ConeMixture {
 public:
  // The axes' arena must outlive this; halfAngle in (0, pi/2].
  ConeMixture(const ConeAxes& axes, Real halfAngle)
      : axes_(axes), oneMinusCos_(OneMinusCos(halfAngle)) {}

  bool IsEmpty() const { return axes_.size() == 0; }

  struct Sample {
    Vector3 w;  // unit
    Real pdf;   // per solid angle, > 0
  };
  // uAxis picks the axis, u the direction. Must not be empty.
  Sample Draw(Real uAxis, Point2 u) const {
    const auto own = std::min(std::size_t(uAxis * Real(axes_.size())), axes_.size() - 1);
    const Vector3 w = Frame::FromZ(axes_[own]).ToWorld(SampleUniformCone(u, oneMinusCos_));
    // The chosen cone holds w by construction, whatever rounding says; the others by the test.
    return {w, Density(axes_.CountWithin(w, Chord2()) + !axes_.IsWithin(own, w, Chord2()))};
  }
  // Density of Draw per solid angle.
  Real Pdf(const Vector3& w) const {
    const int holding = axes_.CountWithin(w, Chord2());
    return holding == 0 ? Real(0) : Density(holding);
  }

 private:
  Real Chord2() const { return 2 * oneMinusCos_; }  // |w - axis|^2 = 4 sin^2(a/2) at the edge
  Real Density(int holding) const {
    return Real(holding) / Real(axes_.size()) * UniformConePdf(oneMinusCos_);
  }

  ConeAxes axes_;
  Real oneMinusCos_;
};

}  // namespace exphoton
