// SPDX-License-Identifier: BSD-2-Clause
// DialSettings are the parameters of a photon integrator that --accuracy may change.
#pragma once

#include <string>
#include <vector>

#include "core/parser/render_setup.h"

namespace exphoton::cli {

struct DialSettings {
  double indirectPhotons = 0, causticPhotons = 0;  // of the scene; 0: none
  double photons = 1;                              // factor
  int gatherRays = 0;                              // at a shading point; 0: the scene's

  // Returns the parameters that differ from the scene.
  std::vector<ParameterOverride> Overrides() const;
};

// Returns whether an integrator that --accuracy knows reads photon maps and gathers.
bool ReadsPhotonMaps(const std::string& integrator);

}  // namespace exphoton::cli
