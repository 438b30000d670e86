// SPDX-License-Identifier: BSD-2-Clause
// GuideCache: where the light of nearby photons comes from, found once for each cell of space and
// kept while a thread works close by. What a cell says follows from where it lies alone, so no
// pixel depends on which were rendered before it.
#pragma once

#include <vector>

#include "core/base/arena.h"
#include "integrators/photon/gather/cone.h"
#include "integrators/photon/maps/photon_map.h"

namespace exphoton {

// The photons nearest to a place, in the order of a curve over the sphere.
class GuideCacheCell {
 public:
  GuideCacheCell() = default;
  GuideCacheCell(const PhotonMap& map, const Point3& middle, int count, const Cone& cone,
                 Arena* scratch);

  const Point3& Middle() const { return middle_; }
  Real Radius2() const { return radius2_; }  // within which they lie, squared
  std::size_t size() const { return count_; }
  // Where the light of each comes from, from the middle, one component after the other.
  const Real* X() const { return rows_.data(); }
  const Real* Y() const { return X() + Room(); }
  const Real* Z() const { return Y() + Room(); }
  // Of each: so many others come from within a cone about its direction, seen from the middle, that
  // light is denser there than at random if fewer than this are to be expected.
  const Real* DenserThan() const { return Z() + Room(); }
  // Length of a row: whole runs; what fills the last is 0.
  std::size_t Room() const { return rows_.size() / kRows; }

 private:
  static constexpr std::size_t kRows = 4;

  Point3 middle_;
  Real radius2_ = 0;
  std::size_t count_ = 0;
  std::vector<Real> rows_;
};

class GuideCache {
 public:
  // Cells of `count` photons and `width`, > 0. The map must outlive this.
  GuideCache(const PhotonMap& map, int count, const Cone& cone, Real width)
      : map_(map), count_(count), cone_(cone), width_(width), slots_(kSlots) {}

  // That p lies in. Valid until the next call.
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
