// SPDX-License-Identifier: BSD-2-Clause
// GatherRay computes the radiance along a gather ray. Diffuse lobes of the hit read the nearest
// valid radiance photon, or the density estimates of the three maps if there is none or the ray is
// too short (shortrays). Glossy lobes take a light sample and one ray that reads the radiance at
// its end. Specular lobes are followed. Russian roulette ends walks of small throughput. Emission
// at a hit counts only after a glossy bounce; elsewhere direct lighting or the caustic map contains
// it (docs/theory/exphotonmap.md, section 4).
#pragma once

#include "core/lights/selection/light_sampler.h"
#include "core/transport/integrator.h"
#include "core/transport/shading_point.h"
#include "integrators/photon/maps/photon_map_set.h"
#include "integrators/photon/radiance/radiance_photon_map.h"

namespace exphoton {

class GatherRay {
 public:
  struct Segment {
    Ray ray;
    std::optional<Scene::HitPoint> hit;
    std::optional<RadiancePhotonMap::Entry> entry;  // valid for the hit; set by LookUp
    // The radiance along the segment with the sign of each photon (signed_power.h). Read sets it if
    // LiContext::signedLight is wanted.
    Spectrum signedRadiance;
  };

  // Reads are the rays of one gather. Each ray adds weight times radiance to the radiance that
  // leaves the shading point.
  struct Reads {
    std::span<const Segment> segments;
    const Spectrum* weights;
    const Spectrum* radiances;
  };

  // GatherObserver sees every gather after its rays have read the maps.
  class GatherObserver {
   public:
    virtual ~GatherObserver() = default;
    virtual void Observe(const ShadingPoint& point, const Reads& reads) = 0;
  };
  // ReadCorrector estimates the error of what a hit reads from the maps.
  class ReadCorrector {
   public:
    virtual ~ReadCorrector() = default;
    // Returns an estimate of the true radiance of MappedLobes() at the hit of the segment, towards
    // the origin of the segment, minus `read`. throughput: luminance of the share of the hit's
    // radiance that arrives at the start of the gather ray.
    virtual Spectrum Correct(const Segment& segment, const Spectrum& read, Real throughput) = 0;
  };

  // All arguments must outlive this object. Without radiance photons (radianceMap null), all
  // non-specular lobes of every hit use the three density estimates. `random` is the random stream
  // of the shading point where the gather starts.
  GatherRay(const PhotonMapSet& maps, const RadiancePhotonMap* radianceMap,
            const PhotonSettings& settings, const LightSampler& lights, LiContext& context,
            RandomStream* random);
  void SetObserver(GatherObserver* observer) { observer_ = observer; }
  void SetCorrector(ReadCorrector* corrector) { corrector_ = corrector; }

  Segment Trace(const Ray& ray) const {
    return {ray, context_.IntersectPoint(ray, RayKind::Gather), std::nullopt, {}};
  }
  // Finds the radiance photons that are valid for the hits.
  void LookUp(std::span<Segment> segments) const;
  // Returns the radiance arriving along the ray. LookUp must be called first.
  Spectrum Read(Segment& segment) const { return Along(&segment); }
  // Whether FinalGather is to call Observe.
  bool IsObserved() const { return observer_ || context_.signedLight; }
  void Observe(const ShadingPoint& point, const Reads& reads) const;

  // The lobes whose radiance a hit reads from the maps.
  LobeSet MappedLobes() const { return mappedLobes_; }
  // Returns the full record of a hit, with its BSDF in the context's arena.
  ShadingPoint Shade(const Segment& segment) const;
  // The radiance along a ray, and the sum of the corrections of its reads.
  struct Arriving {
    Spectrum radiance, correction;
  };
  // Returns the radiance along a segment that begins at `from` in a direction sampled with density
  // `pdf` per solid angle, and not with light samples. With pdf > 0, the emission at its end counts
  // by its MIS weight against one light sample; with pdf 0 it does not count.
  Arriving Follow(const Segment& segment, const SurfacePoint& from, Real pdf) const;

 private:
  // Walk is the state of a gather ray that continues from surface to surface.
  struct Walk {
    Segment segment;
    Spectrum throughput{1};
    Spectrum radiance;        // found so far
    Spectrum correction;      // of the maps that were read, if there is a corrector
    Spectrum signedRadiance;  // if it is wanted
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
  // Returns whether a wall hides a radiance photon from a place.
  bool IsHidden(const RadiancePhotonMap::Entry& entry, const RadiancePhotonMap::Place& place) const;
  Spectrum Along(Segment* segment) const;
  void Complete(Walk* walk) const;
  // Replaces the segment by the next one. Returns false if the walk ends.
  bool Continue(Walk* walk) const;
  // Continues the walk from its hit along one of these lobes. Returns false if the walk ends.
  bool Bounce(LobeSet lobes, Walk* walk) const;
  bool BounceGlossy(const ShadingPoint& point, Walk* walk) const;
  bool BounceSpecular(const ShadingPoint& point, Walk* walk) const;
  // Returns the radiance from the hit to the ray's origin by the lobes that read maps, and adds its
  // correction and the signed radiance to the walk.
  Spectrum FromMaps(Walk* walk) const;
  // The same alone, for a hit with such lobes. signedRadiance may be null.
  Spectrum ReadMaps(const Segment& segment, Spectrum* signedRadiance) const;
  // Next event estimation for the glossy lobes towards wo, with one light chosen at random.
  Spectrum GlossyDirect(const ShadingPoint& point) const;
  // Returns the emission at the end of a segment that begins with a glossy bounce, with the MIS
  // weight against the light sample at its beginning.
  Spectrum Emission(const Walk& walk) const;

  const PhotonMapSet& maps_;
  const RadiancePhotonMap* radianceMap_;
  const PhotonSettings& settings_;
  const LightSampler& lights_;
  LiContext& context_;
  RandomStream* random_;
  LobeSet mappedLobes_;    // lobes that read maps
  LobeSet followedLobes_;  // lobes that extend a walk
  GatherObserver* observer_ = nullptr;
  ReadCorrector* corrector_ = nullptr;
};

}  // namespace exphoton
