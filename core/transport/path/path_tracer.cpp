// SPDX-License-Identifier: BSD-2-Clause
// PathTracer: the parts of the loop that do not depend on how directions are sampled.
#include "core/transport/path/path_tracer.h"

namespace exphoton {
namespace {

// Specular bounces keep the ray differentials of the pixel; other bounces have none.
RayDifferential NextRay(const ShadingPoint& point, const BsdfSample& scattered) {
  RayDifferential ray = SpawnRay(point.surface, scattered.wi);
  if (scattered.IsSpecular()) AddSpecularDifferentials(point, scattered, &ray);
  return ray;
}

}  // namespace

PathVertexVariates PathTracer::MakeVariates(const State& path, const LiContext& context,
                                            RandomStream* random) const {
  RandomStream& r = *random;
  PathVertexVariates s;
  const bool hasBranches = arrays_[0].branch2D >= 0;
  if (path.depth < kSampledVertices && !path.isBranch) {
    const VertexArrays& a = arrays_[std::size_t(path.depth)];
    const CameraSamples& samples = context.samples;
    s.lightChoice = samples.Array1D(a.choice1D)[0];
    s.light = samples.Array2D(a.light2D)[0];
    s.lightPart = samples.Array1D(a.part1D)[0];
    s.bsdf = samples.Array2D(a.bsdf2D)[0];
    s.bsdfLobe = samples.Array1D(a.lobe1D)[0];
    if (hasBranches) {
      s.branch = samples.Array2D(a.branch2D)[0];
      s.branchPart = samples.Array1D(a.branch1D)[0];
    }
  } else {
    s.lightChoice = r.Uniform();
    s.light = {r.Uniform(), r.Uniform()};
    s.lightPart = r.Uniform();
    s.bsdf = {r.Uniform(), r.Uniform()};
    s.bsdfLobe = r.Uniform();
    if (hasBranches) {
      s.branch = {r.Uniform(), r.Uniform()};
      s.branchPart = r.Uniform();
    }
  }
  s.roulette = r.Uniform();
  if (hasBranches) s.branchRoulette = r.Uniform();
  return s;
}

Spectrum PathTracer::Emission(const State& path, const SurfaceInteraction* hit,
                              const Scene& scene) const {
  const Vector3& w = path.ray.d;
  if (!hit) {
    if (path.isSpecular) return scene.EscapedRadiance(w);
    Spectrum sum;
    for (const Light* light : scene.InfiniteLights())
      sum += light->Le(w) * EmissionWeight(path, *light, nullptr);
    return sum;
  }
  if (!hit->areaLight) return {};
  const Spectrum radiance = hit->areaLight->L(*hit, hit->uv, hit->wo);
  if (path.isSpecular || radiance.IsBlack()) return radiance;
  return radiance * EmissionWeight(path, *hit->areaLight, hit);
}

Real PathTracer::EmissionWeight(const State& path, const Light& light,
                                const SurfacePoint* on) const {
  const Real lightPdf =
      lights_->Pmf(path.receiver, light) * light.PdfDirect(path.from, path.ray.d, on);
  return PowerHeuristic(1, path.pdf, 1, lightPdf);
}

bool PathTracer::Continue(const ShadingPoint& point, const PathDirection& direction, Real uRoulette,
                          State* path) const {
  const BsdfSample& scattered = direction.sample;
  PathWeight& weight = path->weight;
  // Beyond the last vertex, only emission that next event estimation also samples is collected.
  if (point.depth >= maxDepth_ && scattered.IsSpecular()) return false;
  weight.beta *= scattered.throughput;
  if (scattered.IsSpecular() && scattered.IsTransmission()) {
    weight.rouletteScale /= scattered.eta * scattered.eta;
  }
  const Real most = weight.beta.MaxComponent();
  if (!(most > 0) || !weight.beta.IsFinite()) return false;
  if (direction.isRouletted) {
    weight.rouletteScale = 1 / most;  // roulette of the next vertex begins anew
  } else if (point.depth >= kRouletteDepth) {
    const Real survival = std::min(most * weight.rouletteScale, kMaxSurvival);
    if (!(uRoulette < survival)) return false;
    weight.beta /= survival;
  }
  path->ray = NextRay(point, scattered);
  path->from = point.surface;
  path->receiver = point.Receiver();
  path->pdf = scattered.pdf;
  path->isSpecular = scattered.IsSpecular();
  path->history.Bounce(path->isSpecular);
  ++path->depth;
  return true;
}

}  // namespace exphoton
