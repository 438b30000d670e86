// SPDX-License-Identifier: BSD-2-Clause
// exphotonmap: extended photon mapping, for scenes whose light is mostly indirect. It is photonmap
// with seven improvements switched on: photons of nearly constant weight, precomputed radiance, a
// final gather that is guided by photons, a smooth kernel, lights chosen by power, gathers that
// neighbouring pixels share, and walls that hide photons. Four more defaults differ: pixels with
// edges take more camera samples, roulette of paths begins earlier, photons are aimed at what can
// be seen, and their emission is guided. docs/theory/exphotonmap.md derives it;
// integrators/photon/photon_integrator.h is the algorithm.
#include "core/plugin.h"
#include "integrators/photon/photon_integrator.h"

namespace exphoton {
namespace {

struct Settings : PhotonSettings {
  Settings() {
    // The seven improvements; each is a parameter of photonmap too.
    photonRoulette = PhotonRoulette::Luminance;  // photons of nearly constant weight
    radiancePhotons = true;
    hidePhotons = true;
    gatherSampling = GatherSampling::Photons;
    kernel = DensityKernel::Simpson;
    lightSelection = LightSelection::Power;
    sharedGather = true;
    // The other defaults
    edgeSamples = 4;
    rrThreshold = Real(.05);
    photonTargeting = PhotonTargeting::Auto;
    guideEmission = true;
  }
};

const ParamTable<Settings>& Parameters() {
  static const ParamTable<Settings> table{PhotonParameters()};
  return table;
}

std::unique_ptr<SurfaceIntegrator> Create(const Settings& settings, const IntegratorContext&) {
  return std::make_unique<PhotonIntegrator>(settings);
}

}  // namespace
}  // namespace exphoton

EXPHOTON_INTEGRATOR("exphotonmap",
                    "extended photon mapping: precomputed radiance, guided final gather")
