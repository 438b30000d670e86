// SPDX-License-Identifier: BSD-2-Clause
// One loop, compiled for each width of vectors.
#include "integrators/photon/cone_axes.h"

#include "core/base/vector_versions.h"

namespace exphoton {
namespace {

[[gnu::always_inline]] inline int Count(const Real* x, const Real* y, const Real* z,
                                        std::size_t count, const Vector3& w, Real chord2) {
  int within = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const Real dx = x[i] - w.x, dy = y[i] - w.y, dz = z[i] - w.z;
    within += dx * dx + dy * dy + dz * dz <= chord2;
  }
  return within;
}

int CountPortable(const Real* x, const Real* y, const Real* z, std::size_t count, const Vector3& w,
                  Real chord2) {
  return Count(x, y, z, count, w, chord2);
}

EXPHOTON_FOR_AVX2 int CountAvx2(const Real* x, const Real* y, const Real* z, std::size_t count,
                                const Vector3& w, Real chord2) {
  return Count(x, y, z, count, w, chord2);
}

EXPHOTON_FOR_AVX512 int CountAvx512(const Real* x, const Real* y, const Real* z, std::size_t count,
                                    const Vector3& w, Real chord2) {
  return Count(x, y, z, count, w, chord2);
}

}  // namespace

std::span<const ConeAxes::Counter> ConeAxes::Counters() {
  static constexpr Counter kAll[] = {CountPortable, CountAvx2, CountAvx512};
  return {kAll, VectorVersions()};
}

}  // namespace exphoton
