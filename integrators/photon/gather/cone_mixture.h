// SPDX-License-Identifier: BSD-2-Clause
// ConeMixture is the guiding distribution: it picks one of m axes uniformly, then a direction
// uniformly in the cone about that axis (docs/theory/exphotonmap.md, eq. 15). Sampling and density
// use the same test for the directions in a cone.
#pragma once

#include "integrators/photon/gather/cone.h"
#include "integrators/photon/gather/cone_directions.h"

namespace exphoton {

class ConeMixture {
 public:
  ConeMixture() = default;  // no axes
  // The axes' arena must outlive this object.
  ConeMixture(const ConeDirections& axes, const Cone& cone) : axes_(axes), cone_(cone) {}

  bool IsEmpty() const { return axes_.size() == 0; }

  struct Sample {
    Vector3 w;  // unit
    Real pdf;   // per solid angle, > 0
  };
  // Draws a direction: uAxis picks the axis, u the direction in its cone. There must be an axis.
  Sample Draw(Real uAxis, Point2 u) const {
    const auto own = std::min(std::size_t(uAxis * Real(axes_.size())), axes_.size() - 1);
    const Vector3 w = cone_.Sample(axes_[own], u);
    // The chosen cone holds w by construction, despite rounding. The other cones are tested.
    const Real chord2 = cone_.Chord2();
    return {w, Density(axes_.CountWithin(w, chord2) + !axes_.IsWithin(own, w, chord2))};
  }
  // Returns the density of Draw per solid angle.
  Real Pdf(const Vector3& w) const {
    const int holding = axes_.CountWithin(w, cone_.Chord2());
    return holding == 0 ? Real(0) : Density(holding);
  }

 private:
  Real Density(int holding) const { return Real(holding) / Real(axes_.size()) * cone_.Pdf(); }

  ConeDirections axes_;
  Cone cone_;
};

}  // namespace exphoton
