// SPDX-License-Identifier: BSD-2-Clause
// This header defines photons and the buffers that store them. photon_map.h searches them.
#pragma once

#include <cstdint>

#include "core/math/bounds.h"
#include "core/math/spectrum.h"
#include "core/spatial/block_store.h"
#include "integrators/photon/maps/photon_distance.h"
#include "integrators/photon/maps/signed_power.h"

namespace exphoton {

// Photon is a packet of power that arrived at a surface.
struct Photon {
  Point3 p;
  Vector3 wi;  // unit, towards where the light came from
  // Power, times the ratio of the cosines of wi to the interpolated and the geometric normal
  // (docs/theory/exphotonmap.md, eq. 12). Density estimates divide it by the map's number of paths.
  Spectrum alpha;
  // Path length since the emission or the last non-specular scattering, as a fraction of
  // PhotonBuffer::farthest.
  Real distance = 1;
  bool hasNegativeSign = false;  // see SignedPower
};

// The shading normals of a surface point, of unit length. They are equal where there are no bumps.
struct ShadingNormals {
  Normal3 smooth, bumped;  // interpolated, and with bumps

  bool HasBumps() const { return bumped != smooth; }
};

// RadiancePhotonSite is a stored photon at which radiance will be precomputed.
struct RadiancePhotonSite {
  Point3 p;
  Normal3 n;             // unit geometric normal, on the side where the photon arrived
  Spectrum reflectance;  // hemispherical-hemispherical, diffuse lobes only
  Spectrum transmittance;
  Real glossyShare = 0;   // glossy part of the non-specular albedo, in [0,1]
  bool isCoated = false;  // Bsdf::IsCoated
  ShadingNormals normals = {};
};

enum class PhotonKind { Direct, Caustic, Indirect };
inline constexpr int kPhotonKindCount = 3;
inline const char* PhotonKindName(PhotonKind kind) {
  return kind == PhotonKind::Direct    ? "direct"
         : kind == PhotonKind::Caustic ? "caustic"
                                       : "indirect";
}

// PhotonRecord stores a photon in 28 bytes. The direction takes 4 bytes, with an error below 1.2e-3
// radians. The distance takes the lowest bits of the direction code (photon_distance.h).
struct PhotonRecord {
  Point3 p;
  std::uint32_t direction = 0;  // EncodeOctahedral
  SignedPower power;

  PhotonRecord() = default;
  explicit PhotonRecord(const Photon& photon)
      : PhotonRecord(photon, EncodeDistance(photon.distance)) {}
  // `payload` takes the place of the distance.
  PhotonRecord(const Photon& photon, std::uint8_t payload)
      : p(photon.p),
        direction(EncodeOctahedral(photon.wi, payload)),
        power(photon.alpha, photon.hasNegativeSign) {}
};

// PhotonBlock stores sixteen photons as a structure of arrays.
struct PhotonBlock : PointBlock {
  using Record = PhotonRecord;

  Real r[kBlockPoints], g[kBlockPoints], b[kBlockPoints];  // SignedPower::Packed

  Spectrum Alpha(std::uint32_t lane) const {
    return SignedPower::PowerOf(r[lane], g[lane], b[lane]);
  }
  Real Sign(std::uint32_t lane) const { return SignedPower::SignOf(r[lane]); }
  void Set(std::uint32_t lane, const PhotonRecord& photon) {
    PointBlock::Set(lane, {photon.p, photon.direction});
    r[lane] = photon.power.Packed().r;
    g[lane] = photon.power.Packed().g;
    b[lane] = photon.power.Packed().b;
  }
};

// PhotonBuffer holds the photons of one map, and the number of paths traced until it was full.
struct PhotonBuffer {
  BlockStore<PhotonBlock> photons;
  bool isSorted = false;  // `photons` holds the blocks of a tree, and no records
  std::int64_t paths = 0;
  bool isGuided = false;      // photons are denser and lighter where a guide sent them
  Real farthest = Real(1e9);  // scene units; Photon::distance is a fraction of this
  // If it is not empty, photons keep their times in this exposure (photon_time.h), not distances.
  Interval times{0, 0};

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
