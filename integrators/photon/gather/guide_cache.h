// SPDX-License-Identifier: BSD-2-Clause
// GuideCache stores, per cell of space, the origins of the light of nearby photons. Each thread has
// its own direct-mapped cache. A miss overwrites the cell in the same slot. The content of a cell
// depends only on the map and the cell's position, so no pixel depends on the pixels rendered
// before it.
#pragma once

#include <vector>

#include "core/base/arena.h"
#include "integrators/photon/gather/cone.h"
#include "integrators/photon/maps/photon_map.h"

namespace exphoton {

// GuideCacheCell holds the photons nearest to a point, in Hilbert order of their directions.
class GuideCacheCell {
 public:
  GuideCacheCell() = default;
  GuideCacheCell(const PhotonMap& map, const Point3& center, int count, const Cone& cone,
                 Arena* scratch);

  const Point3& Center() const { return center_; }
  Real Radius2() const { return radius2_; }  // squared distance of the farthest photon
  std::size_t size() const { return count_; }
  // Origins of the photons' light, relative to the center, as a structure of arrays.
  const Real* X() const { return rows_.data(); }
  const Real* Y() const { return X() + RowLength(); }
  const Real* Z() const { return Y() + RowLength(); }
  // Per photon: let n be the number of other photons in the cone about its direction, seen from the
  // center. The value is the expected count e with n = 2 e + sqrt(e). The cone is over-dense where
  // fewer than e photons are expected.
  const Real* DenserThan() const { return Z() + RowLength(); }
  // Returns the length of a row: the photon count, padded to a whole number of SIMD vectors.
  std::size_t RowLength() const { return rows_.size() / kRows; }

 private:
  static constexpr std::size_t kRows = 4;

  Point3 center_;
  Real radius2_ = 0;
  std::size_t count_ = 0;
  std::vector<Real> rows_;
};

class GuideCache {
 public:
  // Each cell is `width` > 0 wide and holds `count` photons. The map must outlive this object.
  GuideCache(const PhotonMap& map, int count, const Cone& cone, Real width)
      : map_(map), count_(count), cone_(cone), width_(width), slots_(kSlots) {}

  // Returns the cell that contains p. It is valid until the next call.
  const GuideCacheCell& At(const Point3& p);

 private:
  struct Key {
    Real x, y, z;  // whole numbers
    bool operator==(const Key&) const = default;
  };
  struct Slot {
    Key key{};
    bool isUsed = false;
    GuideCacheCell cell;
  };
  static constexpr std::size_t kSlots = 256;

  const PhotonMap& map_;
  int count_;
  Cone cone_;
  Real width_;
  std::vector<Slot> slots_;
  Arena scratch_;
};

}  // namespace exphoton
