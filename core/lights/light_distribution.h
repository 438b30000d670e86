// SPDX-License-Identifier: BSD-2-Clause
// LightDistribution chooses the light that the next photon leaves, with its exact probability. The
// choice is in proportion to the luminance of the power, or uniform over the lights that are not
// provably black. The choice by power is mixed with a small uniform share over these lights, so
// that an underestimated power never starves a light (Veach 1997, defensive sampling).
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "core/lights/light.h"
#include "core/math/sampling/distribution.h"

namespace exphoton {

// Returns the luminance of a light's power, or 0 if it is not finite and positive. Such a light is
// chosen by the uniform share only.
double UsablePower(const Light& light);

enum class LightSelection { Power, Uniform };

class LightDistribution {
 public:
  static constexpr double kUniformShare = 0.05;

  LightDistribution() = default;
  // uniformShare, in [0,1], is the uniform part of the choices by power. powerFactors scale the
  // power of each light first; empty means factors of 1.
  LightDistribution(const std::vector<std::unique_ptr<Light>>& lights, LightSelection selection,
                    double uniformShare = kUniformShare, std::span<const double> powerFactors = {});

  bool IsEmpty() const { return distribution_.IsEmpty(); }  // true if every light is black

  struct Choice {
    const Light* light;
    int index;         // index into the constructor's vector
    Real probability;  // > 0
    Real remapped;     // a new uniform variate
  };
  Choice Sample(Real u) const;
  Real Probability(int index) const { return distribution_.Probability(index); }

 private:
  std::vector<const Light*> lights_;
  DiscreteDistribution distribution_;
};

}  // namespace exphoton
