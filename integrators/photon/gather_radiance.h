// SPDX-License-Identifier: BSD-2-Clause
// GatherRadiance: what a gather ray brings back: the nearest radiance photon where one serves the
// hit, else the density estimates of the three maps there. Specular lobes are followed. Emission
// never counts: direct lighting has it, or the caustic map.
#pragma once

#include "core/lights/light_distribution.h"
#include "integrators/photon/photon_maps.h"
#include "integrators/photon/radiance_map.h"

namespace exphoton {

class GatherRadiance {
 public:
  // Both maps must outlive this. Without radiance photons (radianceMap null) every hit takes the
  // three density estimates.
  GatherRadiance(const PhotonMaps& maps, const RadianceMap* radianceMap,
                 const PhotonSettings& settings, const LightDistribution& lights)
      : maps_(maps), radianceMap_(radianceMap), settings_(settings), lights_(lights) {}

  // Radiance arriving along the ray, by the light that maps hold. `random`: of this shading point.
  Spectrum operator()(const Ray& ray, LiContext& context, RandomStream* random) const {
    return Along(ray, context, random, 0);
  }

 private:
  // How often short rays may be followed by one more bounce.
  static constexpr int kMaxShortBounces = 3;

  Spectrum Along(RayDifferential ray, LiContext& context, RandomStream* random,
                 int shortBounces) const;
  // The non-specular part of what leaves the hit towards the ray's origin.
  Spectrum NonSpecular(const Scene::HitPoint& hit, const RayDifferential& ray, LiContext& context,
                       RandomStream* random, int shortBounces) const;
  // The whole record of a hit, with its BSDF in the context's arena.
  ShadingPoint Shade(const Scene::HitPoint& hit, const RayDifferential& ray,
                     LiContext& context) const;
  // Irradiance mode: what the hit makes of the irradiance on its two sides.
  Spectrum Reflected(const Scene::HitPoint& hit, const RayDifferential& ray,
                     const RadianceMap::Entry& front, LiContext& context) const;
  // One more bounce instead of a blurred estimate: direct light, caustics, one gather ray.
  Spectrum OneMoreBounce(const ShadingPoint& point, LiContext& context, RandomStream* random,
                         int shortBounces) const;

  const PhotonMaps& maps_;
  const RadianceMap* radianceMap_;
  const PhotonSettings& settings_;
  const LightDistribution& lights_;
};

}  // namespace exphoton
