// SPDX-License-Identifier: BSD-2-Clause
// SampledLight is a sampled point on a chosen light. FromLightSample returns its MIS-weighted
// contribution, with the power heuristic against BSDF samples (Veach 1997, section 9.2). All
// estimators of direct light share this code.
#pragma once

#include "core/math/sampling/mis.h"
#include "core/transport/integrator.h"
#include "core/transport/shading_point.h"

namespace exphoton {

struct SampledLight {
  const Light* light;
  Real probability = 1;  // probability of choosing this light
  Point2 place;          // uniform in [0,1)^2: position on the light
  Real part = 0;         // uniform in [0,1): part of the light
};

// The number of samples of each technique. A delta light has light samples only.
struct TechniqueCounts {
  int light = 1, bsdf = 1;
  Real Pdf(const Vector3&, Real bsdfPdf) const { return bsdfPdf; }
};

// Returns f L |cos| weight / (probability pdf) for `lobes` only. The samples of directions must use
// the same lobes. The caller divides by techniques.light. techniques.Pdf(wi, bsdfPdf) returns the
// density of the samples of directions, given the density of the BSDF.
template <class Techniques>
Spectrum FromLightSample(const ShadingPoint& point, const SampledLight& sample,
                         const Techniques& techniques, LobeSet lobes, LiContext& context) {
  const auto direct = sample.light->SampleDirect(point.surface, sample.place, sample.part);
  if (!direct || direct->Li.IsBlack()) return {};
  const Real cosine = AbsDot(direct->wi, point.bsdf.Ns());
  const Spectrum f = point.bsdf.f(point.Wo(), direct->wi, lobes) * cosine;
  if (f.IsBlack()) return {};
  const Spectrum arriving = context.Unoccluded(direct->shadowRay) * direct->Li;
  const Real pdf = sample.probability * direct->pdf;
  if (arriving.IsBlack() || sample.light->IsDelta()) return f * arriving / pdf;
  const Real other = techniques.Pdf(direct->wi, point.bsdf.Pdf(point.Wo(), direct->wi, lobes));
  return f * arriving * (PowerHeuristic(techniques.light, pdf, techniques.bsdf, other) / pdf);
}
// The same for directions that are sampled by the BSDF alone.
Spectrum FromLightSample(const ShadingPoint& point, const SampledLight& sample,
                         TechniqueCounts counts, LobeSet lobes, LiContext& context);

}  // namespace exphoton
