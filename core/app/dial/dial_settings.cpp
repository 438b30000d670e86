// SPDX-License-Identifier: BSD-2-Clause
#include "core/app/dial/dial_settings.h"

#include <cstdint>
#include <string>

namespace exphoton::cli {

std::vector<ParameterOverride> DialSettings::Overrides() const {
  std::vector<ParameterOverride> overrides;
  const auto set = [&](const char* name, double value) {
    overrides.push_back({"SurfaceIntegrator", name, std::to_string(std::int64_t(value))});
  };
  if (photons != 1 && indirectPhotons > 0) set("indirectphotons", indirectPhotons * photons);
  // Fewer photons would blur caustics, and this blur is not a part of the known error.
  if (photons > 1 && causticPhotons > 0) set("causticphotons", causticPhotons * photons);
  if (gatherRays > 0) set("finalgathersamples", gatherRays);
  return overrides;
}

bool ReadsPhotonMaps(const std::string& integrator) {
  return integrator == "photonmap" || integrator == "exphotonmap";
}

}  // namespace exphoton::cli
