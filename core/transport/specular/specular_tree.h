// SPDX-License-Identifier: BSD-2-Clause
// SpecularTree is the recursion of Whitted-style integrators (Whitted 1980). It traces a camera
// ray, lets the caller shade the hit, and adds the radiance over specular lobes up to a maximum
// depth. It counts the throughput and measures the light that the depth limit cuts, so that the
// renderer can warn. It fills the emission AOV of escaped rays and the specular AOV. Russian
// roulette ends deep or large trees (Arvo and Kirk 1990), which keeps the mean unchanged.
#pragma once

#include "core/transport/cut_light.h"
#include "core/transport/specular/specular_bounce.h"
#include "core/transport/volume_integrator.h"

namespace exphoton {

// The radiance that leaves a point by emission and non-specular lobes, by component.
struct SurfaceLight {
  Spectrum emission, direct, caustic, indirect;

  // Returns the sum of the components. At the first hit, it also writes them to the AOVs.
  Spectrum Collect(const ShadingPoint& point, LiContext& context) const {
    if (context.aovs && point.depth == 0) {
      context.aovs->emission = emission;
      context.aovs->direct = direct;
      context.aovs->caustic = caustic;
      context.aovs->indirect = indirect;
    }
    return emission + direct + caustic + indirect;
  }
};

class SpecularTree {
 public:
  // `lights` serve to measure the cut light; null: it is not measured.
  SpecularTree(int maxDepth, LiContext& context, const LightSampler* lights = nullptr)
      : maxDepth_(maxDepth), lights_(lights), context_(context) {}

  // Returns the radiance along the ray. shade(point) has the signature Spectrum(const
  // ShadingPoint&). It returns the radiance that leaves a point by emission and non-specular lobes.
  // At depth 0 it also fills the corresponding light AOVs. If shade.See(ray) exists, it gets each
  // ray before it is traced, and infinite lights are left out.
  template <class Shade>
  Spectrum Radiance(const RayDifferential& ray, const Shade& shade) {
    return Along(ray, Spectrum(1), 0, shade);
  }

 private:
  static constexpr std::uint64_t kStream = 0x73706563ull, kRouletteStream = 0x726f756cull;
  // Trees within both limits use no Russian roulette.
  static constexpr int kPlainDepth = 5;
  static constexpr std::uint64_t kPlainRays = 64;

  // Returns the Russian roulette probability of a ray whose throughput to the camera is `weight`.
  // If a material reflects and transmits without loss, at most 10 rays of each depth are expected.
  // If it amplifies light, the growing number of rays raises the threshold of the weight.
  Real Survival(const Spectrum& weight, int depth) {
    ++rays_;
    if (depth <= kPlainDepth && rays_ <= kPlainRays) return 1;
    return SpecularSurvival(weight, std::max(Real(rays_) / Real(kPlainRays), Real(1)));
  }

  template <class Shade>
  Spectrum Along(const RayDifferential& ray, const Spectrum& throughput, int depth,
                 const Shade& shade) {
    if constexpr (requires { shade.See(ray); }) shade.See(ray);
    const auto hit = context_.Intersect(ray, depth == 0 ? RayKind::Camera : RayKind::Specular);
    const MediaSegment media = AlongMedia(ray, hit ? &hit->p : nullptr, context_);
    if (!hit) {
      const Spectrum sky = media.transmittance * Background(ray, shade) + media.radiance;
      if (depth == 0) context_.alpha = sky.IsBlack() ? 0 : 1;
      if (depth == 0 && context_.aovs) context_.aovs->emission = sky;
      return sky;
    }
    const Spectrum light = Leaving(*hit, ray, throughput * media.transmittance, depth, shade);
    if (depth == 0 && context_.aovs) Cover(media, context_.aovs);
    return media.transmittance * light + media.radiance;
  }

  template <class Shade>
  Spectrum Background(const RayDifferential& ray, const Shade& shade) const {
    if constexpr (requires { shade.See(ray); })
      return {};
    else
      return context_.scene.EscapedRadiance(ray.d);
  }

  // Applies the media between the camera and the first hit to the AOVs. Light from the media counts
  // as emission.
  static void Cover(const MediaSegment& media, AovSample* aovs) {
    for (Spectrum* aov :
         {&aovs->emission, &aovs->direct, &aovs->caustic, &aovs->indirect, &aovs->specular})
      *aov *= media.transmittance;
    aovs->emission += media.radiance;
  }

  // Returns the radiance leaving the hit towards the ray's origin.
  template <class Shade>
  Spectrum Leaving(const SurfaceInteraction& hit, const RayDifferential& ray,
                   const Spectrum& throughput, int depth, const Shade& shade) {
    ShadingPoint point =
        MakeShadingPoint(hit, ray, depth, TransportMode::Radiance, &context_.arena);
    point.throughput = throughput;
    Spectrum radiance = shade(point);
    if (!context_.scene.Features().Needs(Feature::Specular)) return radiance;
    if (depth == maxDepth_) {
      if (point.bsdf.Has(LobeSet::Specular)) CountCut(point);
      return radiance;
    }
    const auto incident = [&](const SpecularRay& bounce) {
      const Spectrum weight = throughput * bounce.throughput;
      const Real survival = Survival(weight, depth + 1);
      if (survival == 1) return Along(bounce.ray, weight, depth + 1, shade);
      if (!(context_.Stream(HashKey({kRouletteStream, rays_})).Uniform() < survival))
        return Spectrum();
      return Along(bounce.ray, weight / survival, depth + 1, shade) / survival;
    };
    const Spectrum bounces =
        SpecularBounces(point, context_.Stream(kStream + std::uint64_t(depth)), incident);
    if (depth == 0 && context_.aovs) context_.aovs->specular = bounces;
    return radiance += bounces;
  }

  // Counts a point whose specular rays the depth limit cuts.
  void CountCut(const ShadingPoint& point) {
    const Spectrum& throughput = point.throughput;
    context_.rays.cutThroughput += double((throughput * point.bsdf.Rho(LobeSet::Specular)).Y());
    if (lights_) MeasureCutLight({point, throughput, false, LobeSet::Specular}, *lights_, context_);
  }

  int maxDepth_;
  const LightSampler* lights_;
  LiContext& context_;
  std::uint64_t rays_ = 0;  // specular rays of this tree so far
};

}  // namespace exphoton
