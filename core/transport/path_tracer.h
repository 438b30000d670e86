// SPDX-License-Identifier: BSD-2-Clause
// PathTracer is the vertex loop of unidirectional path tracing with next event estimation. At each
// vertex the power heuristic combines one light sample with the sampled directions that continue
// the path (Veach 1997, chapters 9 and 10). The Scattering policy samples these directions: one
// from the BSDF (BsdfScattering), or one from the BSDF and one from a guiding distribution. The
// estimate is unbiased up to the depth limit, for every policy that states its densities rightly.
#pragma once

#include <algorithm>
#include <array>
#include <memory>

#include "core/math/sampling/mis.h"
#include "core/transport/cut_light.h"
#include "core/transport/light_sample.h"
#include "core/transport/path_history.h"
#include "core/transport/shading_point.h"
#include "core/transport/specular/specular_bounce.h"
#include "core/transport/volume_integrator.h"

namespace exphoton {

// The uniform random numbers of one path vertex.
struct PathVertexVariates {
  Real lightChoice;
  Point2 light;
  Real lightPart;
  Point2 bsdf;
  Real bsdfLobe;
  Real roulette;
  // Of a second direction, if the policy samples one
  Point2 branch;
  Real branchPart, branchRoulette;
};

// PathWeight is the throughput of a path, with values for Russian roulette.
struct PathWeight {
  Spectrum beta{1};  // product of f |cos| / density so far
  // Factor on beta for Russian roulette. It cancels the scaling of radiance by refraction, which
  // does not affect how much light the path will contribute.
  Real rouletteScale = 1;
  // The light that a policy expected to arrive at the first vertex where it knew this; 0: none did.
  // It is the luminance that reaches the camera.
  Real expectedLight = 0;
};

// PathDirection is a sampled direction that continues a path.
struct PathDirection {
  BsdfSample sample;         // throughput and pdf as for the densities of all techniques, summed
  bool isRouletted = false;  // the policy has decided that the path survives
};

// BsdfScattering is the policy of plain path tracing. A policy makes an object for each vertex,
// which samples the directions and states the sum of their densities.
struct BsdfScattering {
  // Most branches of a path that can wait. 0: Vertex has no SampleBranch.
  static constexpr std::size_t kMaxBranches = 0;

  struct Vertex {
    const ShadingPoint& point;
    std::optional<PathDirection> Sample(const PathVertexVariates& u, LobeSet lobes) const {
      const auto sample = point.bsdf.Sample(point.Wo(), u.bsdf, u.bsdfLobe, lobes);
      if (!sample) return std::nullopt;
      return PathDirection{*sample};
    }
    // Returns the expected number of directions per solid angle, given the density of the BSDF.
    Real Pdf(const Vector3&, Real bsdfPdf) const { return bsdfPdf; }
  };
  Vertex At(const ShadingPoint& point, bool /*maySplit*/, PathWeight*, LiContext&) const {
    return {point};
  }
};

class PathTracer {
 public:
  // Light is collected at the first maxDepth + 1 surfaces of a path.
  explicit PathTracer(int maxDepth) : maxDepth_(maxDepth) {}

  void Preprocess(const Scene& scene) { lights_ = scene.MakeLightSampler(LightSelection::Auto); }
  template <class Scattering>
  void RequestSamples(SampleLayout* layout);

  // Returns the radiance along the camera ray, and fills the light AOVs. `maySplit` of
  // Scattering::At is false where a second direction is of no use: at the depth limit, beyond which
  // only emission is collected, and where too many branches wait.
  template <class Scattering>
  Spectrum Radiance(const RayDifferential& ray, const Scattering& scattering,
                    LiContext& context) const;

 private:
  static constexpr int kSampledVertices = 3;  // vertices that use the sampler, not a stream
  static constexpr int kRouletteDepth = 4;    // vertices before Russian roulette begins
  static constexpr Real kMaxSurvival = Real(.98);
  static constexpr std::uint64_t kPathStream = 0x9a7;
  // Branches of one camera sample. The limit matters only where surfaces reflect nearly all light,
  // or more than they receive.
  static constexpr int kMaxSplits = 64;

  struct VertexArrays {
    int choice1D = -1, light2D = -1, part1D = -1, bsdf2D = -1, lobe1D = -1;
    int branch2D = -1, branch1D = -1;  // only if the policy samples a second direction
  };

  // State is the state of a path between two vertices.
  struct State {
    RayDifferential ray;
    PathWeight weight;
    PathHistory history;
    SurfacePoint from;       // the last vertex
    Real pdf = 0;            // of the ray's direction, per solid angle at `from`
    bool isSpecular = true;  // camera ray or delta lobe: no light sample could find the emission
    bool isBranch = false;   // a branch uses no arrays of the sampler; they belong to the main path
    int depth = 0;
  };

  static RayKind KindOf(const State& path) {
    if (path.depth == 0) return RayKind::Camera;
    return path.isSpecular ? RayKind::Specular : RayKind::Bsdf;
  }
  // f, Pdf and Sample must all use these lobes.
  static LobeSet Lobes(const Scene& scene) {
    return scene.Features().Needs(Feature::Specular) ? LobeSet::All : LobeSet::NonSpecular;
  }

