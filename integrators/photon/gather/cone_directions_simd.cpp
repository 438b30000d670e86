// SPDX-License-Identifier: BSD-2-Clause
// The loops of ConeDirections, compiled for each SIMD target.
#include "integrators/photon/gather/cone_directions.h"

#include "core/math/simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "integrators/photon/gather/cone_directions_simd.cpp"
#include <hwy/foreach_target.h>

#include "core/math/simd/reals.inl"

HWY_BEFORE_NAMESPACE();
namespace exphoton::HWY_NAMESPACE {
namespace {

std::size_t Choose(const DirectionRows& from, Real scale, Real* x, Real* y, Real* z) {
  const Real16 scales = Real16::All(scale);
  std::size_t chosen = 0;
  for (std::size_t i = 0; i < from.count; i += ConeDirections::kRun) {
    const unsigned mask = LessMask(Real16::LoadUnaligned(from.value + i) * scales,
                                   Real16::LoadUnaligned(from.limit + i));
    StoreLanes(Real16::LoadUnaligned(from.x + i), mask, x + chosen);
    StoreLanes(Real16::LoadUnaligned(from.y + i), mask, y + chosen);
    chosen += StoreLanes(Real16::LoadUnaligned(from.z + i), mask, z + chosen);
  }
  return chosen;
}

int Count(const Real* x, const Real* y, const Real* z, std::size_t count, const Vector3& w,
          Real chord2) {
  const Real16 wx = Real16::All(w.x), wy = Real16::All(w.y), wz = Real16::All(w.z);
  const Real16 limit = Real16::All(chord2);
  std::size_t within = 0;
  for (std::size_t i = 0; i < count; i += ConeDirections::kRun) {
    const Real16 dx = Real16::LoadUnaligned(x + i) - wx, dy = Real16::LoadUnaligned(y + i) - wy,
                 dz = Real16::LoadUnaligned(z + i) - wz;
    within += CountLessEqual(dx * dx + dy * dy + dz * dz, limit);
  }
  return int(within);
}

}  // namespace

extern const ConeLoops kConeLoops;
const ConeLoops kConeLoops{Choose, Count};

}  // namespace exphoton::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace exphoton {

std::span<const ConeLoops* const> ConeDirections::Loops() {
  static const ConeLoops* const all[] = EXPHOTON_SIMD_TARGETS(kConeLoops);
  return {all, UsableSimdTargets()};
}

ConeDirections::ConeDirections(std::size_t capacity, Arena* arena) {
  const std::size_t room = WholeRuns(capacity) + kRun;  // `choose` may write one run more
  x_ = arena->AllocateArray<Real>(3 * room);
  y_ = x_ + room;
  z_ = y_ + room;
}

void ConeDirections::AddChosen(const DirectionRows& from, Real scale) {
  count_ += Fastest().choose(from, scale, x_ + count_, y_ + count_, z_ + count_);
}

void ConeDirections::Finish() {
  for (std::size_t i = count_; i < WholeRuns(count_); ++i) x_[i] = y_[i] = z_[i] = kFar;
}

}  // namespace exphoton
#endif
