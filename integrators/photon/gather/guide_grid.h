// SPDX-License-Identifier: BSD-2-Clause
// GuideGrid divides space into cubic cells and makes the guide of a cell. The content of a cell
// depends only on the map and the cell's position, so no pixel depends on the pixels rendered
// before it, however cells are kept.
#pragma once

#include <cstdint>
#include <vector>

#include "core/base/arena.h"
#include "integrators/photon/gather/cone.h"
#include "integrators/photon/maps/photon_map.h"

namespace exphoton {

// GuideCell holds the photons nearest to a point, in Hilbert order of their directions.
class GuideCell {
 public:
  GuideCell() = default;
  GuideCell(const PhotonMap& map, const Point3& center, int count, const Cone& cone,
            Arena* scratch);

  const Point3& Center() const { return center_; }
  Real Radius2() const { return radius2_; }  // squared distance of the farthest photon
  // Returns the luminance of the irradiance that one photon contributes on average.
  Real IrradiancePerPhoton() const { return irradiance_; }
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
  std::size_t MemoryBytes() const { return sizeof(*this) + rows_.size() * sizeof(Real); }

 private:
  static constexpr std::size_t kRows = 4;

  Point3 center_;
  Real radius2_ = 0;
  Real irradiance_ = 0;
  std::size_t count_ = 0;
  std::vector<Real> rows_;
};

class GuideGrid {
 public:
  struct Key {
    Real x = 0, y = 0, z = 0;  // whole numbers
    bool operator==(const Key&) const = default;
    std::uint64_t Hash() const;
  };

  // Each cell is `width` > 0 wide and holds `count` photons. The map must outlive this object.
  GuideGrid(const PhotonMap& map, int count, const Cone& cone, Real width)
      : map_(map), count_(count), cone_(cone), width_(width) {}

  Key KeyOf(const Point3& p) const {
    return {std::floor(p.x / width_), std::floor(p.y / width_), std::floor(p.z / width_)};
  }
  GuideCell MakeCell(const Key& key, Arena* scratch) const;

 private:
  const PhotonMap& map_;
  int count_;
  Cone cone_;
  Real width_;
};

}  // namespace exphoton
