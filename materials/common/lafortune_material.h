// SPDX-License-Identifier: BSD-2-Clause
// LafortuneMaterial is a measured material that a diffuse term and Lafortune lobes approximate. The
// plugins bluepaint, brushedmetal, clay, felt, primer and skin differ in the coefficients only.
//
// Source of the coefficients: fits by Stephen Westin (Cornell University) to measurements of the
// Cornell light measurement laboratory, and of skin by Marschner et al. 1999, "Image-Based BRDF
// Measurement Including Human Skin". They were published with pbrt version 1 as these six
// materials. The signs are those of Lafortune et al. 1997.
#pragma once

#include "core/scattering/lobes/lafortune.h"
#include "core/scattering/lobes/lambert.h"
#include "materials/common/surface_material.h"

namespace exphoton {

class LafortuneMaterial final : public SurfaceMaterial {
 public:
  // `fit` must outlive the material.
  LafortuneMaterial(const SurfaceSettings& settings, const Spectrum& diffuse,
                    const LafortuneFit& fit)
      : SurfaceMaterial(settings), diffuse_(diffuse), fit_(fit) {
    if (!diffuse_.IsBlack()) MayHave(LobeSet::DiffuseReflection);
    MayHave(LobeSet::GlossyReflection);
  }

  Bsdf Evaluate(SurfaceInteraction* si, TransportMode, Arena* arena) const override {
    Bsdf bsdf = MakeBsdf(si);
    if (!diffuse_.IsBlack()) bsdf.Add(arena->Make<Lambert>(diffuse_));
    bsdf.Add(arena->Make<Lafortune>(fit_));
    return bsdf;
  }

 private:
  Spectrum diffuse_;
  const LafortuneFit& fit_;
};

}  // namespace exphoton
