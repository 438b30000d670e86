// SPDX-License-Identifier: BSD-2-Clause
// The test for even times, and the choice of the photons near a time.
#include "integrators/photon/maps/timed_search.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace exphoton {
namespace {

// Returns whether the power of the photons differs between the parts of the exposure by more than
// chance. The statistic is a chi-square variate if the times are even. The limit is three standard
// deviations above its mean. If photons have different powers, the sum of their squares takes the
// place of their number.
bool AreUneven(const PhotonMap& map, const PhotonNeighbourhood& around) {
  constexpr double kFreedom = kExposureParts - 1;
  static const double kLimit = kFreedom + 3 * std::sqrt(2 * kFreedom);
  std::array<double, kExposureParts> power{};
  double all = 0, squares = 0;
  for (const std::uint32_t photon : around.photons) {
    const auto y = double(map.Alpha(photon).Y());
    power[std::size_t(map.PartOfExposure(photon) * kExposureParts)] += y;
    all += y, squares += y * y;
  }
  double differences = 0;
  for (const double part : power)
    differences += (part - all / kExposureParts) * (part - all / kExposureParts);
  return differences * kExposureParts > kLimit * squares;
}

// Returns the photons in a window of one part of the exposure around the time. At the ends of the
// exposure, the window is moved into it.
PhotonNeighbourhood NearTime(Real time, const PhotonMap& map, const PhotonNeighbourhood& around,
                             Arena* arena) {
  constexpr Real kHalf = Real(.5) / kExposureParts;
  const Interval exposure = map.Exposure();
  const Real part = (time - exposure.min) / (exposure.max - exposure.min);
  const Real middle = std::clamp(part, kHalf, 1 - kHalf);
  const std::size_t size = around.photons.size();
  const std::span<std::uint32_t> photons{arena->AllocateArray<std::uint32_t>(size), size};
  const std::span<Real> distance2{arena->AllocateArray<Real>(size), size};
  std::size_t count = 0;
  for (std::size_t i = 0; i < size; ++i) {
    if (!(std::abs(map.PartOfExposure(around.photons[i]) - middle) < kHalf)) continue;
    photons[count] = around.photons[i];
    distance2[count] = around.distance2[i];
    ++count;
  }
  return {photons.first(count), distance2.first(count), around.radius2, 2 * kHalf};
}

}  // namespace

PhotonNeighbourhood FindAt(Real time, const PhotonMap& map, const PhotonQuery& query,
                           Arena* arena) {
  const PhotonNeighbourhood around = map.Find(query, arena);
  if (!map.HasTimes() || !AreUneven(map, around)) return around;
  PhotonQuery wide = query;
  wide.k *= kExposureParts;
  wide.maxDistance *= std::sqrt(Real(kExposureParts));
  return NearTime(time, map, map.Find(wide, arena), arena);
}

}  // namespace exphoton
