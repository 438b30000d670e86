// SPDX-License-Identifier: BSD-2-Clause
// ShootRoomPhotons returns the photons of a light in the benchmark room, and the places where a
// renderer searches for them.
#pragma once

#include "integrators/photon/maps/photon.h"
#include "integrators/photon/radiance/radiance_photon_map.h"

namespace exphoton {

struct SurfacePlace {
  Point3 p;
  Normal3 n;  // on the side that is searched
};

struct RoomPhotons {
  std::vector<Photon> photons;
  std::vector<RadiancePhotonSite> seeds;  // one per photon
  std::vector<SurfacePlace> coherent;     // camera ray hits, in scanlines
  std::vector<SurfacePlace> scattered;    // second-bounce hits, shuffled
};
RoomPhotons ShootRoomPhotons(std::size_t count, std::size_t places);

// Sorts places along a Morton curve (Morton 1966), which keeps neighbours together.
std::vector<SurfacePlace> InMortonOrder(std::vector<SurfacePlace> places);

}  // namespace exphoton
