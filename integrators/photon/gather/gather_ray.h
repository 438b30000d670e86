// SPDX-License-Identifier: BSD-2-Clause
// GatherRay computes the radiance along a gather ray. Diffuse lobes of the hit read the nearest
// valid radiance photon, or the density estimates of the three maps if there is none or the ray is
// too short (shortrays). Glossy lobes take a light sample and one ray that reads the radiance at
// its end. Specular lobes are followed. Emission at a hit counts only after a glossy bounce;
// elsewhere direct lighting or the caustic map contains it (docs/theory/exphotonmap.md, section 4).
#pragma once

#include "core/lights/selection/light_sampler.h"
#include "core/transport/integrator.h"
#include "core/transport/shading_point.h"
#include "integrators/photon/maps/photon_map_set.h"
#include "integrators/photon/maps/radiance_photon_map.h"

namespace exphoton {

class GatherRay {
 public:
  struct Segment {
    Ray ray;
    std::optional<Scene::HitPoint> hit;
    std::optional<RadiancePhotonMap::Entry> entry;  // valid for the hit; set by LookUp
  };

  // All arguments must outlive this object. Without radiance photons (radianceMap null), all
  // non-specular lobes of every hit use the three density estimates. `random` is the random stream
  // of the shading point where the gather starts.
  GatherRay(const PhotonMapSet& maps, const RadiancePhotonMap* radianceMap,
            const PhotonSettings& settings, const LightSampler& lights, LiContext& context,
            RandomStream* random);

  Segment Trace(const Ray& ray) const {
    return {ray, context_.IntersectPoint(ray, RayKind::Gather), std::nullopt};
  }
  // Finds the radiance photons that are valid for the hits.
  void LookUp(std::span<Segment> segments) const;
  // Returns the radiance arriving along the ray. LookUp must be called first.
  Spectrum Read(const Segment& segment) const { return Along(segment); }

 private:
  // Walk is the state of a gather ray that continues from surface to surface.
  struct Walk {
    Segment segment;
    Spectrum throughput{1};
    Spectrum radiance;  // found so far
    int specularBounces = 0, glossyBounces = 0;
    // Origin and density, per solid angle, of the glossy bounce that the segment begins with. The
    // density is 0 if the segment does not begin with a glossy bounce.
    SurfacePoint from;
    Real glossyPdf = 0;

    explicit Walk(const Segment& first) : segment(first) {}
    void Add(const Spectrum& found) { radiance += throughput * found; }
  };

  Segment TraceAndLookUp(const Ray& ray) const {
    Segment segment = Trace(ray);
    LookUp({&segment, 1});
    return segment;
  }
  // Returns the lobes at the end of a segment that extend the walk.
  LobeSet LobesToFollow(const Segment& segment) const {
    if (!segment.hit || !segment.hit->material) return LobeSet::None;
    return segment.hit->material->PossibleLobes() & followedLobes_;
  }
  Spectrum Along(const Segment& segment) const;
  // Replaces the segment by the next one. Returns false if the walk ends.
  bool Continue(Walk* walk) const;
  // Continues the walk from its hit along one of these lobes. Returns false if the walk ends.
  bool Bounce(LobeSet lobes, Walk* walk) const;
  bool BounceGlossy(const ShadingPoint& point, Walk* walk) const;
  bool BounceSpecular(const ShadingPoint& point, Walk* walk) const;
  // Returns the radiance from the hit to the ray's origin by the lobes that read maps.
  Spectrum FromMaps(Walk* walk) const;
  // Next event estimation for the glossy lobes towards wo, with one light chosen at random.
  Spectrum GlossyDirect(const ShadingPoint& point) const;
  // Returns the emission at the end of a segment that begins with a glossy bounce, with the MIS
  // weight against the light sample at its beginning.
  Spectrum Emission(const Walk& walk) const;
  // Returns the full record of a hit, with its BSDF in the context's arena.
  ShadingPoint Shade(const Segment& segment) const;

  const PhotonMapSet& maps_;
  const RadiancePhotonMap* radianceMap_;
  const PhotonSettings& settings_;
  const LightSampler& lights_;
  LiContext& context_;
  RandomStream* random_;
  LobeSet mappedLobes_;    // lobes that read maps
  LobeSet followedLobes_;  // lobes that extend a walk
};

}  // namespace exphoton
