// SPDX-License-Identifier: BSD-2-Clause
// GatherRay: the radiance along a gather ray. Diffuse lobes of the hit read the nearest
// radiance photon, or take the density estimates of the three maps where none is valid. Glossy
// lobes are sampled: light samples, and one ray that reads the radiance at its end. Specular lobes
// are followed. Emission at a hit counts only after a glossy bounce; everywhere else direct
// lighting or the caustic map holds that light (docs/theory/exphotonmap.md, section 4).
#pragma once

#include "core/transport/light_sampler.h"
#include "integrators/photon/maps/photon_map_set.h"
#include "integrators/photon/maps/radiance_photon_map.h"

namespace exphoton {

class GatherRay {
 public:
  struct Segment {
    Ray ray;
    std::optional<Scene::HitPoint> hit;
    std::optional<RadiancePhotonMap::Entry> entry;  // valid for the hit; set by Look
  };

  // Everything must outlive this. Without radiance photons (radianceMap null) all non-specular
  // lobes of every hit take the three density estimates. `random`: of the shading point that
  // gathers.
  GatherRay(const PhotonMapSet& maps, const RadiancePhotonMap* radianceMap,
            const PhotonSettings& settings, const LightSampler& lights, LiContext& context,
            RandomStream* random);

  Segment Trace(const Ray& ray) const {
    return {ray, context_.IntersectPoint(ray, RayKind::Gather), std::nullopt};
  }
  // Finds the radiance photons that are valid for the hits.
  void Look(std::span<Segment> segments) const;
  // Radiance arriving along the ray, by the light that maps hold; after Look.
  Spectrum Read(const Segment& segment) const { return Along(segment); }

 private:
  // A gather ray on its way from lobe to lobe.
  struct Walk {
    Segment segment;
    Spectrum throughput{1};
    Spectrum radiance;  // found so far
    int specularBounces = 0, glossyBounces = 0;
    // The glossy bounce that the segment begins with: its place, and its density per solid angle;
    // 0: the segment begins otherwise.
    SurfacePoint from;
    Real glossyPdf = 0;

    explicit Walk(const Segment& first) : segment(first) {}
    void Add(const Spectrum& found) { radiance += throughput * found; }
  };

  Segment TraceAndLook(const Ray& ray) const {
    Segment segment = Trace(ray);
    Look({&segment, 1});
    return segment;
  }
  // The lobes at the end of a segment that lead the walk on.
  LobeSet LobesToFollow(const Segment& segment) const {
    if (!segment.hit || !segment.hit->material) return LobeSet::None;
    return segment.hit->material->PossibleLobes() & followedLobes_;
  }
  Spectrum Along(const Segment& segment) const;
  // Replaces the segment by the next one; false where the walk ends.
  bool GoOn(Walk* walk) const;
  // By one of these lobes at the end of the walk's segment.
  bool Bounce(LobeSet lobes, Walk* walk) const;
  bool BounceGlossy(const ShadingPoint& point, Walk* walk) const;
  bool BounceSpecular(const ShadingPoint& point, Walk* walk) const;
  // Radiance by the lobes that maps are read for, from the hit towards the ray's origin.
  Spectrum FromMaps(Walk* walk) const;
  // Radiance by the glossy lobes towards wo, of one light chosen at random.
  Spectrum GlossyDirect(const ShadingPoint& point) const;
  // What the end of a segment emits that begins with a glossy bounce, weighted against the light
  // sample at its begin.
  Spectrum Emission(const Walk& walk) const;
  // The whole record of a hit, with its BSDF in the context's arena.
  ShadingPoint Shade(const Segment& segment) const;

  const PhotonMapSet& maps_;
  const RadiancePhotonMap* radianceMap_;
  const PhotonSettings& settings_;
  const LightSampler& lights_;
  LiContext& context_;
  RandomStream* random_;
  LobeSet mappedLobes_;    // what maps are read for
  LobeSet followedLobes_;  // what leads a walk on
};

}  // namespace exphoton
