// SPDX-License-Identifier: BSD-2-Clause
// DirectLighting: light sampling and BSDF sampling for one light, and the sum over all lights. f,
// Pdf and Sample must use the same lobe mask, or the MIS weights do not sum to 1.
#include "core/transport/direct_lighting.h"

#include <algorithm>

#include "core/math/sampling/mis.h"
#include "core/transport/light_sample.h"

namespace exphoton {
namespace {

constexpr LobeSet kLobes = LobeSet::NonSpecular;

// Returns the MIS-weighted contribution of one BSDF sample; 0 if it misses the light.
Spectrum FromBsdfSample(const ShadingPoint& point, const Light& light,
                        const DirectLightingVariates& sample, LiContext& context) {
  const auto scattered = point.bsdf.Sample(point.Wo(), sample.bsdf, sample.bsdfLobe, kLobes);
  if (!scattered || scattered->throughput.IsBlack()) return {};
  const Ray ray = SpawnRay(point.surface, scattered->wi);
  if (!light.MayMeet(ray)) return {};
  const auto hit = context.Intersect(ray, RayKind::Bsdf);
  Spectrum radiance;
  if (hit && hit->areaLight == &light) {
    radiance = hit->areaLight->L(*hit, hit->uv, hit->wo);
  } else if (!hit && light.IsInfinite()) {
    radiance = light.Le(scattered->wi);
  }
  if (radiance.IsBlack()) return {};
  Ray stretch = ray;
  if (hit) stretch.tMax = Distance(ray.o, hit->p) / Length(ray.d);
  radiance *= context.scene.Transmittance(stretch);
  const SurfacePoint* on = hit ? &*hit : nullptr;
  const Real lightPdf = light.PdfDirect(point.surface, scattered->wi, on);
  return scattered->throughput * radiance * PowerHeuristic(1, scattered->pdf, 1, lightPdf);
}

}  // namespace

Spectrum EstimateDirect(const ShadingPoint& point, const Light& light,
                        const DirectLightingVariates& sample, LiContext& context) {
  if (light.IsProvablyBlack() || !point.bsdf.Has(kLobes)) return {};
  Spectrum sum =
      FromLightSample(point, {&light, 1, sample.light, sample.lightPart}, {}, kLobes, context);
  if (!light.IsDelta()) sum += FromBsdfSample(point, light, sample, context);
  return sum;
}

void DirectLighting::RequestSamples(const Scene& scene, const Sampler& sampler,
                                    SampleLayout* layout) {
  arrays_.clear();
  many_.reset();
  const auto& lights = scene.Lights();
  if (scene.NonBlackLightCount() > mostLights_) {
    many_.emplace().RequestSamples(scene, sampler, chosen_, layout);
    return;
  }
  arrays_.resize(lights.size());
  for (std::size_t i = 0; i < arrays_.size(); ++i) {
    const Light& light = *scene.Lights()[i];
    if (light.IsProvablyBlack()) continue;
    LightArrays& arrays = arrays_[i];
    // All samples of a delta light are equal.
    arrays.count = light.IsDelta() ? 1 : std::max(1, sampler.RoundCount(light.SampleCount()));
    if (light.IsDelta()) continue;
    arrays.light2D = layout->Request2D(arrays.count);
    arrays.part1D = layout->Request1D(arrays.count);
    arrays.bsdf2D = layout->Request2D(arrays.count);
    arrays.lobe1D = layout->Request1D(arrays.count);
  }
}

Spectrum DirectLighting::AllLights(const ShadingPoint& point, LiContext& context) const {
  if (many_) return many_->Estimate(point, context);
  Spectrum sum;
  if (!point.bsdf.Has(kLobes)) return sum;
  for (std::size_t i = 0; i < arrays_.size(); ++i) {
    const LightArrays& arrays = arrays_[i];
    if (arrays.count == 0) continue;
    const Light& light = *context.scene.Lights()[i];
    if (light.IsDelta()) {
      sum += EstimateDirect(point, light, {}, context);
      continue;
    }
    const auto light2D = context.samples.Array2D(arrays.light2D);
    const auto part1D = context.samples.Array1D(arrays.part1D);
    const auto bsdf2D = context.samples.Array2D(arrays.bsdf2D);
    const auto lobe1D = context.samples.Array1D(arrays.lobe1D);
    Spectrum lightSum;
    for (std::size_t j = 0; j < std::size_t(arrays.count); ++j) {
      lightSum +=
          EstimateDirect(point, light, {light2D[j], part1D[j], bsdf2D[j], lobe1D[j]}, context);
    }
    sum += lightSum / Real(arrays.count);
  }
  return sum;
}

}  // namespace exphoton
