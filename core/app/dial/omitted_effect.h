// SPDX-License-Identifier: BSD-2-Clause
// OmittedEffect is an effect that --accuracy leaves out, because its light is small with a known
// confidence.
#pragma once

#include <string>
#include <vector>

namespace exphoton {
struct RenderSetup;
}

namespace exphoton::cli {

struct OmittedEffect {
  std::string name;
  double bound = 0;  // upper end of what the picture lacks, as a root of relMSE (omission_bound.h)
  double time = 0;   // share of the counted cost of the picture that it would take
};

// Returns "caustics off: at most 0.04 % of the light, would take 22 % of the time".
std::string TextOf(const OmittedEffect& effect);
bool HaveSameNames(const std::vector<OmittedEffect>& a, const std::vector<OmittedEffect>& b);
// Returns the bound of all effects together, by the triangle inequality.
double BoundOf(const std::vector<OmittedEffect>& effects);
// Switches the effects off in a loaded scene. Effects that it does not need keep their reason.
void Omit(const std::vector<OmittedEffect>& effects, const RenderSetup& setup);

}  // namespace exphoton::cli
