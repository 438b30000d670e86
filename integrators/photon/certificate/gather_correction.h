// SPDX-License-Identifier: BSD-2-Clause
// GatherCorrection corrects a random choice of the rays of a gather. A ray is chosen with a
// probability in proportion to its weight and to the radiance that it read. The correction is
// divided by the expected number of choices, so its expected value is the correction of the whole
// gather.
#pragma once

#include "integrators/photon/certificate/exact_radiance.h"

namespace exphoton {

class GatherCorrection final : public GatherRay::GatherObserver {
 public:
  // All arguments must outlive this object. context.correction receives the corrections. Their
  // random numbers have a stream of their own, so the picture does not change.
  GatherCorrection(const CorrectionSources& sources, LiContext& context)
      : sources_(sources), context_(context) {}

  void Observe(const ShadingPoint& point, const GatherRay::Reads& reads) override;

 private:
  const CorrectionSources& sources_;
  LiContext& context_;
};

}  // namespace exphoton
