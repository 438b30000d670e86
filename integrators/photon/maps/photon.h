// SPDX-License-Identifier: BSD-2-Clause
// Photons as plain data, and how they are stored. Not how they are searched: that is photon_map.h.
#pragma once

#include <cstdint>

#include "core/math/spectrum.h"
#include "core/spatial/block_store.h"
#include "integrators/photon/maps/photon_distance.h"

namespace exphoton {

// A packet of power that arrived at a surface.
struct Photon {
  Point3 p;
  Vector3 wi;      // unit, back along its path: where the light came from
  Spectrum alpha;  // power; a map's estimate divides by the number of paths traced for that map
  // Along the path, to where it was emitted or last scattered by other than mirrors and glass, as a
  // part of PhotonBuffer::farthest.
  Real distance = 1;
};

// A place at which exitant radiance is to be computed: a sample of the stored photons.
struct RadiancePhotonSite {
  Point3 p;
  Normal3 n;             // unit geometric normal, on the side the photon arrived on
  Spectrum reflectance;  // hemispherical-hemispherical, diffuse lobes only
  Spectrum transmittance;
  Real glossyShare = 0;   // of what the non-specular lobes scatter, by the glossy ones; in [0,1]
  bool isCoated = false;  // Bsdf::IsCoated
};

enum class PhotonKind { Direct, Caustic, Indirect };
inline constexpr int kPhotonKindCount = 3;
inline const char* PhotonKindName(PhotonKind kind) {
  return kind == PhotonKind::Direct    ? "direct"
         : kind == PhotonKind::Caustic ? "caustic"
                                       : "indirect";
}

// A photon of 28 bytes: its direction takes four, and is within 1.2e-3 radians of what it was; the
// distance lies in its lowest bits (photon_distance.h).
struct PhotonRecord {
  Point3 p;
  std::uint32_t direction = 0;  // EncodeOctahedral
  Spectrum alpha;

  PhotonRecord() = default;
  explicit PhotonRecord(const Photon& photon)
      : p(photon.p),
        direction(EncodeOctahedral(photon.wi, EncodeDistance(photon.distance))),
        alpha(photon.alpha) {}
};

// Sixteen photons.
struct PhotonBlock : PointBlock {
  using Record = PhotonRecord;

  Real r[kBlockPoints], g[kBlockPoints], b[kBlockPoints];  // alpha

  Spectrum Alpha(std::uint32_t lane) const { return {r[lane], g[lane], b[lane]}; }
  void Set(std::uint32_t lane, const PhotonRecord& photon) {
    PointBlock::Set(lane, {photon.p, photon.direction});
    r[lane] = photon.alpha.r;
    g[lane] = photon.alpha.g;
    b[lane] = photon.alpha.b;
  }
};

// The photons of one map, and the number of paths traced from the lights until it was full.
struct PhotonBuffer {
  BlockStore<PhotonBlock> photons;
  std::int64_t paths = 0;
  Real farthest = Real(1e9);  // what distances are parts of

  PhotonBuffer() = default;
  PhotonBuffer(std::span<const Photon> given, std::int64_t pathCount) : paths(pathCount) {
    for (const Photon& photon : given) Add(photon);
  }
  void Add(const Photon& photon) {
    const PhotonRecord record(photon);
    photons.Append({&record, 1});
  }
};

}  // namespace exphoton
