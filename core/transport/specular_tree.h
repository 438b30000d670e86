// SPDX-License-Identifier: BSD-2-Clause
// SpecularTree: the part that Whitted-style integrators share (Whitted 1980): follow a camera ray
// to a surface, let the caller shade it, and add what arrives over its specular lobes, up to a
// depth. Counts what that depth cuts, so that the render can say so. Fills the light layers that
// are the tree's: what lies behind everything, and what arrives over specular lobes. Deep or large
// trees end by Russian roulette (Arvo and Kirk 1990), which leaves the mean as it is.
#pragma once

#include "core/transport/specular_bounce.h"
#include "core/transport/volume_integrator.h"

namespace exphoton {

// What leaves a point by emission and non-specular lobes, term by term.
struct SurfaceLight {
  Spectrum emission, direct, caustic, indirect;

  // Their sum; the camera's own surface leaves them in the layers too.
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
  SpecularTree(int maxDepth, LiContext& context) : maxDepth_(maxDepth), context_(context) {}

  // Radiance along the ray: shade(point), for Spectrum shade(const ShadingPoint&), is what leaves a
  // point by emission and its non-specular lobes; at depth 0 it fills their light layers.
  template <class Shade>
  Spectrum Radiance(const RayDifferential& ray, const Shade& shade) {
    return Along(ray, Spectrum(1), 0, shade);
  }

 private:
  static constexpr std::uint64_t kStream = 0x73706563ull, kRouletteStream = 0x726f756cull;
  // Trees within both bounds have no roulette.
  static constexpr int kPlainDepth = 5;
  static constexpr std::uint64_t kPlainRays = 64;

  // The probability with which a ray is followed that carries `weight` to the camera. Weights above
  // .1 survive, so that little noise is added. Where a material reflects and transmits without
  // loss, 10 rays of each depth are expected at most; where it does so with gain, their number
  // raises the bound.
  Real Survival(const Spectrum& weight, int depth) {
    ++rays_;
    if (depth <= kPlainDepth && rays_ <= kPlainRays) return 1;
    constexpr Real kSafeWeight = Real(.1);
    const Real excess = std::max(Real(rays_) / Real(kPlainRays), Real(1));
    // Not below 1e-3: a rare survivor must not outshine its pixel.
    return std::clamp(weight.MaxComponent() / (kSafeWeight * excess), Real(1e-3), Real(1));
  }

  template <class Shade>
  Spectrum Along(const RayDifferential& ray, const Spectrum& throughput, int depth,
                 const Shade& shade) {
    const auto hit = context_.Intersect(ray, depth == 0 ? RayKind::Camera : RayKind::Specular);
    const MediaSegment media = AlongMedia(ray, hit ? &hit->p : nullptr, context_);
    if (!hit) {
      const Spectrum sky =
          media.transmittance * context_.scene.EscapedRadiance(ray.d) + media.radiance;
      if (depth == 0) context_.alpha = sky.IsBlack() ? 0 : 1;
      if (depth == 0 && context_.aovs) context_.aovs->emission = sky;
      return sky;
    }
    const Spectrum light = Leaving(*hit, ray, throughput * media.transmittance, depth, shade);
    if (depth == 0 && context_.aovs) Cover(media, context_.aovs);
    return media.transmittance * light + media.radiance;
  }

  // What media between the camera and its surface do to the layers; their own light is emission.
  static void Cover(const MediaSegment& media, AovSample* aovs) {
    for (Spectrum* aov :
         {&aovs->emission, &aovs->direct, &aovs->caustic, &aovs->indirect, &aovs->specular})
      *aov *= media.transmittance;
    aovs->emission += media.radiance;
  }

  // Radiance leaving the hit towards the ray's origin.
  template <class Shade>
  Spectrum Leaving(const SurfaceInteraction& hit, const RayDifferential& ray,
                   const Spectrum& throughput, int depth, const Shade& shade) {
    const ShadingPoint point =
        MakeShadingPoint(hit, ray, depth, TransportMode::Radiance, &context_.arena);
    Spectrum radiance = shade(point);
    if (!context_.scene.Features().Needs(Feature::Specular)) return radiance;
    if (depth == maxDepth_) {
      if (point.bsdf.Has(LobeSet::Specular))
        context_.rays.cutThroughput += double((throughput * point.bsdf.Rho(LobeSet::Specular)).Y());
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

  int maxDepth_;
  LiContext& context_;
  std::uint64_t rays_ = 0;  // specular rays of this tree so far
};

}  // namespace exphoton
