// SPDX-License-Identifier: BSD-2-Clause
// CausticCorrection corrects the light of the caustic map, for a certificate. It uses CausticRays
// where these rays find the lights often enough. Otherwise corrections compare two radii of the
// kernel, which know less about the blur of the map, but have little noise. The choice is made at
// the first correction, because most renders have none.
#pragma once

#include <mutex>

#include "core/transport/specular/specular_tree.h"
#include "integrators/photon/gather/photon_guide.h"
#include "integrators/photon/maps/photon_map_set.h"

namespace exphoton {

class CausticCorrection {
 public:
  // All arguments must outlive this object.
  CausticCorrection(const Scene& scene, const PhotonMapSet& maps, const PhotonSettings& settings)
      : scene_(scene), maps_(maps), settings_(settings) {}

  // Returns the guide of CausticRays; null: corrections compare two radii of the kernel. The result
  // depends on scene, settings and photons alone.
  const PhotonGuide* Guide() const;
  // Corrects the caustic of a visible point, which has this light, for a random choice of points.
  // There must be a guide, and context.correction receives the result.
  void Correct(const ShadingPoint& point, const SurfaceLight& light, LiContext& context) const;

 private:
  bool FindsLight(const PhotonGuide& guide) const;

  const Scene& scene_;
  const PhotonMapSet& maps_;
  const PhotonSettings& settings_;
  mutable std::once_flag isChosen_;
  mutable PhotonGuide guide_;  // on: for CausticRays
};

}  // namespace exphoton
