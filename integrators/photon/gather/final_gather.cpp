// SPDX-License-Identifier: BSD-2-Clause
// FinalGather divides the rays between the two techniques, and requests their samples.
#include "integrators/photon/gather/final_gather.h"

namespace exphoton {

FinalGather::FinalGather(const PhotonSettings& settings)
    : cone_(Radians(settings.gatherAngle)), rrThreshold_(settings.rrThreshold) {
  const int rays = settings.finalGatherSamples;
  const bool isGuided = settings.gatherSampling == GatherSampling::Photons && rays > 1;
  for (int guided = isGuided ? rays / 2 : 0; guided > 0; guided /= 2)
    splits_.push_back({rays - guided, guided});
  splits_.push_back({rays, 0});
  guide_ = PhotonGuide(isGuided ? settings.gatherPhotons : 0, cone_);
}

void FinalGather::RequestSamples(bool gathers, SampleLayout* layout) {
  for (Split& split : splits_) {
    const int bsdf = gathers ? split.bsdfRays : 0, photons = gathers ? split.photonRays : 0;
    split.directions = layout->Request2D(bsdf);
    split.lobes = layout->Request1D(bsdf);
    split.cones = layout->Request2D(photons);
    split.radii = layout->Request1D(photons);
  }
}

}  // namespace exphoton
