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

// Window is a part of the exposure.
struct Window {
  Real middle = 0, half = 0;

  // A window of this length around the time. At the ends of the exposure, it is moved into it.
  Window(Real time, const Interval& exposure, Real length) : half(length / 2) {
    const Real part = (time - exposure.min) / (exposure.max - exposure.min);
    middle = std::clamp(part, half, 1 - half);
  }
  // Half-open, so that a window always has the same number of codes of photon times.
  bool Contains(Real part) const { return part - middle >= -half && part - middle < half; }
};

PhotonNeighbourhood Within(const Window& window, const PhotonMap& map,
                           const PhotonNeighbourhood& around, Arena* arena) {
  const std::size_t size = around.photons.size();
  const std::span<std::uint32_t> photons{arena->AllocateArray<std::uint32_t>(size), size};
  const std::span<Real> distance2{arena->AllocateArray<Real>(size), size};
  std::size_t count = 0;
  for (std::size_t i = 0; i < size; ++i) {
    if (!window.Contains(map.PartOfExposure(around.photons[i]))) continue;
    photons[count] = around.photons[i];
    distance2[count] = around.distance2[i];
    ++count;
  }
  return {photons.first(count), distance2.first(count), around.radius2, 2 * window.half};
}

}  // namespace

PhotonNeighbourhood FindAt(Real time, const PhotonMap& map, const PhotonQuery& query, Real widest,
                           Arena* arena) {
  const PhotonNeighbourhood around = map.Find(query, arena);
  const std::size_t searches = map.Size() / (std::size_t(query.k) * kSearchesInMap);
  const int windows = int(std::min<std::size_t>(searches, kExposureParts));
  if (!map.HasTimes() || windows < 2 || !AreUneven(map, around)) return around;
  PhotonQuery wide = query;
  wide.k *= windows;
  wide.maxDistance *= std::min(std::sqrt(Real(windows)), widest);
  return Within(Window(time, map.Exposure(), 1 / Real(windows)), map, map.Find(wide, arena), arena);
}

}  // namespace exphoton
