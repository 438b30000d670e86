// SPDX-License-Identifier: BSD-2-Clause
// Specular bounces: the rays that continue at specular lobes, with differentials for the reflected
// and refracted footprint (Igehy 1999). What arrives along them is the caller's affair.
#pragma once

#include <optional>
#include <span>

#include "core/transport/integrator.h"
#include "core/transport/shading_point.h"

namespace exphoton {

struct SpecularRay {
  RayDifferential ray;
  Spectrum throughput;
  bool isTransmission = false;
};

// Gives `ray`, which leaves the point by a specular `sample`, the neighbours that the bounce makes
// of those of point.ray; none where they are unknown or not finite.
void AddSpecularDifferentials(const ShadingPoint& point, const BsdfSample& sample,
                              RayDifferential* ray);

// The ray of one specular lobe among `lobes` (specular reflection or transmission, or both), picked
// uniformly by uLobe; nullopt where there is none or it carries nothing.
std::optional<SpecularRay> SampleSpecularRay(const ShadingPoint& point, LobeSet lobes, Point2 u,
                                             Real uLobe);

// Beyond this depth one of the two lobes is followed, picked at random, so that the rays of a deep
// recursion stay countable.
inline constexpr int kMaxSplitDepth = 8;

// Sum over reflection and transmission of throughput * incident(ray): both are followed.
template <class Incident>  // Spectrum(const SpecularRay&)
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
