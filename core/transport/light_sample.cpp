// SPDX-License-Identifier: BSD-2-Clause
// SampledLight: a shadow ray is traced only if its contribution can be non-zero.
#include "core/transport/light_sample.h"

namespace exphoton {

Spectrum FromLightSample(const ShadingPoint& point, const SampledLight& sample,
                         TechniqueCounts counts, LobeSet lobes, LiContext& context) {
  return FromLightSample<TechniqueCounts>(point, sample, counts, lobes, context);
}

}  // namespace exphoton
