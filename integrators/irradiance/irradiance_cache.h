// SPDX-License-Identifier: BSD-2-Clause
// IrradianceCache stores irradiance records and interpolates between them. A record is irradiance
// at a point with its gradients and the radius within which it is valid. Sources: Ward, Rubinstein
// and Clear 1988; Ward and Heckbert 1992, "Irradiance Gradients"; Tabellion and Lamorlette 2004
// (weights that fall to 0 at the radius).
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <unordered_map>
#include <vector>

#include "core/math/bounds.h"
#include "core/math/spectrum.h"
#include "core/math/vec.h"

namespace exphoton {

struct IrradianceRecord {
  Point3 p;
  Normal3 n;            // unit; on the side from which the light arrives
  Spectrum irradiance;  // W/m^2, without light straight from lights
  // Gradients of each channel: per unit of length, and per radian of a turn of n about the vector.
  std::array<Vector3, 3> translation, rotation;
  Real radius = 0;  // > 0: at this distance the weight falls to 0
};

class IrradianceCache {
 public:
  IrradianceCache() = default;
  // Records are used for normals that differ by less than maxAngle, in radians. Radii below 1e-5 of
  // worldRadius count as that.
  IrradianceCache(Real maxAngle, Real worldRadius);

  void Insert(const IrradianceRecord& record);
  std::size_t Size() const { return records_.size(); }

  struct Lookup {
    Real weight = 0;      // sum of the weights, each at most 1; 0: no record is valid
    Spectrum irradiance;  // weighted mean
  };
  Lookup Find(const Point3& p, const Normal3& n) const;

 private:
  // A grid for records of about the same radius. A record is in all cells that it reaches into.
  struct Grid {
    double cell = 1;
    std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> cells;
  };
  void Add(const IrradianceRecord& record, const Point3& p, const Normal3& n, Lookup* lookup) const;

  Real normalScale_ = 1;  // 1 / (1 - cos(maxAngle))
  Real leastRadius_ = 0;
  std::vector<IrradianceRecord> records_;
  std::map<int, Grid> grids_;  // by the exponent of the cell; the order fixes the order of sums
};

}  // namespace exphoton
