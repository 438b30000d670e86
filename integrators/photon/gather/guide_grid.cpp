// SPDX-License-Identifier: BSD-2-Clause
// GuideGrid makes a cell by one k-NN query.
#include "integrators/photon/gather/guide_grid.h"

#include <bit>
#include <cmath>

#include "core/math/sampling/random.h"
#include "integrators/photon/gather/cone_directions.h"
#include "integrators/photon/gather/hilbert_order.h"

namespace exphoton {
namespace {

// Returns v, shortened if squared distances would not stay finite.
Vector3 Shortened(const Vector3& v) {
  constexpr Real kFarthest = Real(1e18);
  const Real length = MaxComponent(Abs(v));
  return length > kFarthest ? v * (kFarthest / length) : v;
}

// Returns the largest expected count e that a count of n clearly exceeds. It does if n is at least
// 2 e + sqrt(e): twice as many, and one standard deviation more, so that it is not by chance.
Real LargestExceededCount(Real n) { return Square((std::sqrt(1 + 8 * n) - 1) / 4); }

// Computes denserThan of each photon: the largest expected number of photons in the cone about its
// direction that the counted number clearly exceeds. Of more than kMaxCounted photons, only every
// step-th is counted; in Hilbert order these are well distributed.
void CompareWithOthers(const ConeDirections& axes, const Cone& cone, Arena* arena,
                       Real* denserThan) {
  constexpr std::size_t kMaxCounted = 1024;
  const std::size_t step = (axes.size() + kMaxCounted - 1) / kMaxCounted;
  ConeDirections counted(axes.size() / step + 1, arena);
  for (std::size_t i = 0; i < axes.size(); i += step) counted.Add(axes[i]);
  counted.Finish();
  for (std::size_t i = 0; i < axes.size(); ++i) {
    const int within = counted.CountWithin(axes[i], cone.Chord2()) - (i % step == 0);
    denserThan[i] = LargestExceededCount(Real(within) * Real(step));
  }
}

std::uint64_t Bits(Real x) { return std::bit_cast<std::uint64_t>(double(x)); }

}  // namespace

GuideCell::GuideCell(const PhotonMap& map, const Point3& center, int count, const Cone& cone,
                     Arena* scratch)
    : center_(center) {
  const Arena::Mark mark = scratch->GetMark();
  const NearPoints near = map.Nearest(center, count, scratch);
  if (near.size() == 0) {
    scratch->Rewind(mark);
    return;
  }
  radius2_ = near.distance2[near.farthest];
  count_ = near.size();
  const std::size_t room = ConeDirections::WholeRuns(count_);
  rows_.resize(kRows * room);
  Real *const x = rows_.data(), *const y = x + room, *const z = y + room;
  Real* const denserThan = z + room;
  ConeDirections axes(near.size(), scratch);
  Spectrum power;
  std::size_t i = 0;
  for (const std::uint32_t photon : HilbertOrder(map, near.index, scratch)) {
    const Vector3 origin = Shortened(map.Origin(photon) - center);
    x[i] = origin.x, y[i] = origin.y, z[i] = origin.z;
    power += map.Alpha(photon);
    axes.Add(NormalizeOr(origin, map.Direction(photon)));
    ++i;
  }
  axes.Finish();
  CompareWithOthers(axes, cone, scratch, denserThan);
  const Real area = kPi * radius2_ * Real(map.Paths());
  irradiance_ = area > 0 ? power.Y() / (area * Real(count_)) : Real(0);
  scratch->Rewind(mark);
}

std::uint64_t GuideGrid::Key::Hash() const { return HashKey({Bits(x), Bits(y), Bits(z)}); }

GuideCell GuideGrid::MakeCell(const Key& key, Arena* scratch) const {
  const Vector3 half(Real(.5), Real(.5), Real(.5));
  const Point3 center = Point3() + (Vector3(key.x, key.y, key.z) + half) * width_;
  return GuideCell(map_, center, count_, cone_, scratch);
}

}  // namespace exphoton
