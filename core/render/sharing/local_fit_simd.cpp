// SPDX-License-Identifier: BSD-2-Clause
// The loops of LocalFit, compiled for each SIMD target. They use no fused operations and add lanes
// in a fixed order, so that all targets give the same bits.
#include <limits>

#include "core/math/simd/targets.h"
#include "core/render/sharing/local_fit.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/render/sharing/local_fit_simd.cpp"
#include <hwy/foreach_target.h>

#include "core/math/simd/reals.inl"

HWY_BEFORE_NAMESPACE();
namespace exphoton::HWY_NAMESPACE {
namespace {

using Real8 = Reals<8>;

Real SumOf(const Real8& values) {
  Real lanes[8];
  values.StoreUnaligned(lanes);
  return ((lanes[0] + lanes[1]) + (lanes[2] + lanes[3])) +
         ((lanes[4] + lanes[5]) + (lanes[6] + lanes[7]));
}

// Returns a where the mask's bit is set, b elsewhere.
HWY_INLINE Real8 Select(unsigned mask, const Real8& a, const Real8& b) {
  Real8 r;
  for (int i = 0; i < Real8::kRegisters; ++i)
    r.part[i] =
        hn::IfThenElse(MaskOf(Real8::Tag(), Real8::BitsOfRegister(mask, i)), a.part[i], b.part[i]);
  return r;
}

struct Vector8 {
  Real8 x, y, z;
  static HWY_INLINE Vector8 Load(const FragmentRows& rows, int column, std::size_t i) {
    using Column = FragmentRows::Column;
    return {Real8::LoadUnaligned(rows.At(Column(column)) + i),
            Real8::LoadUnaligned(rows.At(Column(column + 1)) + i),
            Real8::LoadUnaligned(rows.At(Column(column + 2)) + i)};
  }
  static HWY_INLINE Vector8 All(const Vec3& v) {
    return {Real8::All(v.x), Real8::All(v.y), Real8::All(v.z)};
  }
};
HWY_INLINE Vector8 operator-(const Vector8& a, const Vector8& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
HWY_INLINE Real8 Dot(const Vector8& a, const Vector8& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

void Describe(const FragmentRows& rows, FragmentRows::Range range, const FitTarget& target,
              std::span<const FragmentRows::Column> sets, FitNeighbours* out) {
  using F = FragmentRows;
  using N = FitNeighbours;
  const Real8 x = Real8::All(target.film.x), y = Real8::All(target.film.y);
  const Real8 scale = Real8::All(FitTarget::kFilmScale), depth = Real8::All(target.depth);
  const Vector8 p = Vector8::All(target.p), n = Vector8::All(target.n),
                ng = Vector8::All(target.ng), s = Vector8::All(target.s),
                t = Vector8::All(target.t);
  const Real8 minCosine = Real8::All(kSurfaceMinCosine), maxSlope2 = Real8::All(kSurfaceMaxSlope2);
  const Real8 far = Real8::All(std::numeric_limits<Real>::infinity());
  for (std::size_t i = range.begin; i < range.end; i += N::kRun) {
    const Vector8 d = Vector8::Load(rows, F::Px, i) - p, normal = Vector8::Load(rows, F::Gx, i);
    const Real8 limit = maxSlope2 * Dot(d, d), h = Dot(d, ng), g = Dot(d, normal);
    unsigned mask = LessEqualMask(minCosine, Dot(normal, ng)) & LessEqualMask(h * h, limit) &
                    LessEqualMask(g * g, limit) &
                    EqualMask(Real8::LoadUnaligned(rows.At(F::Depth) + i), depth);
    if (range.end - i < N::kRun) mask &= (1u << (range.end - i)) - 1;
    const Real8 dx = Real8::LoadUnaligned(rows.At(F::X) + i) - x,
                dy = Real8::LoadUnaligned(rows.At(F::Y) + i) - y;
    const Vector8 tilt = Vector8::Load(rows, F::Nx, i) - n;
    const auto store = [&](int column, const Real8& value)
                           HWY_ATTR { value.StoreUnaligned(out->At(column) + out->size); };
    store(N::Distance2, Select(mask, dx * dx + dy * dy, far));
    store(N::U1, dx * scale);
    store(N::U2, dy * scale);
    store(N::U3, Dot(tilt, s));
    store(N::U4, Dot(tilt, t));
    for (std::size_t set = 0; set < sets.size(); ++set)
      for (int c = 0; c < 4; ++c)
        store(N::Count0 + 4 * int(set) + c,
              Real8::LoadUnaligned(rows.At(F::Column(sets[set] + c)) + i));
    out->size += N::kRun;
  }
}

// Calls use(kernel, first lane) with the kernel weights 1 - d^2 / radius^2, at least 0, for each
// run with a weight above 0.
template <class Use>
HWY_INLINE void ForRuns(const FitNeighbours& from, Real radius, const Use& use) {
  const Real8 inverse = Real8::All(1 / (radius * radius)), one = Real8::All(1),
              zero = Real8::All(0);
  for (std::size_t i = 0; i < from.size; i += FitNeighbours::kRun) {
    const Real8 d2 = Real8::LoadUnaligned(from.At(FitNeighbours::Distance2) + i);
    const Real8 kernel = Max(one - d2 * inverse, zero);
    if (LessEqualMask(kernel, zero) != 0xff) use(kernel, i);
  }
}

void Accumulate(const FitNeighbours& from, Real radius, int set, FitMoments* moments) {
  using N = FitNeighbours;
  // Returns the records of the set. `column` belongs to set 0.
  const auto records = [&](int column, std::size_t i)
                           HWY_ATTR { return Real8::LoadUnaligned(from.At(column + 4 * set) + i); };
  const auto feature = [&](int f, std::size_t i)
                           HWY_ATTR { return Real8::LoadUnaligned(from.At(N::U1 + f) + i); };
  Real8 matrix[15];
  for (Real8& sum : matrix) sum = Real8::All(0);
  ForRuns(from, radius, [&](const Real8& kernel, std::size_t i) HWY_ATTR {
    const Real8 w = kernel * records(N::Count0, i);
    const Real8 u1 = feature(0, i), u2 = feature(1, i), u3 = feature(2, i), u4 = feature(3, i);
    const Real8 w1 = w * u1, w2 = w * u2, w3 = w * u3, w4 = w * u4;
    const Real8 terms[15] = {w,       w1,      w2,      w3,      w4,      w1 * u1, w1 * u2, w1 * u3,
                             w1 * u4, w2 * u2, w2 * u3, w2 * u4, w3 * u3, w3 * u4, w4 * u4};
    for (int k = 0; k < 15; ++k) matrix[k] = matrix[k] + terms[k];
  });
  for (std::size_t k = 0; k < 15; ++k) moments->matrix[k] = SumOf(matrix[k]);
  Real8 right[15];
  for (Real8& sum : right) sum = Real8::All(0);
  ForRuns(from, radius, [&](const Real8& kernel, std::size_t i) HWY_ATTR {
    for (int c = 0; c < 3; ++c) {
      const Real8 light = kernel * records(N::R0 + c, i);
      right[c] = right[c] + light;
      for (int f = 0; f < 4; ++f)
        right[3 * (f + 1) + c] = right[3 * (f + 1) + c] + light * feature(f, i);
    }
  });
  for (std::size_t k = 0; k < 15; ++k) moments->right[k / 3][k % 3] = SumOf(right[k]);
}

}  // namespace

extern const LocalFitLoops kLocalFitLoops;
const LocalFitLoops kLocalFitLoops{Describe, Accumulate};

}  // namespace exphoton::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace exphoton {

std::span<const LocalFitLoops* const> LocalFit::Loops() {
  static const LocalFitLoops* const all[] = EXPHOTON_SIMD_TARGETS(kLocalFitLoops);
  return {all, UsableSimdTargets()};
}

}  // namespace exphoton
#endif
