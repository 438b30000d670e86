// SPDX-License-Identifier: BSD-2-Clause
// LightPathTracer: emission, scattering with the adjoint BSDF, and the densities of both
// directions of the path.
#include "integrators/lightpaths/light_path.h"

#include <algorithm>

namespace exphoton {
namespace {

constexpr std::size_t kPlainVertices = 3;  // surface points before Russian roulette begins
constexpr Real kMaxSurvival = Real(.98);

double ToArea(const Vector3& w, const Normal3& ng, Real distance) {
  return double(AbsDot(w, ng)) / (double(distance) * double(distance));
}

}  // namespace

double DensityFromLight(const Bsdf& bsdf, const Vector3& toLight, const Vector3& toCamera,
                        LobeSet lobes) {
  if (IsBetweenNormals(bsdf, toLight) || IsBetweenNormals(bsdf, toCamera)) return 0;
  return double(bsdf.Pdf(toLight, toCamera, lobes));
}

Spectrum AdjointBsdf(const ShadingPoint& vertex, const Vector3& toCamera, LobeSet lobes) {
  const Vector3& wi = vertex.Wo();
  const Real geometric = AbsDot(wi, vertex.bsdf.Ng());
  if (!(geometric > 0)) return {};
  return vertex.bsdf.f(toCamera, wi, lobes) * (AbsDot(wi, vertex.bsdf.Ns()) / geometric);
}

LightPathTracer::LightPathTracer(const Scene& scene, bool isWeighted)
    : scene_(&scene),
      isWeighted_(isWeighted),
      lobes_(scene.Features().Needs(Feature::Specular) ? LobeSet::All : LobeSet::NonSpecular),
      lights_(MakeEmissionLightSampler(scene.Lights(), LightSelection::Power, {})) {}

LightPathTracer::BeginningDensities LightPathTracer::Beginning(const Light& light,
                                                               const SurfacePoint* on,
                                                               const Vector3& w,
                                                               const SurfacePoint& x,
                                                               Real distance) const {
  if (IsEmpty()) return {};
  const double choice = double(lights_->Pmf({}, light));
  const Light::EmissionPdf pdf = light.PdfEmission(on ? *on : x, w);
  if (light.IsDistant()) {
    const double direction = light.IsDelta() ? 1 : double(pdf.direction);
    return {choice * direction, double(pdf.position) * double(AbsDot(w, x.ng))};
  }
  const double position = light.IsDelta() ? 1 : double(pdf.position);
  return {choice * position, double(pdf.direction) * ToArea(w, x.ng, distance)};
}

// Fills the densities of the first two vertices. Returns false if the point on an area light cannot
// be found again, which only rounding at its edge causes.
bool LightPathTracer::Begin(const Light& light, const Ray& ray, const SurfaceInteraction& hit,
                            RayCounters* rays, LightPath* path) const {
  path->light = &light;
  LightPathVertex& first = path->vertices.back();
  Real distance = Distance(ray.o, hit.p);
  if (!light.IsDelta() && !light.IsDistant()) {
    rays->Count(RayKind::Photon);
    const auto origin = scene_->Intersect(SpawnRay(hit, -ray.d));
    if (!origin || origin->areaLight != &light) return false;
    path->onLight = *origin;
    path->isOnSurface = true;
    distance = Distance(origin->p, hit.p);
    first.toPrevious = ToArea(ray.d, origin->ng, distance);
  }
  const auto densities =
      Beginning(light, path->isOnSurface ? &path->onLight : nullptr, ray.d, hit, distance);
  path->origin.fromLight = densities.onLight;
  first.densities.fromLight = densities.next;
  return densities.onLight > 0 && densities.next > 0;
}

void LightPathTracer::Trace(const Emission& emission, int mostVertices, Workspace workspace,
                            LightPath* path) const {
  auto& [random, arena, rays] = workspace;
  path->light = nullptr;
  path->isOnSurface = false;
  path->origin = {};
  path->vertices.clear();
  if (IsEmpty() || mostVertices < 1) return;
  const auto choice = lights_->Sample(emission.light);
  const auto sample = choice.light->SampleEmission(emission.position, emission.direction,
                                                   emission.part, emission.time);
  if (!sample) return;
  Ray ray = sample->ray;
  Spectrum alpha =
      sample->power / choice.probability * scene_->TransmittanceBefore(*choice.light, ray);
  double pdf = 0;  // per solid angle, with which the last vertex made the ray
  while (alpha.MaxComponent() > 0 && alpha.IsFinite()) {
    rays->Count(RayKind::Photon);
    const auto hit = scene_->Intersect(ray);
    if (!hit) return;
    const Real distance = Distance(ray.o, hit->p);
    if (!(distance > 0) || !hit->material) return;
    if (scene_->HasMedia()) {
      Ray stretch = ray;
      stretch.tMax = distance;
      alpha *= scene_->Transmittance(stretch);
    }
    path->vertices.push_back(
        {MakeShadingPoint(*hit, ray, int(path->vertices.size()), TransportMode::Importance, arena),
         alpha,
         {},
         1});
    LightPathVertex& vertex = path->vertices.back();
    if (path->vertices.size() == 1) {
      if (!Begin(*choice.light, ray, *hit, rays, path)) return path->vertices.clear();
    } else {
      const LightPathVertex& before = path->vertices[path->vertices.size() - 2];
      vertex.densities.fromLight = pdf * ToArea(ray.d, hit->ng, distance);
      vertex.toPrevious = ToArea(ray.d, before.point.surface.ng, distance);
    }
    if (int(path->vertices.size()) >= mostVertices) return;
    if (!Scatter(path, &random, &ray, &alpha, &pdf)) return;
  }
}

// Samples the direction in which the path leaves its last vertex, and sets the density with which
// a camera path in the opposite direction makes the vertex before. Returns false if the path ends.
bool LightPathTracer::Scatter(LightPath* path, RandomStream* random, Ray* ray, Spectrum* alpha,
                              double* pdf) const {
  LightPathVertex& vertex = path->vertices.back();
  const Bsdf& bsdf = vertex.point.bsdf;
  const Vector3& wo = vertex.point.Wo();
  const Real x = random->Uniform(), y = random->Uniform(), uLobe = random->Uniform();
  const Real uRoulette = random->Uniform();
  const auto sample = bsdf.Sample(wo, {x, y}, uLobe, lobes_, TransportMode::Importance);
  if (!sample) return false;
  if (isWeighted_ && (IsBetweenNormals(bsdf, wo) || IsBetweenNormals(bsdf, sample->wi)))
    return false;
  const Real denominator = AbsDot(wo, bsdf.Ng()) * AbsDot(sample->wi, bsdf.Ns());
  if (!(denominator > 0)) return false;
  const Real factor = AbsDot(wo, bsdf.Ns()) * AbsDot(sample->wi, bsdf.Ng()) / denominator;
  const Spectrum scattered = *alpha * sample->throughput * (bsdf.Ng() == bsdf.Ns() ? 1 : factor);
  Real survival = 1;
  if (path->vertices.size() >= kPlainVertices)
    survival = std::min(SafeDivide(scattered.Y(), alpha->Y(), Real(0)), kMaxSurvival);
  if (!(uRoulette < survival)) return false;
  *alpha = scattered / survival;
  vertex.densities.isSpecular = sample->IsSpecular();
  *pdf = vertex.densities.isSpecular ? 1 : DensityFromLight(bsdf, wo, sample->wi, lobes_);
  const double reverse = vertex.densities.isSpecular ? 1 : double(bsdf.Pdf(sample->wi, wo, lobes_));
  VertexDensities& before = path->vertices.size() == 1
                                ? path->origin
                                : path->vertices[path->vertices.size() - 2].densities;
  before.fromCamera = reverse * vertex.toPrevious;
  *ray = SpawnRay(vertex.point.surface, sample->wi);
  return *pdf > 0 || !isWeighted_;
}

}  // namespace exphoton
