// SPDX-License-Identifier: BSD-2-Clause
// RenderTwoHalves renders a picture as two independent halves. The difference of the halves shows
// the noise of the picture.
#pragma once

#include "core/render/passes/render_passes.h"

namespace exphoton {

// Renders two passes, each with half the samples (rounded up), into `first` and `second`. The job's
// film receives the samples of both.
PassesResult RenderTwoHalves(const RenderJob& job, const RenderOptions& options, Film* first,
                             Film* second);

}  // namespace exphoton
