// SPDX-License-Identifier: BSD-2-Clause
// This file implements the loops over cone axes with Real16, which the including file defines.

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

constexpr ConeLoops kLoops{Choose, Count};
