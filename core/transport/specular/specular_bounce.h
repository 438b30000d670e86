// SPDX-License-Identifier: BSD-2-Clause
// Specular bounces: the rays that continue at specular lobes, with ray differentials for the
// reflected and refracted footprint (Igehy 1999). The caller supplies the radiance along each ray.
#pragma once

#include <algorithm>
#include <optional>
#include <span>

#include "core/transport/integrator.h"
#include "core/transport/shading_point.h"

namespace exphoton {

struct SpecularRay {
  RayDifferential ray;
  Spectrum throughput;
};

// Sets the differentials of `ray`, which leaves the point by a specular `sample`. They follow from
// the differentials of point.ray. `ray` gets none if they are unknown or not finite.
void AddSpecularDifferentials(const ShadingPoint& point, const BsdfSample& sample,
                              RayDifferential* ray);

// Samples the ray of one specular lobe among `lobes` (reflection, transmission or both); uLobe
// chooses uniformly. Returns nullopt if there is no such lobe or its throughput is black or not
// finite.
std::optional<SpecularRay> SampleSpecularRay(const ShadingPoint& point, LobeSet lobes, Point2 u,
                                             Real uLobe);

// From this depth on, one randomly chosen specular lobe is followed instead of both. This bounds
// the number of rays of a deep recursion.
inline constexpr int kMaxSplitDepth = 8;

// Returns the probability with which Russian roulette continues a specular ray of this weight. Rays
// above 0.1 times `excess` survive, so the roulette adds little noise. No probability is below
// 1e-3, so that a rare survivor does not become a firefly.
inline Real SpecularSurvival(const Spectrum& weight, Real excess) {
  constexpr Real kSafeWeight = Real(.1);
  return std::clamp(weight.MaxComponent() / (kSafeWeight * excess), Real(1e-3), Real(1));
}

// Sums throughput * incident(ray) over specular reflection and transmission.
template <class Incident>  // signature: Spectrum(const SpecularRay&)
Spectrum SpecularBounces(const ShadingPoint& point, RandomStream random, Incident&& incident) {
  constexpr LobeSet kTogether[] = {LobeSet::Specular};
  constexpr LobeSet kSplit[] = {LobeSet::SpecularReflection, LobeSet::SpecularTransmission};
  Spectrum sum;
  const std::span<const LobeSet> branches =
      point.depth < kMaxSplitDepth ? std::span<const LobeSet>(kSplit) : kTogether;
  for (const LobeSet lobes : branches) {
    if (!point.bsdf.Has(lobes)) continue;
    const Point2 u{random.Uniform(), random.Uniform()};
    if (const auto bounce = SampleSpecularRay(point, lobes, u, random.Uniform()))
      sum += bounce->throughput * incident(*bounce);
  }
  return sum;
}

}  // namespace exphoton
