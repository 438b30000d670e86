// SPDX-License-Identifier: BSD-2-Clause
// RequiredFeatures: which effects this scene needs, decided once from the scene alone, each with
// its reason. An effect is off only where its contribution is provably zero, so the picture never
// depends on the plan. Passed to integrators and renderer as data.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/scene/feature_mask.h"

namespace exphoton {

enum class Feature {
  Caustics,      // caustic photon map and its lookups
  Indirect,      // indirect map, final gather, radiance photons
  Transmission,  // the transmitted side of radiance photons
  Specular,      // recursion at specular lobes
  Glossy,        // sampling of glossy lobes where gather rays read radiance photons
  Media,         // transmittance and ray marching
  Filtering,     // ray differentials
  Lens,          // lens samples
  Motion,        // time samples
  Environment,   // radiance of rays that escape
};
inline constexpr int kFeatureCount = 10;

const char* FeatureName(Feature effect);  // "caustics", as --effects spells it

class RequiredFeatures {
 public:
  struct Row {
    bool on = true;
    std::string reason;  // "no specular surface"
  };

  RequiredFeatures();  // everything on: what --effects all gives
  static constexpr bool IsCompiled(Feature effect) {
    return ((kCompiledFeatures >> unsigned(effect)) & 1u) != 0;
  }
  bool Needs(Feature effect) const { return IsCompiled(effect) && rows_[std::size_t(effect)].on; }
  const Row& Get(Feature effect) const { return rows_[std::size_t(effect)]; }
  void Set(Feature effect, bool on, std::string reason);

  // One line an effect: "caustics      off  no specular surface".
  std::string Describe() const;
  // Further lines that are no effect ("lights        3 (1 black, skipped)").
  std::vector<std::string> notes;

 private:
  std::array<Row, kFeatureCount> rows_;
};

}  // namespace exphoton
