// SPDX-License-Identifier: BSD-2-Clause
// FinalGather: how many rays by each technique, and the numbers they ask for.
#include "integrators/photon/final_gather.h"

namespace exphoton {

FinalGather::FinalGather(const PhotonSettings& settings)
    : cone_(Radians(settings.gatherAngle)), rrThreshold_(settings.rrThreshold) {
  const bool isGuided = settings.gatherSampling == GatherSampling::Photons;
  photonCount_ = isGuided ? settings.finalGatherSamples / 2 : 0;
  bsdfCount_ = settings.finalGatherSamples - photonCount_;
  guide_ = GatherGuide(photonCount_ > 0 ? settings.gatherPhotons : 0, cone_);
}

void FinalGather::RequestSamples(bool gathers, SampleLayout* layout) {
  const int bsdf = gathers ? bsdfCount_ : 0, photons = gathers ? photonCount_ : 0;
  bsdfDirections_ = layout->Request2D(bsdf);
  bsdfLobes_ = layout->Request1D(bsdf);
  photonDirections_ = layout->Request2D(photons);
  photonRadii_ = layout->Request1D(photons);
}

}  // namespace exphoton
