// SPDX-License-Identifier: BSD-2-Clause
// FindOmissions decides which effects --accuracy leaves out: those that bring little light and take
// much time. A tenth of the accuracy must cover the bounds of all of them (omission_bound.h), and
// the time must fall although less error is left for noise and bias.
#pragma once

#include <vector>

#include "core/app/dial/candidate.h"
#include "core/app/dial/omitted_effect.h"
#include "core/app/options/options.h"

namespace exphoton::cli {

class PilotRenderer;

// Renders small pairs with and without each effect. The first pair shows whether more of them are
// worth their cost. Leaves out nothing that --effects names, and nothing with --keep. Corrects
// the price of `chosen`, as the picture lacks these effects. Throws Error, and LoadingStopped after
// a signal.
std::vector<OmittedEffect> FindOmissions(const RenderCommand& command, PilotRenderer* pilots,
                                         Candidate* chosen, Log& log);

}  // namespace exphoton::cli
