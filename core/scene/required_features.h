// SPDX-License-Identifier: BSD-2-Clause
// RequiredFeatures states which effects a scene needs, each with its reason. It is computed once,
// from the scene, the camera and the integrator. A feature is off only if its contribution is
// provably zero, or if the integrator never computes it, so feature culling never changes the
// picture. Integrators and the renderer receive it as data.
#pragma once

#include <array>
#include <initializer_list>
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

// FeatureSet is a set of features. Integrators state with it which effects they can compute.
class FeatureSet {
 public:
  constexpr FeatureSet() = default;
  constexpr FeatureSet(std::initializer_list<Feature> features) {
    for (const Feature feature : features) bits_ |= Bit(feature);
  }
  static constexpr FeatureSet All() {
    FeatureSet all;
    all.bits_ = (1u << kFeatureCount) - 1;
    return all;
  }
  constexpr bool Has(Feature feature) const { return (bits_ & Bit(feature)) != 0; }
  constexpr FeatureSet Without(FeatureSet other) const {
    FeatureSet rest;
    rest.bits_ = bits_ & ~other.bits_;
    return rest;
  }

 private:
  static constexpr unsigned Bit(Feature feature) { return 1u << unsigned(feature); }
  unsigned bits_ = 0;
};
// The features that belong to photon maps alone.
inline constexpr FeatureSet kPhotonMapFeatures{Feature::Transmission, Feature::Glossy};
// The features that change how much light reaches a surface.
inline constexpr FeatureSet kInterreflection{Feature::Caustics, Feature::Indirect};

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
  // Switches off the features that the integrator does not compute. Features that are off keep
  // their reason.
  void KeepComputed(FeatureSet computed);

  // Returns one line per feature, such as "caustics      off  no specular surface".
  std::string Describe() const;
  // Further lines of the description, such as "lights        3 (1 black, skipped)".
  std::vector<std::string> notes;

 private:
  std::array<Row, kFeatureCount> rows_;
};

}  // namespace exphoton
