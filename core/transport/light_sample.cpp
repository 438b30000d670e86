// SPDX-License-Identifier: BSD-2-Clause
// SampledLight: a shadow ray is traced only if its contribution can be non-zero.
#include "core/transport/light_sample.h"

#include "core/math/sampling/mis.h"

namespace exphoton {

Spectrum FromLightSample(const ShadingPoint& point, const SampledLight& sample,
                         TechniqueCounts counts, LobeSet lobes, LiContext& context) {
  const auto direct = sample.light->SampleDirect(point.surface, sample.place, sample.part);
  if (!direct || direct->Li.IsBlack()) return {};
  const Real cosine = AbsDot(direct->wi, point.bsdf.Ns());
  const Spectrum f = point.bsdf.f(point.Wo(), direct->wi, lobes) * cosine;
  if (f.IsBlack()) return {};
  const Spectrum arriving = context.Unoccluded(direct->shadowRay) * direct->Li;
  const Real pdf = sample.probability * direct->pdf;
  if (arriving.IsBlack() || sample.light->IsDelta()) return f * arriving / pdf;
  const Real bsdfPdf = point.bsdf.Pdf(point.Wo(), direct->wi, lobes);
  return f * arriving * (PowerHeuristic(counts.light, pdf, counts.bsdf, bsdfPdf) / pdf);
}

}  // namespace exphoton
