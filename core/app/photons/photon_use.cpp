// SPDX-License-Identifier: BSD-2-Clause
// The identity of photons names the program, the scene without its camera, and the scene's files.
#include "core/app/photons/photon_use.h"

#include <cstdio>

#include "core/app/identity/input_hashes.h"
#include "core/app/options/options.h"
#include "core/app/shards/scene_record.h"
#include "core/base/error.h"
#include "core/transport/integrator.h"

namespace exphoton::cli {
namespace {

std::string Text(const Interval& times) {
  char text[64];
  std::snprintf(text, sizeof text, "%.9g to %.9g", double(times.min), double(times.max));
  return text;
}

// If no shape ever moves, photons are the same at all times, and one file serves all frames of a
// moving camera.
std::string ExposureText(const RenderSetup& setup) {
  if (setup.scene->Primitives().MovesWithin({-kInfinity, kInfinity}))
    return Text(setup.camera->Shutter());
  // Training treats the time as a dimension of emission if the camera moves.
  return setup.scene->Features().Needs(Feature::Motion) ? "only the camera moves" : "nothing moves";
}

// These parameters do not act on photons, or are compared one by one.
bool ActsOnPhotons(const ParameterOverride& set) {
  for (const char* directive :
       {"Film", "Camera", "Sampler", "PixelFilter", "SurfaceIntegrator", "Accelerator"})
    if (set.directive == directive) return false;
  return true;
}

}  // namespace

PhotonFileUse MakePhotonFileUse(const std::string& path, bool isWritten, const LoadOptions& load,
                                const RenderSetup& setup) {
  if (!setup.integrator->KeepsPhotons())
    throw Error(ExitStatus::CommandLine,
                "the integrator \"" + setup.integratorName + "\" keeps no photons", {},
                "--integrator exphotonmap and --integrator photonmap do");
  PhotonFileUse use;
  use.path = path;
  use.isWritten = isWritten;
  const auto add = [&use](const std::string& name, const std::string& value) {
    use.identity.emplace_back(name, value);
  };
  add("the program", VersionText());
  add("the size of a number", std::to_string(sizeof(Real)) + " bytes");
  add("the hash of the scene's world", HashText(setup.worldHash));
  for (const InputHash& input : HashesOfInputs(setup))
    add("the hash of \"" + input.name + "\"", HashText(input.hash));
  add("--effects", load.effects);
  add("the exposure", ExposureText(setup));
  for (const ParameterOverride& set : load.parameters)
    if (ActsOnPhotons(set)) add("--set " + set.directive + "." + set.parameter, set.value);
  return use;
}

}  // namespace exphoton::cli
