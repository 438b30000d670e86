// SPDX-License-Identifier: BSD-2-Clause
// GuideDensity is the directional density of a guide: cones about the followed directions
// (cone_mixture.h), the histogram of Jensen 1995 or the footprints of Hey and Purgathofer 2002.
// "gathersampling" selects one of them. Each is sampled exactly, so a gather is unbiased with any.
#pragma once

#include "integrators/photon/gather/cone_mixture.h"
#include "integrators/photon/gather/photon_guide.h"

namespace exphoton {

class GuideDensity {
 public:
  GuideDensity(const GuidedDirections& guide, const Cone& cone)
      : cones_(guide.axes, cone), histogram_(guide.histogram), footprints_(guide.footprints) {}

  bool IsEmpty() const { return cones_.IsEmpty(); }
  // Draws a direction from three uniform numbers; the first picks a photon, or a cell of photons.
  ConeMixture::Sample Draw(Real uPick, Point2 u) const {
    if (histogram_) return histogram_->Draw(uPick, u);
    if (footprints_) return footprints_->Draw(uPick, u);
    return cones_.Draw(uPick, u);
  }
  // Returns the density of Draw per solid angle.
  Real Pdf(const Vector3& w) const {
    if (histogram_) return histogram_->Pdf(w);
    if (footprints_) return footprints_->Pdf(w);
    return cones_.Pdf(w);
  }

 private:
  ConeMixture cones_;
  const DirectionHistogram* histogram_;
  const PhotonFootprints* footprints_;
};

}  // namespace exphoton
