// SPDX-License-Identifier: BSD-2-Clause
// This file compiles the loops of ConeDirections for any machine, and selects the SIMD target.
#include "integrators/photon/gather/cone_directions.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "core/base/simd_targets.h"
#include "integrators/photon/gather/cone_directions_wide.h"

namespace exphoton {
namespace {

#include "core/math/simd/real16_portable.inl"
#include "integrators/photon/gather/cone_directions.inl"

}  // namespace

std::span<const ConeLoops> ConeDirections::Loops() {
#if defined(EXPHOTON_WIDE_VECTORS)
  static const ConeLoops all[] = {kLoops, kConeLoopsAvx2, kConeLoopsAvx512};
  return {all, UsableSimdTargets()};
#else
  static const ConeLoops all[] = {kLoops};
  return all;
#endif
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
