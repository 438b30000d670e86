// SPDX-License-Identifier: BSD-2-Clause
// SurfaceIntegrator: the answers of an integrator without photon maps and without a description.
#include "core/transport/integrator.h"

namespace exphoton {

std::vector<std::string> SurfaceIntegrator::Explain(const Scene&) const { return {}; }

std::vector<std::string> SurfaceIntegrator::PhotonMapNames() const { return {}; }

std::vector<StoredPhoton> SurfaceIntegrator::PhotonsNear(const Point3&, std::size_t, int) const {
  return {};
}

}  // namespace exphoton
