// SPDX-License-Identifier: BSD-2-Clause
// ManyLights: light samples from the light tree and BSDF samples, combined by MIS.
#include "core/transport/many_lights.h"

#include <algorithm>

#include "core/math/sampling/mis.h"
#include "core/transport/light_sample.h"

namespace exphoton {
namespace {

// The number of light samples per BSDF sample. BSDF samples rarely hit a light, because most lights
// in a scene of many lights are small.
constexpr int kLightsPerBsdf = 8;

}  // namespace

void ManyLights::RequestSamples(const Scene& scene, const Sampler& sampler, int count,
                                SampleLayout* layout) {
  lights_ = scene.MakeLightSampler(LightSelection::Tree);
  lightCount_ = std::max(1, sampler.RoundCount(count));
  bsdfCount_ = std::max(1, lightCount_ / kLightsPerBsdf);
  choice1D_ = layout->Request1D(lightCount_);
  part1D_ = layout->Request1D(lightCount_);
  light2D_ = layout->Request2D(lightCount_);
  bsdf2D_ = layout->Request2D(bsdfCount_);
  lobe1D_ = layout->Request1D(bsdfCount_);
}

Spectrum ManyLights::Estimate(const ShadingPoint& point, LiContext& context) const {
  if (lights_->IsEmpty() || !point.bsdf.Has(LobeSet::NonSpecular)) return {};
  const CameraSamples& samples = context.samples;
  const auto choice = samples.Array1D(choice1D_), part = samples.Array1D(part1D_);
  const auto light = samples.Array2D(light2D_);
  const LightReceiver receiver = lights_->Prepared(point.Receiver());
  Spectrum byLights, byBsdf;
  for (std::size_t i = 0; i < choice.size(); ++i) {
    const auto chosen = lights_->Sample(receiver, choice[i]);
    byLights += FromLightSample(point, {chosen.light, chosen.probability, light[i], part[i]},
                                {lightCount_, bsdfCount_}, LobeSet::NonSpecular, context);
  }
  const auto bsdf = samples.Array2D(bsdf2D_);
  const auto lobe = samples.Array1D(lobe1D_);
  for (std::size_t i = 0; i < bsdf.size(); ++i)
    byBsdf += FromBsdf(point, receiver, {bsdf[i], lobe[i]}, context);
  return byLights / Real(lightCount_) + byBsdf / Real(bsdfCount_);
}

Spectrum ManyLights::FromBsdf(const ShadingPoint& point, const LightReceiver& receiver,
                              const BsdfVariates& u, LiContext& context) const {
  const auto scattered = point.bsdf.Sample(point.Wo(), u.direction, u.lobe, LobeSet::NonSpecular);
  if (!scattered || scattered->throughput.IsBlack()) return {};
  const Ray ray = SpawnRay(point.surface, scattered->wi);
  const auto hit = context.Intersect(ray, RayKind::Bsdf);
  const auto weight = [&](const Light& light, const SurfacePoint* on) {
    const Real lightPdf =
        lights_->Pmf(receiver, light) * light.PdfDirect(point.surface, scattered->wi, on);
    return PowerHeuristic(bsdfCount_, scattered->pdf, lightCount_, lightPdf);
  };
  Spectrum radiance;
  if (!hit) {
    for (const Light* light : context.scene.InfiniteLights())
      radiance += light->Le(scattered->wi) * weight(*light, nullptr);
  } else if (hit->areaLight) {
    radiance = hit->areaLight->L(*hit, hit->uv, hit->wo) * weight(*hit->areaLight, &*hit);
  }
  if (radiance.IsBlack()) return {};
  Ray stretch = ray;
  if (hit) stretch.tMax = Distance(ray.o, hit->p) / Length(ray.d);
  return scattered->throughput * radiance * context.scene.Transmittance(stretch);
}

}  // namespace exphoton
