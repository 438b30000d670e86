// SPDX-License-Identifier: BSD-2-Clause
// ConeMixture: directions round those of nearby photons: pick one of m axes uniformly, then a
// direction uniform in the cone about it (docs/exphotonmap.md, eq. 15). Sampling and density share
// one idea of what a cone holds; small angles lose nothing.
#pragma once

#include <span>

#include "core/math/sampling.h"

namespace exphoton {

class ConeMixture {
 public:
  // Unit directions, one component after the other so that membership is tested many at a time.
  struct Axes {
    std::span<const Real> x, y, z;
    std::size_t size() const { return x.size(); }
    Vector3 operator[](std::size_t j) const { return {x[j], y[j], z[j]}; }
  };

  // Axes must outlive this; halfAngle in (0, pi/2].
  ConeMixture(const Axes& axes, Real halfAngle)
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
    return {w, Density(CountHolding(w) + !Contains(own, w))};
  }
  // Density of Draw per solid angle.
  Real Pdf(const Vector3& w) const {
    const int holding = CountHolding(w);
    return holding == 0 ? Real(0) : Density(holding);
  }

 private:
  // By the chord: |w - axis|^2 <= 4 sin^2(a/2) = 2 (1 - cos a).
  bool Contains(std::size_t j, const Vector3& w) const {
    const Real dx = axes_.x[j] - w.x, dy = axes_.y[j] - w.y, dz = axes_.z[j] - w.z;
    return dx * dx + dy * dy + dz * dz <= 2 * oneMinusCos_;
  }
  int CountHolding(const Vector3& w) const {
    int holding = 0;
    for (std::size_t j = 0; j < axes_.size(); ++j) holding += Contains(j, w);
    return holding;
  }
  Real Density(int holding) const {
    return Real(holding) / Real(axes_.size()) * UniformConePdf(oneMinusCos_);
  }

  Axes axes_;
  Real oneMinusCos_;
};

}  // namespace exphoton
