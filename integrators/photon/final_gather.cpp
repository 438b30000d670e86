// SPDX-License-Identifier: BSD-2-Clause
// FinalGather: sample requests and the choice of guiding photons.
#include "integrators/photon/final_gather.h"

#include "integrators/photon/direction_order.h"
#include "integrators/photon/rest_pose.h"

namespace exphoton {

FinalGather::FinalGather(const PhotonSettings& settings)
    : guideCount_(settings.gatherPhotons),
      coneAngle_(Radians(settings.gatherAngle)),
      rrThreshold_(settings.rrThreshold) {
  const bool isGuided = settings.gatherSampling == GatherSampling::Photons;
  photonCount_ = isGuided ? settings.finalGatherSamples / 2 : 0;
  bsdfCount_ = settings.finalGatherSamples - photonCount_;
}

void FinalGather::RequestSamples(bool gathers, SampleLayout* layout) {
  const int bsdf = gathers ? bsdfCount_ : 0, photons = gathers ? photonCount_ : 0;
  bsdfDirections_ = layout->Request2D(bsdf);
  bsdfLobes_ = layout->Request1D(bsdf);
  photonDirections_ = layout->Request2D(photons);
  photonRadii_ = layout->Request1D(photons);
}

ConeMixture::Axes FinalGather::GuideDirections(const ShadingPoint& point, const PhotonMap& guide,
                                               Arena* arena) const {
  if (photonCount_ == 0 || guide.IsEmpty()) return {};
  const RestPose rest(point.surface);
  const NearPoints near = guide.Nearest(rest.Point(point.surface.p), guideCount_, arena);
  const std::size_t room = near.size();
  Real *const x = arena->Room<Real>(room), *const y = arena->Room<Real>(room),
              *const z = arena->Room<Real>(room);
  // Light from below the horizon of a surface that transmits none is no guide.
  const bool isTwoSided = point.bsdf.Has(LobeSet::NonSpecularTransmission);
  const Normal3 ng = FaceForward(point.surface.ng, point.Wo());
  const Normal3 ns = FaceForward(point.bsdf.Ns(), ng);
  std::size_t count = 0;
  for (const std::uint32_t photon : OrderByDirection(guide, near.index, arena)) {
    const Vector3 w = rest.DirectionBack(guide.LongDirection(photon));
    x[count] = w.x;
    y[count] = w.y;
    z[count] = w.z;
    count += isTwoSided || (Dot(w, ng) > 0 && Dot(w, ns) > 0);
  }
  for (std::size_t i = 0; i < count; ++i) {
    const Real length = std::sqrt(x[i] * x[i] + y[i] * y[i] + z[i] * z[i]);
    x[i] /= length;
    y[i] /= length;
    z[i] /= length;
  }
  return {{x, count}, {y, count}, {z, count}};
}

}  // namespace exphoton
