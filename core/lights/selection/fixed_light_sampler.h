// SPDX-License-Identifier: BSD-2-Clause
// FixedLightSampler chooses lights with probabilities that do not depend on the point.
// UniformLightSampler and PowerLightSampler differ in these probabilities only. Photons, which have
// no point before their light is chosen, use Sample(u).
#pragma once

#include "core/lights/selection/light_sampler.h"
#include "core/math/sampling/distribution.h"

namespace exphoton {

class FixedLightSampler : public LightSampler {
 public:
  Choice Sample(Real u) const;
  Real Pmf(const Light& light) const { return distribution_.Probability(IndexOf(light)); }

  Choice Sample(const LightReceiver&, Real u) const final { return Sample(u); }
  Real Pmf(const LightReceiver&, const Light& light) const final { return Pmf(light); }

 protected:
  // One weight per light, with the same rules as in DiscreteDistribution.
  FixedLightSampler(std::span<const std::unique_ptr<Light>> lights,
                    std::span<const double> weights);

 private:
  DiscreteDistribution distribution_;
};

// UniformLightSampler chooses all lights that are not provably black with the same probability.
class UniformLightSampler final : public FixedLightSampler {
 public:
  explicit UniformLightSampler(std::span<const std::unique_ptr<Light>> lights);
};

// PowerLightSampler chooses lights in proportion to the luminance of their power, mixed with a
// uniform share over the lights that are not provably black. The share keeps an underestimated
// power from starving its light (Veach 1997, defensive sampling). If no power is usable, the choice
// is uniform.
class PowerLightSampler final : public FixedLightSampler {
 public:
  static constexpr double kUniformShare = 0.05;

  // uniformShare, in [0,1], is the uniform part of the choices. powerFactors scale the power of
  // each light first; empty means factors of 1.
  explicit PowerLightSampler(std::span<const std::unique_ptr<Light>> lights,
                             double uniformShare = kUniformShare,
                             std::span<const double> powerFactors = {});
};

}  // namespace exphoton
