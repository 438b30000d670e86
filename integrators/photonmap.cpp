// SPDX-License-Identifier: BSD-2-Clause
// photonmap: photon mapping with final gathering (Jensen 2001), the plain algorithm that
// exphotonmap is compared with. Both share integrators/photon/photon_integrator.h; each of
// exphotonmap's improvements is a parameter here.
#include "core/plugin.h"
#include "integrators/photon/photon_integrator.h"

namespace exphoton {
namespace {

const ParamTable<PhotonSettings>& Parameters() {
  static const ParamTable<PhotonSettings> table{
      PhotonParameters(), Param("directwithphotons", &PhotonSettings::directWithPhotons,
                                "direct light from the direct photon map instead of shadow rays")};
  return table;
}

std::unique_ptr<SurfaceIntegrator> Create(const PhotonSettings& settings,
                                          const IntegratorContext&) {
  return std::make_unique<PhotonIntegrator>(settings);
}

}  // namespace
}  // namespace exphoton

EXPHOTON_INTEGRATOR("photonmap", "photon mapping with final gathering, the plain algorithm")
