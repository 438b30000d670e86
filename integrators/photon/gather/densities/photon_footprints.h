// SPDX-License-Identifier: BSD-2-Clause
// PhotonFootprints is the guiding distribution of Hey and Purgathofer 2002 ("Importance Sampling
// with Hemispherical Particle Footprints"). Each photon has a footprint about its direction, which
// is narrow where photons are dense and wide where they are sparse. A footprint is a cone here, as
// wide as the angle to the kNeighbours-th nearest direction of another photon.
#pragma once

#include <algorithm>
#include <array>

#include "integrators/photon/gather/cone_mixture.h"

namespace exphoton {

class PhotonFootprints {
 public:
  static constexpr std::size_t kNeighbours = 5;

  // The arena must outlive this object, and so must the arena of the directions.
  PhotonFootprints(const ConeDirections& axes, Arena* arena)
      : axes_(axes), oneMinusCos_(arena->AllocateArray<Real>(axes.size())) {
    for (std::size_t i = 0; i < axes.size(); ++i)
      oneMinusCos_[i] = std::clamp(Neighbourhood(i), kNarrowest, kWidest);
  }

  bool IsEmpty() const { return axes_.size() == 0; }

  // Draws a direction: uPhoton picks the photon, u the direction in its footprint. There must be a
  // photon.
  ConeMixture::Sample Draw(Real uPhoton, Point2 u) const {
    const auto own = std::min(std::size_t(uPhoton * Real(axes_.size())), axes_.size() - 1);
    const Vector3 w = Frame::FromZ(axes_[own]).ToWorld(SampleUniformCone(u, oneMinusCos_[own]));
    // The chosen footprint holds w by construction, despite rounding. The others are tested.
    return {w, Density(w, own)};
  }
  // Returns the density of Draw per solid angle.
  Real Pdf(const Vector3& w) const { return Density(w, axes_.size()); }

 private:
  static constexpr Real kNarrowest = Real(1.5e-4);  // 1 degree
  static constexpr Real kWidest = Real(.5);         // 60 degrees

  // Half of the squared distance of two directions is one minus the cosine of their angle.
  Real OneMinusCosTo(std::size_t i, const Vector3& w) const {
    return LengthSquared(axes_[i] - w) / 2;
  }
  Real Neighbourhood(std::size_t i) const {
    std::array<Real, kNeighbours> nearest;
    nearest.fill(kWidest);
    for (std::size_t j = 0; j < axes_.size(); ++j) {
      if (j == i) continue;
      Real distance = OneMinusCosTo(j, axes_[i]);
      for (Real& place : nearest)
        if (distance < place) std::swap(distance, place);
    }
    return nearest.back();
  }
  Real Density(const Vector3& w, std::size_t own) const {
    Real sum = 0;
    for (std::size_t i = 0; i < axes_.size(); ++i)
      if (i == own || OneMinusCosTo(i, w) <= oneMinusCos_[i])
        sum += UniformConePdf(oneMinusCos_[i]);
    return sum / Real(axes_.size());
  }

  ConeDirections axes_;
  Real* oneMinusCos_;  // of the half-angles of the footprints
};

}  // namespace exphoton
