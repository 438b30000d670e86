// SPDX-License-Identifier: BSD-2-Clause
// LightDistribution: which light the next photon leaves, with its true probability. In proportion
// to the luminance of the power, mixed with a small uniform share over every light that is not
// provably black, so that an underestimated power never starves a light (Veach 1997, defensive
// sampling); or uniform over those lights.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "core/lights/light.h"
#include "core/math/sampling/distribution.h"

namespace exphoton {

// Luminance of a light's power; 0 where it is no usable number (a uniform share then serves it).
double UsablePower(const Light& light);

enum class LightSelection { Power, Uniform };

class LightDistribution {
 public:
  static constexpr double kUniformShare = 0.05;

  LightDistribution() = default;
  // uniformShare, in [0,1]: what part of the choices by Power is uniform. powerFactors: what each
  // light's power is multiplied by first; empty: 1.
  LightDistribution(const std::vector<std::unique_ptr<Light>>& lights, LightSelection selection,
                    double uniformShare = kUniformShare, std::span<const double> powerFactors = {});

  bool IsEmpty() const { return distribution_.IsEmpty(); }  // every light is black

  struct Choice {
    const Light* light;
    int index;         // into the vector given
    Real probability;  // > 0
    Real remapped;     // a fresh uniform
  };
  Choice Sample(Real u) const;
  Real Probability(int index) const { return distribution_.Probability(index); }

 private:
  std::vector<const Light*> lights_;
  DiscreteDistribution distribution_;
};

}  // namespace exphoton
