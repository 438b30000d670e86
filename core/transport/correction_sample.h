// SPDX-License-Identifier: BSD-2-Clause
// CorrectionSample is the correction of one camera sample: an estimate of the true radiance minus
// the radiance that the integrator returned. An integrator that can certify its bias
// (SurfaceIntegrator::Certification) estimates it for a random share of its work. Its expected
// value, for given photons, is minus the error of the photon maps in this sample. The renderer
// averages corrections over blocks of pixels (core/render/certificate/).
#pragma once

#include <cstdint>

#include "core/math/spectrum.h"

namespace exphoton {

struct CorrectionSample {
  double share = 0;             // share of the gather rays to correct, > 0
  Spectrum sum;                 // radiance that reaches the camera; may be negative
  std::int64_t count = 0;       // number of corrected rays
  std::int64_t gatherRays = 0;  // of the sample, corrected or not; the renderer counts them
};

}  // namespace exphoton