  // Draws the numbers of the next vertex; of a second direction too if the arrays for it exist.
  PathVertexVariates MakeVariates(const State& path, const LiContext& context,
                                  RandomStream* random) const;
  // Returns the emission at the ray's end, with the MIS weight against the light sample at the
  // vertex that the ray left.
  Spectrum Emission(const State& path, const SurfaceInteraction* hit, const Scene& scene) const;
  Real EmissionWeight(const State& path, const Light& light, const SurfacePoint* on) const;
  // Returns next event estimation with one light, chosen as LightSelection::Auto describes.
  template <class Vertex>
  Spectrum DirectLight(const ShadingPoint& point, const Vertex& vertex,
                       const PathVertexVariates& sample, LiContext& context) const;
  // Extends the path along a sampled direction. Returns false if the path ends.
  bool Continue(const ShadingPoint& point, const PathDirection& direction, Real uRoulette,
                State* path) const;

  int maxDepth_;
  std::unique_ptr<const LightSampler> lights_;
  std::array<VertexArrays, kSampledVertices> arrays_;
};

template <class Scattering>
void PathTracer::RequestSamples(SampleLayout* layout) {
  for (VertexArrays& a : arrays_) {
    a = {layout->Request1D(1), layout->Request2D(1), layout->Request1D(1), layout->Request2D(1),
         layout->Request1D(1)};
    if constexpr (Scattering::kMaxBranches > 0) {
      a.branch2D = layout->Request2D(1);
      a.branch1D = layout->Request1D(1);
    }
  }
}

template <class Scattering>
Spectrum PathTracer::Radiance(const RayDifferential& ray, const Scattering& scattering,
                              LiContext& context) const {
  constexpr std::size_t kMaxBranches = Scattering::kMaxBranches;
  std::array<std::optional<State>, kMaxBranches> branches;
  std::size_t waiting = 0;
  int splits = 0;
  Spectrum sum;
  const LobeSet lobes = Lobes(context.scene);
  RandomStream random = context.Stream(kPathStream);
  State path{ray, {}, PathHistory(context.scene.Features(), context.aovs), {}};
  // Each turn traces a ray and extends the path by a vertex. Returns false where the path ends.
  const auto extend = [&]() {
    const auto hit = context.Intersect(path.ray, KindOf(path));
    const MediaSegment media = AlongMedia(path.ray, hit ? &hit->p : nullptr, context);
    Spectrum& beta = path.weight.beta;
    const Spectrum added = beta * media.radiance;
    sum += added;
    path.history.AddMedia(added);
    beta *= media.transmittance;
    if (path.history.TakesEmission()) {
      const Spectrum emission = beta * Emission(path, hit ? &*hit : nullptr, context.scene);
      sum += emission;
      path.history.AddEmission(emission);
    }
    if (!hit) {
      if (path.depth == 0) context.alpha = sum.IsBlack() ? 0 : 1;
      return false;
    }
    // The ray beyond the last vertex is traced only for the emission that it may hit.
    if (path.depth > maxDepth_) return false;
    const Arena::Mark mark = context.arena.GetMark();
    const ShadingPoint point =
        MakeShadingPoint(*hit, path.ray, path.depth, TransportMode::Radiance, &context.arena);
    const PathVertexVariates sample = MakeVariates(path, context, &random);
    const bool maySplit = path.depth < maxDepth_ && waiting < kMaxBranches && splits < kMaxSplits;
    const auto vertex = scattering.At(point, maySplit, &path.weight, context);
    if (path.history.TakesDirect()) {
      const Spectrum direct = beta * DirectLight(point, vertex, sample, context);
      sum += direct;
      path.history.AddDirect(direct);
    }
    if (path.depth == maxDepth_)
      MeasureCutLight({point, beta, path.history.IsScattered()}, *lights_, context);
    const LobeSet followed = path.history.Lobes(lobes);
    if constexpr (kMaxBranches > 0) {
      if (const auto direction = vertex.SampleBranch(sample, followed)) {
        State branch = path;
        branch.isBranch = true;
        if (Continue(point, *direction, sample.branchRoulette, &branch)) {
          branches[waiting++] = branch;
          ++splits;
        }
      }
    }
    const auto direction = vertex.Sample(sample, followed);
    const bool goesOn = direction && Continue(point, *direction, sample.roulette, &path);
    context.arena.Rewind(mark);
    return goesOn;
  };
  for (;;) {
    while (extend()) {
    }
    if (waiting == 0) return sum;
    if constexpr (kMaxBranches > 0) path = *branches[--waiting];
  }
}

template <class Vertex>
Spectrum PathTracer::DirectLight(const ShadingPoint& point, const Vertex& vertex,
                                 const PathVertexVariates& sample, LiContext& context) const {
  if (lights_->IsEmpty() || !point.bsdf.Has(LobeSet::NonSpecular)) return {};
  const auto choice = lights_->Sample(point.surface.p, sample.lightChoice);
  return FromLightSample(point, {choice.light, choice.probability, sample.light, sample.lightPart},
                         {}, Lobes(context.scene), context,
                         [&](const Vector3& wi, Real bsdfPdf) { return vertex.Pdf(wi, bsdfPdf); });
}

}  // namespace exphoton
