// SPDX-License-Identifier: BSD-2-Clause
// FinalGather estimates indirect light at a point by gather rays over its hemisphere. Some rays
// sample the BSDF, others the guiding distribution of nearby photons; the power heuristic combines
// both (Veach 1997, section 9.2; docs/theory/exphotonmap.md, eq. 16 and 17). The Incident policy
// supplies the radiance along each ray.
#pragma once

#include <vector>

#include "core/math/sampling/mis.h"
#include "core/transport/integrator.h"
#include "core/transport/shading_point.h"
#include "integrators/photon/gather/densities/guide_density.h"
#include "integrators/photon/gather/photon_guide.h"
#include "integrators/photon/maps/photon_map.h"
#include "integrators/photon/photon_settings.h"

namespace exphoton {

class FinalGather {
 public:
  FinalGather() = default;
  explicit FinalGather(const PhotonSettings& settings);

  // If `gathers` is false, it requests empty arrays. The number of requests stays the same, so the
  // samples of other requests do not change.
  void RequestSamples(bool gathers, SampleLayout* layout);

  // Guides by these photons from now on, which must outlive the passes.
  void Prepare(const PhotonMap& photons) { guide_.Prepare(photons); }

  // Integrates f * incident * |cos| over the non-specular lobes, by rays with 0 < t < infinity. All
  // rays are traced before the first one reads a map, so that the CPU caches need not hold the
  // scene and the maps at once. incident.Trace(ray) returns an Incident::Segment,
  // incident.LookUp(segments) looks up all of them together, and incident.Read(segment) returns the
  // radiance. If Incident has IsObserved(), and it returns true, incident.Observe(point, reads)
  // gets the rays with their weights and radiances.
  template <class Incident>
  Spectrum Gather(const ShadingPoint& point, LiContext& context, const Incident& incident) const;

 private:
  // Fixed for the whole gather: f, Pdf and Sample must use the same lobes.
  static constexpr LobeSet kLobes = LobeSet::NonSpecular;
  static constexpr std::uint64_t kRouletteStream = 0x676174686572ull;

  // Russian roulette (eq. 18). Returns the factor on a ray of weight c, or 0 to skip it. The
  // photons estimate how many times brighter than average its direction is: pi lightPdf / |cos|.
  // The estimate counts as at least 1, because photons may have missed light.
  Real SurvivalFactor(Real c, Real lightPdf, Real absCos, RandomStream* random) const {
    const Real expected = c * std::max(absCos, kPi * lightPdf);
    const Real threshold = rrThreshold_ * absCos;
    if (!(expected < threshold)) return 1;
    const Real survival = expected / threshold;
    return random->Uniform() < survival ? 1 / survival : Real(0);
  }

  // Split is the number of rays per technique, and the sample arrays that they read.
  struct Split {
    int bsdfRays = 0, photonRays = 0;
    int directions = -1, lobes = -1;  // of the BSDF rays: 2D, 1D
    int cones = -1, radii = -1;       // of the guided rays: 2D, 1D
  };

  // Returns all divisions of this number of rays.
  static std::vector<Split> SplitsOf(int rays, bool isGuided);
  // Let S be the total number of rays. The number of guided rays is the smallest of S/2, S/4, S/8
  // ... that is at least guide.share * S, or S/2 if none is. Without guiding directions it is 0.
  static const Split& SplitFor(const GuidedDirections& guide, const std::vector<Split>& splits) {
    if (guide.axes.size() == 0) return splits.back();
    const Split* split = splits.data();
    const Real wanted = guide.share * Real(split->bsdfRays + split->photonRays);
    while (split[1].photonRays > 0 && Real(split[1].photonRays) >= wanted) ++split;
    return *split;
  }

  // Rays are the directions to trace, with the factors on their radiance.
  struct Rays {
    Rays(std::size_t most, const Bsdf& bsdf, LiContext& context);

    Vector3* directions;
    Spectrum* weights;
    std::size_t count = 0;
    // If the gather is shared: the factors for a white diffuse surface, which `weights` then lack,
    // and the diffuse reflectance of the surface.
    Spectrum* white = nullptr;
    Spectrum reflectance;
    bool isAllShared = false;  // all light goes to `white`, and `weights` are not set

    // Adds a ray with the factor on its radiance. If the gather is shared, the diffuse part of the
    // factor goes to `white`. `scale` is the factor on the value f of a lobe.
    void Add(const Vector3& w, const Spectrum& weight, const ShadingPoint& point, Real scale) {
      directions[count] = w;
      if (white)
        Separate(weight, point, scale);
      else
        weights[count] = weight;
      ++count;
    }
    // Returns the weights with the diffuse part, whether the gather is shared or not.
    const Spectrum* AllWeights(LiContext& context) const;

   private:
    // Divides the weight of ray `count` between `white` and `weights`.
    void Separate(const Spectrum& weight, const ShadingPoint& point, Real scale);
    // Divides light that leaves the surface by its reflectance. A channel without reflectance takes
    // the quotient of the brightest channel, because a white surface would reflect it.
    Spectrum OffWhite(const Spectrum& light) const;

    int brightest_ = 0;  // channel of the reflectance
    Real least_ = 0;     // largest reflectance of a dark channel
    bool hasDarkChannel_ = false;
  };

  // Draws the rays of both techniques, and leaves out those that Russian roulette ends.
  Rays DrawRays(const ShadingPoint& point, LiContext& context) const;

  std::vector<Split> splits_;         // by descending photonRays, which is 0 in the last
  std::vector<Split> dividedSplits_;  // the same for samples with LiContext::isDivided
  PhotonGuide guide_;
  Cone cone_;
  Real rrThreshold_ = 0;
};

template <class Incident>
Spectrum FinalGather::Gather(const ShadingPoint& point, LiContext& context,
                             const Incident& incident) const {
  if (!point.bsdf.Has(kLobes)) return {};
  const Arena::Mark mark = context.arena.GetMark();
  const Rays rays = DrawRays(point, context);
  using Segment = typename Incident::Segment;
  Segment* const segments = context.arena.template AllocateArray<Segment>(rays.count);
  const RaySpawner spawner(point.surface);
  for (std::size_t i = 0; i < rays.count; ++i)
    new (segments + i) Segment(incident.Trace(spawner.Spawn(rays.directions[i])));
  incident.LookUp(std::span<Segment>(segments, rays.count));
  Spectrum gathered, white;
  Spectrum* observed = nullptr;
  if constexpr (requires { incident.IsObserved(); })
    if (incident.IsObserved())
      observed = context.arena.template AllocateArray<Spectrum>(rays.count);
  for (std::size_t i = 0; i < rays.count; ++i) {
    const Spectrum radiance = incident.Read(segments[i]);
    if (!rays.isAllShared) gathered += rays.weights[i] * radiance;
    if (rays.white) white += rays.white[i] * radiance;
    if (observed) observed[i] = radiance;
  }
  if constexpr (requires { incident.IsObserved(); })
    if (observed)
      incident.Observe(point, {{segments, rays.count}, rays.AllWeights(context), observed});
  if (rays.white) {
    const Normal3 n = FaceForward(point.bsdf.Ns(), point.Wo());
    const Normal3 ng = FaceForward(point.surface.ng, point.Wo());
    context.gathers->push_back(
        {point.surface.p, n, ng, white, rays.reflectance * point.throughput, point.depth});
  }
  context.arena.Rewind(mark);
  return gathered;
}

}  // namespace exphoton
