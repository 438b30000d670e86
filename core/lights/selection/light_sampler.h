// SPDX-License-Identifier: BSD-2-Clause
// LightSampler chooses one light at random and gives the exact probability of each choice. It holds
// the only map from a light to its index. light_selection.h makes the implementations.
#pragma once

#include <memory>
#include <span>
#include <unordered_map>
#include <vector>

#include "core/lights/light.h"
#include "core/lights/selection/light_receiver.h"

namespace exphoton {

class LightSampler {
 public:
  struct Choice {
    const Light* light;
    int index;         // index into the constructor's lights
    Real probability;  // of this light; > 0
    Real remapped;     // u rescaled to a new uniform variate in [0,1)
  };

  virtual ~LightSampler();

  // Returns whether every light is provably black. Sample must not be called then.
  bool IsEmpty() const { return isEmpty_; }
  // Returns the receiver with the values that several calls of Sample and Pmf share, so that they
  // are computed once. The results of these calls stay the same.
  virtual LightReceiver Prepared(const LightReceiver& receiver) const { return receiver; }
  // Chooses a light for a place. u is uniform in [0,1). A provably black light is never chosen.
  virtual Choice Sample(const LightReceiver& receiver, Real u) const = 0;
  // Returns the probability with which Sample chooses one of the constructor's lights for the
  // receiver. It is 0 for a provably black light, and positive for every other light.
  virtual Real Pmf(const LightReceiver& receiver, const Light& light) const = 0;

 protected:
  // The lights must be prepared (Light::Prepare) and outlive this object.
  explicit LightSampler(std::span<const std::unique_ptr<Light>> lights);

  const Light* LightAt(int index) const { return lights_[std::size_t(index)]; }
  int IndexOf(const Light& light) const;

 private:
  std::vector<const Light*> lights_;
  std::unordered_map<const Light*, int> indices_;
  bool isEmpty_;
};

// Returns the luminance of a light's power, or 0 if it is not finite and positive. Implementations
// choose such a light by their uniform share only.
double UsablePower(const Light& light);

}  // namespace exphoton
