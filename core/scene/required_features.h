// SPDX-License-Identifier: BSD-2-Clause
// RequiredFeatures states which effects a scene needs, each with its reason. It is computed once,
// from the scene and the camera. A feature is off only if its contribution is provably zero, so
// feature culling never changes the picture. Integrators and the renderer receive it as data.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/scene/feature_mask.h"

namespace exphoton {

enum class Feature {
  Caustics,      // caustic photon map and its lookups
  Indirect,      // indirect photon map, final gathering, radiance photons
  Transmission,  // transmitted side of radiance photons
  Specular,      // recursion at specular lobes
  Glossy,        // sampling of glossy lobes where gather rays read radiance photons
  Media,         // transmittance and ray marching
  Filtering,     // ray differentials
  Lens,          // lens samples
  Motion,        // time samples
  Environment,   // radiance of rays that escape
};
inline constexpr int kFeatureCount = 10;

const char* FeatureName(Feature feature);  // for example "caustics", as in --effects

class RequiredFeatures {
 public:
  struct Row {
    bool on = true;
    std::string reason;  // for example "no specular surface"
  };

  RequiredFeatures();  // all features on, as with --effects all
  static constexpr bool IsCompiled(Feature feature) {
    return ((kCompiledFeatures >> unsigned(feature)) & 1u) != 0;
  }
  bool Needs(Feature feature) const {
    return IsCompiled(feature) && rows_[std::size_t(feature)].on;
  }
  const Row& Get(Feature feature) const { return rows_[std::size_t(feature)]; }
  void Set(Feature feature, bool on, std::string reason);

  // Returns one line per feature, such as "caustics      off  no specular surface".
  std::string Describe() const;
  // Further lines of the description, such as "lights        3 (1 black, skipped)".
  std::vector<std::string> notes;

 private:
  std::array<Row, kFeatureCount> rows_;
};

}  // namespace exphoton
