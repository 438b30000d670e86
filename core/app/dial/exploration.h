// SPDX-License-Identifier: BSD-2-Clause
// ExploreAll finds out, with pilots, at what prices integrators reach an accuracy.
#pragma once

#include <string>
#include <vector>

#include "core/app/dial/candidate.h"

namespace exphoton::cli {

inline constexpr const char* kGuidedPath = "guidedpath";

// First prices of all candidates come before any of them is explored further, so that a dear one
// gets small pilots only. Candidates that were left out are explored if the others turn out to cost
// more.
std::vector<Candidate> ExploreAll(PilotRenderer* pilots, const std::vector<std::string>& names,
                                  const Wish& wish);

// The same for an integrator without rivals, which the user names or keeps. If it is path or
// guidedpath, and there are mirrors or glass, a rough pilot of exphotonmap shows whether it lacks
// much light (Candidate::lackingShare). It keeps its price.
Candidate ExploreNamed(PilotRenderer* pilots, const std::string& name, const Wish& wish);

}  // namespace exphoton::cli
