// SPDX-License-Identifier: BSD-2-Clause
// CameraPath: the techniques of bidirectional path tracing and the densities that their weights
// need.
#include "integrators/lightpaths/camera_path.h"

#include <algorithm>
#include <optional>

#include "core/transport/cut_light.h"
#include "core/transport/specular/specular_bounce.h"

namespace exphoton {

void CameraPath::AddMedia(const MediaSegment& media) {
  const Spectrum radiance = beta_ * media.radiance;
  sum_ += radiance;
  beta_ *= media.transmittance;
  if (!context_.aovs) return;
  if (count_ == 0) {
    context_.aovs->emission += radiance;
  } else {
    (path_[0].isSpecular ? context_.aovs->specular : context_.aovs->indirect) += radiance;
  }
}

void CameraPath::AddEscaped(const Vector3& w) {
  for (const Light* light : context_.scene.InfiniteLights()) {
    VertexDensities& end = Vertex(count_);
    end = {bsdfPdf_, 0, false};
    AddHit(*light, nullptr, w, 1, light->Le(w));
  }
}

void CameraPath::AddEmission(const SurfaceInteraction& hit) {
  if (!hit.areaLight) return;
  const Spectrum radiance = hit.areaLight->L(hit, hit.uv, hit.wo);
  if (radiance.IsBlack()) return;
  const double toArea = count_ == 0 ? 1 : ToArea(hit.wo, hit.ng, Distance(last_.p, hit.p));
  Vertex(count_) = {bsdfPdf_ * toArea, 0, false};
  AddHit(*hit.areaLight, &hit, -hit.wo, toArea, radiance);
}

void CameraPath::Append(const SurfaceInteraction& hit) {
  VertexDensities vertex;
  if (count_ > 0) {
    const Real distance = Distance(last_.p, hit.p);
    vertex.fromCamera = bsdfPdf_ * ToArea(hit.wo, hit.ng, distance);
    toPrevious_ = ToArea(hit.wo, last_.ng, distance);
  }
  Vertex(count_++) = vertex;
  last_ = hit;
}

void CameraPath::AddDirect(const ShadingPoint& point, Real uChoice, Point2 u, Real uPart) {
  if (lighting_.direct->IsEmpty() || !point.bsdf.Has(LobeSet::NonSpecular)) return;
  const auto choice = lighting_.direct->Sample(point.surface.p, uChoice);
  const auto direct = choice.light->SampleDirect(point.surface, u, uPart);
  if (!direct || direct->Li.IsBlack()) return;
  const Spectrum f =
      point.bsdf.f(point.Wo(), direct->wi, lobes_) * AbsDot(direct->wi, point.bsdf.Ns());
  if (f.IsBlack() || !IsNeededWithDirect()) return;
  const Spectrum arriving = context_.Unoccluded(direct->shadowRay) * direct->Li;
  if (arriving.IsBlack()) return;
  const Light& light = *choice.light;
  const double pdf = double(choice.probability) * double(direct->pdf);
  const double hitPdf =
      light.IsDelta() ? 0 : double(point.bsdf.Pdf(point.Wo(), direct->wi, lobes_));
  // Technique 2 needs the point on the light, if it can make this path at all.
  const bool hasPoint = count_ > 1 && hasLightPaths_ && !light.IsDelta() && !light.IsDistant();
  std::optional<SurfaceInteraction> on;
  if (hasPoint) on = context_.Intersect(SpawnRay(point.surface, direct->wi), RayKind::Shadow);
  if (on && on->areaLight != &light) on.reset();
  Real distance = 1;  // has no meaning for a distant light
  if (on) {
    distance = Distance(last_.p, on->p);
  } else if (!light.IsDistant()) {
    distance = Distance(last_.p, direct->shadowRay(direct->shadowRay.tMax));
  }
  const double toArea = on ? ToArea(direct->wi, on->ng, distance) : 1;
  const SurfacePoint* onLight = on ? &*on : nullptr;
  const auto begin = hasPoint && !on ? LightPathTracer::BeginningDensities()
                                     : lighting_.tracer.Beginning(light, onLight, -direct->wi,
                                                                  point.surface, distance);
  Vertex(count_) = {hitPdf * toArea, begin.onLight, false};
  Vertex(count_ - 1).isSpecular = false;
  SetFromLight(point, direct->wi, begin.next);
  Add(beta_ * f * arriving / Real(pdf), 1, count_ + 1, pdf * toArea, light.IsDelta());
}

void CameraPath::AddConnections(const ShadingPoint& point) {
  if (!point.bsdf.Has(LobeSet::NonSpecular)) return;
  const int most = maxDepth_ + 1 - count_;
  for (int m = 1; m <= most && m <= int(light_.vertices.size()); ++m) Connect(point, m);
}

void CameraPath::MeasureCutLight(const ShadingPoint& point) const {
  exphoton::MeasureCutLight({point, beta_, scatterings_ > 0}, *lighting_.direct, context_);
}

bool CameraPath::Continue(const ShadingPoint& point, Point2 u, Real uLobe, Real uRoulette,
                          RayDifferential* ray) {
  const bool goesOn = scatterings_ == 0 || context_.scene.Features().Needs(Feature::Indirect);
  const LobeSet lobes = goesOn ? lobes_ : lobes_ & LobeSet::Specular;
  const auto sample = point.bsdf.Sample(point.Wo(), u, uLobe, lobes);
  if (!sample) return false;
  const bool isSpecular = sample->IsSpecular();
  // Beyond the last vertex, only emission that next event estimation also samples is collected.
  if (point.depth >= maxDepth_ && isSpecular) return false;
  beta_ *= sample->throughput;
  if (isSpecular && sample->IsTransmission()) etaScale_ /= sample->eta * sample->eta;
  if (!(beta_.MaxComponent() > 0) || !beta_.IsFinite()) return false;
  if (point.depth >= kRouletteDepth) {
    const Real survival = std::min(beta_.MaxComponent() * etaScale_, kMaxSurvival);
    if (!(uRoulette < survival)) return false;
    beta_ /= survival;
  }
  VertexDensities& vertex = Vertex(count_ - 1);
  vertex.isSpecular = isSpecular;
  bsdfPdf_ = isSpecular ? 1 : double(sample->pdf);
  scatterings_ += !isSpecular;
  if (count_ > 1) {
    const bool isBetween =
        IsBetweenNormals(point.bsdf, sample->wi) || IsBetweenNormals(point.bsdf, point.Wo());
    const double pdf = isSpecular ? (isBetween ? 0 : 1)
                                  : DensityFromLight(point.bsdf, sample->wi, point.Wo(), lobes_);
    Vertex(count_ - 2).fromLight = pdf * toPrevious_;
  }
  *ray = SpawnRay(point.surface, sample->wi);
  if (isSpecular) AddSpecularDifferentials(point, *sample, ray);
  return true;
}

double CameraPath::DirectDensity(const Light& light, const SurfacePoint& from, const Vector3& w,
                                 const SurfacePoint* on, double toArea) const {
  const double choice = double(lighting_.direct->Pmf(from.p, light));
  return light.IsDelta() ? choice : choice * double(light.PdfDirect(from, w, on)) * toArea;
}

void CameraPath::SetFromLight(const ShadingPoint& point, const Vector3& w, double next) {
  Vertex(count_ - 1).fromLight = next;
  if (count_ > 1)
    Vertex(count_ - 2).fromLight =
        DensityFromLight(point.bsdf, w, point.Wo(), lobes_) * toPrevious_;
}

void CameraPath::Add(const Spectrum& contribution, int s, int length, double direct, bool isDelta) {
  const std::span<const VertexDensities> path(path_.data(), std::size_t(length));
  const PathKind kind(path);
  if (!kind.IsNeeded(context_.scene.Features())) return;
  const Real weight = Real(PathWeight({path, direct, isDelta, hasLightPaths_}, s));
  const Spectrum added = contribution * weight;
  sum_ += added;
  if (context_.aovs) kind.In(*context_.aovs) += added;
}

void CameraPath::AddHit(const Light& light, const SurfacePoint* on, const Vector3& w, double toArea,
                        const Spectrum& radiance) {
  double direct = 0;
  if (count_ > 0) {
    direct = DirectDensity(light, last_, w, on, toArea);
    const Real distance = on ? Distance(last_.p, on->p) : Real(1);
    const auto begin = lighting_.tracer.Beginning(light, on, -w, last_, distance);
    Vertex(count_).fromLight = begin.onLight;
    Vertex(count_ - 1).fromLight = begin.next;
  }
  Add(beta_ * radiance, 0, count_ + 1, direct, false);
}

void CameraPath::Connect(const ShadingPoint& point, int m) {
  const LightPathVertex& other = light_.vertices[std::size_t(m - 1)];
  const bool isLastSpecular = light_.vertices.front().densities.isSpecular && m > 1;
  if (isLastSpecular && count_ + m > maxDepth_) return;
  if (!other.point.bsdf.Has(LobeSet::NonSpecular)) return;
  const Vector3 between = other.point.surface.p - point.surface.p;
  const Real distance = Length(between);
  const Vector3 w = NormalizeOr(between, {});
  if (!(distance > 0) || w == Vector3{}) return;
  const Spectrum f = point.bsdf.f(point.Wo(), w, lobes_) * AbsDot(w, point.bsdf.Ns());
  if (f.IsBlack()) return;
  const Spectrum adjoint = AdjointBsdf(other.point, -w, lobes_);
  if (adjoint.IsBlack()) return;
  const Real toOther = Real(ToArea(w, other.point.surface.ng, distance));
  const Spectrum joined = beta_ * f * toOther * adjoint * other.alpha;
  if (joined.IsBlack() || !joined.IsFinite()) return;
  const Spectrum visible = context_.Unoccluded(SpawnRayTo(point.surface, other.point.surface));
  if (visible.IsBlack()) return;

  // The vertices of the light path, in order from the camera
  for (int j = m - 1; j >= 0; --j)
    Vertex(count_ + m - 1 - j) = light_.vertices[std::size_t(j)].densities;
  Vertex(count_ + m) = light_.origin;
  // The densities that depend on the connection
  const Bsdf& bsdf = other.point.bsdf;
  VertexDensities& joint = Vertex(count_);
  joint.isSpecular = false;
  joint.fromCamera = double(point.bsdf.Pdf(point.Wo(), w, lobes_)) * double(toOther);
  Vertex(count_ + 1).fromCamera =
      m == 1 && light_.light->IsDelta()
          ? 0
          : double(bsdf.Pdf(-w, other.point.Wo(), lobes_)) * other.toPrevious;
  Vertex(count_ - 1).isSpecular = false;
  SetFromLight(
      point, w,
      DensityFromLight(bsdf, other.point.Wo(), -w, lobes_) * ToArea(w, point.surface.ng, distance));
  const LightPathVertex& first = light_.vertices.front();
  const double direct =
      DirectDensity(*light_.light, first.point.surface, first.point.Wo(),
                    light_.isOnSurface ? &light_.onLight : nullptr, first.toPrevious);
  if (light_.light->IsDelta()) Vertex(count_ + m).fromCamera = 0;
  Add(joined * visible, m + 1, count_ + m + 1, direct, light_.light->IsDelta());
}

}  // namespace exphoton
