// SPDX-License-Identifier: BSD-2-Clause
// This header defines the glossy coat of plastic, uber and translucent: roughness and Fresnel term.
#pragma once

#include "core/scattering/lobes/microfacet.h"
#include "materials/common/surface_material.h"

namespace exphoton {

// CoatFresnel is the direction of the coat's boundary. Inverted goes from index 1.5 to 1, as in
// pbrt 1 to 3, and reflects totally beyond 41.8 degrees; existing images depend on it. Physical
// goes from 1 to 1.5.
enum class CoatFresnel { Inverted, Physical };

struct GlossSettings : SurfaceSettings {
  TexturePtr<Real> roughness = Uniform(Real(.1));
  CoatFresnel fresnel = CoatFresnel::Inverted;
};

inline const ParamTable<GlossSettings>& GlossParameters() {
  static const ParamTable<GlossSettings> table{
      SurfaceParameters(),
      Param("roughness", &GlossSettings::roughness,
            "inverse of the gloss exponent; below .001 counts as .001")
          .AtLeast(0),
      Param("fresnel", &GlossSettings::fresnel,
            "the gloss's Fresnel term: from index 1.5 to 1 as in pbrt 1 to 3, or from 1 to 1.5")
          .OneOf({{"inverted", CoatFresnel::Inverted}, {"physical", CoatFresnel::Physical}})};
  return table;
}

// `index` is the index of refraction of the coat.
inline Fresnel FresnelOf(CoatFresnel kind, Real index = Real(1.5)) {
  return kind == CoatFresnel::Inverted ? Fresnel::Dielectric(index, 1)
                                       : Fresnel::Dielectric(1, index);
}

}  // namespace exphoton
