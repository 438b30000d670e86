// SPDX-License-Identifier: BSD-2-Clause
// CausticRays samples the caustic light of a point without reading its map. Rays from the point
// follow specular surfaces to the emission at their end. Half of them sample the BSDF, and half of
// them cones about the directions of nearby caustic photons (balance heuristic). A ray can hit only
// lights that have a size, so the estimate is unbiased if all lights of the scene have one.
// It is noisy where rays rarely meet them (CausticCorrection).
#pragma once

#include "core/transport/integrator.h"
#include "core/transport/shading_point.h"
#include "integrators/photon/gather/cone_mixture.h"
#include "integrators/photon/gather/photon_guide.h"

namespace exphoton {

// Returns whether the scene has caustics, and rays can hit all its lights.
bool CausticRaysFindAll(const Scene& scene);

class CausticRays {
 public:
  // `guide` guides by the photons of the caustic map. All arguments must outlive this object.
  CausticRays(const PhotonGuide& guide, const Cone& cone, LiContext& context, RandomStream* random)
      : guide_(guide), cone_(cone), context_(context), random_(random) {}

  // Returns a sample of the caustic radiance that these lobes of the point scatter towards wo.
  Spectrum Sample(const ShadingPoint& point, LobeSet lobes);

 private:
  // The rays of one point, with as many by the BSDF as by the guide, if there is one.
  struct Rays {
    ConeMixture guide;
    int each = 0;  // rays of a technique

    // Returns the expected number of rays per solid angle.
    Real Pdf(const Vector3& wi, Real bsdfPdf) const {
      return Real(each) * (guide.IsEmpty() ? bsdfPdf : bsdfPdf + guide.Pdf(wi));
    }
  };

  // Return what ray `index` of a technique adds to the radiance.
  Spectrum ByBsdf(const ShadingPoint& point, const Rays& rays, LobeSet lobes, int index);
  Spectrum ByGuide(const ShadingPoint& point, const Rays& rays, LobeSet lobes, int index);
  Real InStratum(int index, int count);
  // Returns the emission at the end of a ray that meets at least one specular surface.
  Spectrum Along(Ray ray);

  const PhotonGuide& guide_;
  Cone cone_;
  LiContext& context_;
  RandomStream* random_;
};

}  // namespace exphoton
