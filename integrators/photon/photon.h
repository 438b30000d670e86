// SPDX-License-Identifier: BSD-2-Clause
// Photons as plain data. Not how they are stored for searching: that is photon_map.h.
#pragma once

#include <cstdint>
#include <vector>

#include "core/math/spectrum.h"
#include "core/math/vec.h"

namespace exphoton {

// A packet of power that arrived at a surface.
struct Photon {
  Point3 p;
  Vector3 wi;      // unit, back along its path: where the light came from
  Spectrum alpha;  // power; a map's estimate divides by the number of paths traced for that map
};

// A place at which exitant radiance is to be computed: a sample of the stored photons.
struct RadianceSeed {
  Point3 p;
  Normal3 n;             // unit geometric normal, on the side the photon arrived on
  Spectrum reflectance;  // hemispherical-hemispherical, non-specular lobes only
  Spectrum transmittance;
};

enum class PhotonKind { Direct, Caustic, Indirect };
inline constexpr int kPhotonKindCount = 3;
inline const char* PhotonKindName(PhotonKind kind) {
  return kind == PhotonKind::Direct    ? "direct"
         : kind == PhotonKind::Caustic ? "caustic"
                                       : "indirect";
}

// The photons of one map, and the number of paths traced from the lights until it was full.
struct PhotonHaul {
  std::vector<Photon> photons;
  std::int64_t paths = 0;
};

}  // namespace exphoton
