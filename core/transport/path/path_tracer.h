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
#include "core/transport/path/path_history.h"
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

  template <class Scattering>
  class Walk;
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
    LightReceiver receiver;  // the last vertex, as the place that lights are chosen for
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

// Walk traces the path of one camera sample, with its branches.
template <class Scattering>
class PathTracer::Walk {
 public:
  Walk(const PathTracer& tracer, const RayDifferential& ray, const Scattering& scattering,
       LiContext& context)
      : tracer_(tracer),
        scattering_(scattering),
        context_(context),
        lobes_(Lobes(context.scene)),
        random_(context.Stream(kPathStream)),
        path_{ray, {}, PathHistory(context.scene.Features(), context.aovs), {}, {}} {}

  Spectrum Trace() {
    for (;;) {
      while (Extend()) {
      }
      if (waiting_ == 0) return sum_;
      if constexpr (kMaxBranches > 0) path_ = *branches_[--waiting_];
    }
  }

 private:
  static constexpr std::size_t kMaxBranches = Scattering::kMaxBranches;

  // The light samples of a vertex compete with all directions that its policy samples.
  struct Techniques {
    const typename Scattering::Vertex& vertex;
    static constexpr int light = 1, bsdf = 1;
    Real Pdf(const Vector3& wi, Real bsdfPdf) const { return vertex.Pdf(wi, bsdfPdf); }
  };

  // Traces the ray of the path, collects light, and samples the next ray. Returns false if the path
  // ends.
  bool Extend() {
    const auto hit = context_.Intersect(path_.ray, KindOf(path_));
    CollectAlong(hit ? &*hit : nullptr);
    // The ray beyond the last vertex is traced only for the emission that it may hit.
    if (!hit || path_.depth > tracer_.maxDepth_) return false;
    const Arena::Mark mark = context_.arena.GetMark();
    const ShadingPoint point =
        MakeShadingPoint(*hit, path_.ray, path_.depth, TransportMode::Radiance, &context_.arena);
    const bool goesOn = Scatter(point);
    context_.arena.Rewind(mark);
    return goesOn;
  }

  // Adds the light of media along the ray, and the emission at its end.
  void CollectAlong(const SurfaceInteraction* hit) {
    Spectrum& beta = path_.weight.beta;
    const MediaSegment media = AlongMedia(path_.ray, hit ? &hit->p : nullptr, context_);
    const Spectrum added = beta * media.radiance;
    sum_ += added;
    path_.history.AddMedia(added);
    beta *= media.transmittance;
    if (path_.history.TakesEmission()) {
      const Spectrum emission = beta * tracer_.Emission(path_, hit, context_.scene);
      sum_ += emission;
      path_.history.AddEmission(emission);
    }
    if (!hit && path_.depth == 0) context_.alpha = sum_.IsBlack() ? 0 : 1;
  }

  bool Scatter(const ShadingPoint& point) {
    const PathVertexVariates sample = tracer_.MakeVariates(path_, context_, &random_);
    const int maxDepth = tracer_.maxDepth_;
    const bool maySplit = path_.depth < maxDepth && waiting_ < kMaxBranches && splits_ < kMaxSplits;
    const auto vertex = scattering_.At(point, maySplit, &path_.weight, context_);
    if (path_.history.TakesDirect()) {
      const Spectrum direct = path_.weight.beta * DirectLight(point, vertex, sample);
      sum_ += direct;
      path_.history.AddDirect(direct);
    }
    if (path_.depth == maxDepth)
      MeasureCutLight({point, path_.weight.beta, path_.history.IsScattered()}, *tracer_.lights_,
                      context_);
    const LobeSet followed = path_.history.Lobes(lobes_);
    if constexpr (kMaxBranches > 0) Split(point, vertex.SampleBranch(sample, followed), sample);
    const auto direction = vertex.Sample(sample, followed);
    return direction && tracer_.Continue(point, *direction, sample.roulette, &path_);
  }

  // Returns next event estimation with one light, chosen as LightSelection::Auto describes.
  Spectrum DirectLight(const ShadingPoint& point, const typename Scattering::Vertex& vertex,
                       const PathVertexVariates& sample) {
    const LightSampler& lights = *tracer_.lights_;
    if (lights.IsEmpty() || !point.bsdf.Has(LobeSet::NonSpecular)) return {};
    const auto choice = lights.Sample(point.Receiver(), sample.lightChoice);
    return FromLightSample(point,
                           {choice.light, choice.probability, sample.light, sample.lightPart},
                           Techniques{vertex}, lobes_, context_);
  }

  // Lets a second direction wait until the path has ended.
  void Split(const ShadingPoint& point, const std::optional<PathDirection>& direction,
             const PathVertexVariates& sample) {
    if (!direction) return;
    State branch = path_;
    branch.isBranch = true;
    if (!tracer_.Continue(point, *direction, sample.branchRoulette, &branch)) return;
    branches_[waiting_++] = branch;
    ++splits_;
  }

  const PathTracer& tracer_;
  const Scattering& scattering_;
  LiContext& context_;
  LobeSet lobes_;
  RandomStream random_;
  State path_;
  std::array<std::optional<State>, kMaxBranches> branches_;
  std::size_t waiting_ = 0;  // number of branches that wait
  int splits_ = 0;           // number of branches so far
  Spectrum sum_;
};

template <class Scattering>
Spectrum PathTracer::Radiance(const RayDifferential& ray, const Scattering& scattering,
                              LiContext& context) const {
  return Walk<Scattering>(*this, ray, scattering, context).Trace();
}

}  // namespace exphoton
