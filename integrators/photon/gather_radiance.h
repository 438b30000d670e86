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
  struct Segment {
    Ray ray;
    std::optional<Scene::HitPoint> hit;
    std::optional<RadianceMap::Entry> entry;  // that serves the hit; set by Look
  };

  // Everything must outlive this. Without radiance photons (radianceMap null) every hit takes the
  // three density estimates. `random`: of the shading point that gathers.
  GatherRadiance(const PhotonMaps& maps, const RadianceMap* radianceMap,
                 const PhotonSettings& settings, const LightDistribution& lights,
                 LiContext& context, RandomStream* random)
      : maps_(maps),
        radianceMap_(radianceMap),
        settings_(settings),
        lights_(lights),
        context_(context),
        random_(random) {}

  Segment Trace(const Ray& ray) const {
    return {ray, context_.IntersectPoint(ray, RayKind::Gather), std::nullopt};
  }
  // Finds the radiance photons that serve the hits.
  void Look(std::span<Segment> segments) const;
  // Radiance arriving along the ray, by the light that maps hold; after Look.
  Spectrum Read(const Segment& segment) const { return Along(segment, 0); }

 private:
  // How often short rays may be followed by one more bounce.
  static constexpr int kMaxShortBounces = 3;

  Segment TraceAndLook(const Ray& ray) const {
    Segment segment = Trace(ray);
    Look({&segment, 1});
    return segment;
  }
  Spectrum Along(Segment segment, int shortBounces) const;
  // The non-specular part of what leaves the hit towards the ray's origin.
  Spectrum NonSpecular(const Segment& segment, int shortBounces) const;
  // The whole record of a hit, with its BSDF in the context's arena.
  ShadingPoint Shade(const Segment& segment) const;
  // Irradiance mode: what the hit makes of the irradiance on its two sides.
  Spectrum Reflected(const Segment& segment, const RadianceMap::Entry& front) const;
  // One more bounce instead of a blurred estimate: direct light, caustics, one gather ray.
  Spectrum OneMoreBounce(const ShadingPoint& point, int shortBounces) const;

  const PhotonMaps& maps_;
  const RadianceMap* radianceMap_;
  const PhotonSettings& settings_;
  const LightDistribution& lights_;
  LiContext& context_;
  RandomStream* random_;
};

}  // namespace exphoton
