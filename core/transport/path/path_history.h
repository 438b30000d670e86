// SPDX-License-Identifier: BSD-2-Clause
// PathHistory classifies the light that a path carries by the bounces so far, in order from the
// camera. It decides which light AOV a contribution is added to, and whether feature culling leaves
// it out. Indirect light has scattered at least twice at non-specular lobes. A caustic goes from
// the last non-specular scattering to the light over specular lobes only.
#pragma once

#include "core/transport/integrator.h"

namespace exphoton {

class PathHistory {
 public:
  PathHistory(const RequiredFeatures& features, AovSample* aovs)
      : hasIndirect_(features.Needs(Feature::Indirect)),
        hasCaustics_(features.Needs(Feature::Caustics)),
        aovs_(aovs) {}

  void Bounce(bool isSpecular) {
    isLastSpecular_ = isSpecular;
    if (bounces_++ == 0) isFirstSpecular_ = isSpecular;
    if (!isSpecular) ++scatterings_;
  }
  bool IsScattered() const { return scatterings_ > 0; }
  // Returns whether emission at the end of the path counts.
  bool TakesEmission() const { return scatterings_ == 0 || !isLastSpecular_ || hasCaustics_; }
  // Returns whether next event estimation at the path's end counts.
  bool TakesDirect() const { return scatterings_ == 0 || hasIndirect_; }
  // Returns the lobes that may continue the path.
  LobeSet Lobes(LobeSet all) const {
    return scatterings_ == 0 || hasIndirect_ ? all : all & LobeSet::Specular;
  }

  void AddEmission(const Spectrum& radiance) const {
    if (!aovs_) return;
    if (bounces_ == 0) {
      aovs_->emission += radiance;
    } else if (isFirstSpecular_) {
      aovs_->specular += radiance;
    } else if (bounces_ == 1) {
      aovs_->direct += radiance;
    } else if (scatterings_ == 1) {
      aovs_->caustic += radiance;
    } else {
      aovs_->indirect += radiance;
    }
  }
  // Adds the radiance of media along the path segment that begins at the last bounce.
  void AddMedia(const Spectrum& radiance) const { Add(radiance, &AovSample::emission); }
  void AddDirect(const Spectrum& radiance) const { Add(radiance, &AovSample::direct); }

 private:
  // `first` is the layer of light that the path carries before its first bounce.
  void Add(const Spectrum& radiance, Spectrum AovSample::*first) const {
    if (!aovs_) return;
    if (bounces_ == 0) {
      aovs_->*first += radiance;
    } else {
      (isFirstSpecular_ ? aovs_->specular : aovs_->indirect) += radiance;
    }
  }

  bool hasIndirect_, hasCaustics_;
  AovSample* aovs_;                    // null: no AOV is requested
  int bounces_ = 0, scatterings_ = 0;  // scatterings_: non-specular bounces only
  bool isFirstSpecular_ = false, isLastSpecular_ = false;
};

}  // namespace exphoton
