// SPDX-License-Identifier: BSD-2-Clause
// IrradianceCache: records in grids by their radius, and the weighted mean of valid records.
#include "integrators/irradiance/irradiance_cache.h"

#include <algorithm>
#include <cmath>

#include "core/math/sampling/random.h"
#include "core/math/sampling/sampling.h"

namespace exphoton {
namespace {

std::int64_t CellIndex(Real x, double cell) { return std::int64_t(std::floor(double(x) / cell)); }
std::uint64_t CellKey(std::int64_t x, std::int64_t y, std::int64_t z) {
  return HashKey({std::uint64_t(x), std::uint64_t(y), std::uint64_t(z)});
}

}  // namespace

IrradianceCache::IrradianceCache(Real maxAngle, Real worldRadius)
    : normalScale_(1 / OneMinusCos(maxAngle)), leastRadius_(worldRadius * Real(1e-5)) {}

void IrradianceCache::Insert(const IrradianceRecord& record) {
  const auto index = std::uint32_t(records_.size());
  records_.push_back(record);
  IrradianceRecord& stored = records_.back();
  stored.radius = std::max(stored.radius, leastRadius_);
  int exponent = 0;
  std::frexp(double(stored.radius), &exponent);  // 2^exponent > radius
  Grid& grid = grids_[exponent + 1];
  grid.cell = std::ldexp(1.0, exponent + 1);
  const Vector3 reach(stored.radius, stored.radius, stored.radius);
  const Point3 low = stored.p - reach, high = stored.p + reach;
  for (std::int64_t x = CellIndex(low.x, grid.cell); x <= CellIndex(high.x, grid.cell); ++x)
    for (std::int64_t y = CellIndex(low.y, grid.cell); y <= CellIndex(high.y, grid.cell); ++y)
      for (std::int64_t z = CellIndex(low.z, grid.cell); z <= CellIndex(high.z, grid.cell); ++z)
        grid.cells[CellKey(x, y, z)].push_back(index);
}

IrradianceCache::Lookup IrradianceCache::Find(const Point3& p, const Normal3& n) const {
  Lookup lookup;
  for (const auto& [exponent, grid] : grids_) {
    const auto cell = grid.cells.find(
        CellKey(CellIndex(p.x, grid.cell), CellIndex(p.y, grid.cell), CellIndex(p.z, grid.cell)));
    if (cell == grid.cells.end()) continue;
    for (const std::uint32_t index : cell->second) Add(records_[index], p, n, &lookup);
  }
  if (lookup.weight > 0) lookup.irradiance /= lookup.weight;
  return lookup;
}

void IrradianceCache::Add(const IrradianceRecord& record, const Point3& p, const Normal3& n,
                          Lookup* lookup) const {
  const Vector3 offset = p - record.p;
  const Real distance = Length(offset) / record.radius;
  if (!(distance < 1)) return;
  const Real turned = SafeSqrt((1 - Dot(n, record.n)) * normalScale_);
  const Real weight = 1 - std::max(distance, turned);
  if (!(weight > 0)) return;
  // A record in front of the point may see light that the point does not see.
  constexpr Real kFarthestInFront = Real(.05);
  if (Dot(offset, n + record.n) / 2 < -kFarthestInFront * record.radius) return;
  const Vector3 turn = Cross(record.n, n);
  Spectrum irradiance = record.irradiance;
  for (int c = 0; c < Spectrum::kChannels; ++c) {
    irradiance[c] += Dot(offset, record.translation[std::size_t(c)]) +
                     Dot(turn, record.rotation[std::size_t(c)]);
    irradiance[c] = std::max(irradiance[c], Real(0));
  }
  lookup->weight += weight;
  lookup->irradiance += weight * irradiance;
}

}  // namespace exphoton
