// SPDX-License-Identifier: BSD-2-Clause
// Photons of a lamp in the room of the benchmarks, and the places where a renderer asks for them.
#pragma once

#include "integrators/photon/maps/photon.h"
#include "integrators/photon/maps/radiance_photon_map.h"

namespace exphoton {

struct SurfacePlace {
  Point3 p;
  Normal3 n;  // on the side that is asked for
};

struct RoomPhotons {
  std::vector<Photon> photons;
  std::vector<RadiancePhotonSite> seeds;  // one a photon
  std::vector<SurfacePlace> coherent;     // what camera rays hit, in scanlines
  std::vector<SurfacePlace> scattered;    // what bounced rays hit, shuffled
};
RoomPhotons ShootRoomPhotons(std::size_t count, std::size_t places);

// In the order of a curve through space (Morton 1966), which keeps neighbours together.
std::vector<SurfacePlace> InMortonOrder(std::vector<SurfacePlace> places);

}  // namespace exphoton
