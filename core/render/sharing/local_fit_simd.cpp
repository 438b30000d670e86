// SPDX-License-Identifier: BSD-2-Clause
// The loops of LocalFit, compiled for each SIMD target. They use no fused operations and add lanes
// in a fixed order, so that all targets give the same bits.
#include <algorithm>
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

// Adds neighbouring lanes, then neighbouring pairs, and then both halves. A template, so that no
// instructions for floats are compiled where Reals are doubles.
template <class Reals8>
HWY_INLINE Real SumOf(const Reals8& values) {
  if constexpr (sizeof(Real) > sizeof(float)) {
    Real lanes[8];
    values.StoreUnaligned(lanes);
    return ((lanes[0] + lanes[1]) + (lanes[2] + lanes[3])) +
           ((lanes[4] + lanes[5]) + (lanes[6] + lanes[7]));
  } else {
    typename Reals8::Register fours[Reals8::kRegisters];
    for (int i = 0; i < Reals8::kRegisters; ++i) {
      const auto pairs = hn::Add(values.part[i], hn::Shuffle2301(values.part[i]));
      fours[i] = hn::Add(pairs, hn::Shuffle1032(pairs));
    }
    if constexpr (Reals8::kRegisters == 2)
      return hn::GetLane(fours[0]) + hn::GetLane(fours[1]);
    else
      return hn::GetLane(fours[0]) +
             hn::GetLane(hn::UpperHalf(hn::Half<typename Reals8::Tag>(), fours[0]));
  }
}

// Mask8 is one condition for each lane, in registers of the target.
struct Mask8 {
  hn::Mask<Real8::Tag> part[Real8::kRegisters];
};
#define EXPHOTON_MASK(name, Type, operation)                                                 \
  HWY_INLINE Mask8 name(const Type& a, const Type& b) {                                      \
    Mask8 r;                                                                                 \
    for (int i = 0; i < Real8::kRegisters; ++i) r.part[i] = operation(a.part[i], b.part[i]); \
    return r;                                                                                \
  }
EXPHOTON_MASK(IsLess, Real8, hn::Lt)
EXPHOTON_MASK(IsAtMost, Real8, hn::Le)
EXPHOTON_MASK(IsEqual, Real8, hn::Eq)
EXPHOTON_MASK(operator&, Mask8, hn::And)
#undef EXPHOTON_MASK
// Returns a without b.
HWY_INLINE Mask8 Without(const Mask8& a, const Mask8& b) {
  Mask8 r;
  for (int i = 0; i < Real8::kRegisters; ++i) r.part[i] = hn::AndNot(b.part[i], a.part[i]);
  return r;
}
HWY_INLINE Mask8 FirstLanes(std::size_t count) {
  Mask8 r;
  for (std::size_t i = 0; i < Real8::kRegisters; ++i)
    r.part[i] = hn::FirstN(Real8::Tag(), count - std::min(count, i * Real8::kLanes));
  return r;
}
HWY_INLINE bool HasNone(const Mask8& mask) {
  bool none = true;
  for (int i = 0; i < Real8::kRegisters; ++i)
    none = none && hn::AllFalse(Real8::Tag(), mask.part[i]);
  return none;
}
// Returns a where the mask is set, b elsewhere.
HWY_INLINE Real8 Select(const Mask8& mask, const Real8& a, const Real8& b) {
  Real8 r;
  for (int i = 0; i < Real8::kRegisters; ++i)
    r.part[i] = hn::IfThenElse(mask.part[i], a.part[i], b.part[i]);
  return r;
}

// Kernel weights are 1 - d^2 / radius^2, at least 0.
class FitKernel {
 public:
  explicit HWY_INLINE FitKernel(Real radius) : inverse_(Real8::All(1 / (radius * radius))) {}
  HWY_INLINE Real8 At(const Real8& distance2) const {
    return Max(Real8::All(1) - distance2 * inverse_, Real8::All(0));
  }

 private:
  Real8 inverse_;
};

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

// The surface of a target.
struct Surface8 {
  Vector8 p, n, ng;
  Real8 depth;
  explicit HWY_INLINE Surface8(const FitTarget& target)
      : p(Vector8::All(target.p)),
        n(Vector8::All(target.n)),
        ng(Vector8::All(target.ng)),
        depth(Real8::All(target.depth)) {}
  // Returns the fragments of a run that lie on the surface, out of some of them.
  HWY_INLINE Mask8 Holds(const FragmentRows& rows, std::size_t i, const Mask8& some) const {
    using F = FragmentRows;
    const Vector8 normal = Vector8::Load(rows, F::Gx, i);
    const Mask8 aligned = some & IsAtMost(Real8::All(kSurfaceMinCosine), Dot(normal, ng));
    if (HasNone(aligned)) return aligned;
    const Vector8 d = Vector8::Load(rows, F::Px, i) - p;
    const Real8 limit = Real8::All(kSurfaceMaxSlope2) * Dot(d, d), h = Dot(d, ng),
                g = Dot(d, normal);
    return aligned & IsAtMost(h * h, limit) & IsAtMost(g * g, limit) &
           IsEqual(Real8::LoadUnaligned(rows.At(F::Depth) + i), depth);
  }
  // Returns the fragments of a run that have the target's shading normal.
  HWY_INLINE Mask8 IsNormalOf(const Vector8& normals) const {
    return IsEqual(normals.x, n.x) & IsEqual(normals.y, n.y) & IsEqual(normals.z, n.z);
  }
};

template <bool kHasFeatures>
void DescribeWith(const FitTarget& target, FitNeighbours* out) {
  using F = FragmentRows;
  using N = FitNeighbours;
  const FragmentRows& rows = *out->rows;
  const Real8 x = Real8::All(target.film.x), y = Real8::All(target.film.y);
  const Real8 scale = Real8::All(FitTarget::kFilmScale);
  const Real8 far = Real8::All(std::numeric_limits<Real>::infinity());
  const FitKernel kernel(out->radius);
  const Surface8 surface(target);
  const auto store = [&](int column, std::size_t run, const Real8& value)
                         HWY_ATTR { value.StoreUnaligned(out->At(column) + run * N::kRun); };
  std::size_t runs = 0, tilted = 0;
  for (const F::Range& range : out->ranges) {
    for (std::size_t i = range.begin; i < range.end; i += N::kRun) {
      const Real8 dx = Real8::LoadUnaligned(rows.At(F::X) + i) - x,
                  dy = Real8::LoadUnaligned(rows.At(F::Y) + i) - y, d2 = dx * dx + dy * dy;
      Mask8 mask = IsLess(Real8::All(0), kernel.At(d2));
      if (range.end - i < N::kRun) mask = mask & FirstLanes(range.end - i);
      if (HasNone(mask)) continue;
      mask = surface.Holds(rows, i, mask);
      if (HasNone(mask)) continue;
      store(N::Distance2, runs, Select(mask, d2, far));
      if constexpr (kHasFeatures) {
        store(N::U1, runs, dx * scale);
        store(N::U2, runs, dy * scale);
        const Vector8 normals = Vector8::Load(rows, F::Nx, i);
        if (!HasNone(Without(mask, surface.IsNormalOf(normals)))) {
          const Vector8 tilt = normals - surface.n;
          store(N::U3, tilted, Dot(tilt, Vector8::All(target.s)));
          store(N::U4, tilted, Dot(tilt, Vector8::All(target.t)));
          out->tilted[tilted++] = runs;
        }
      }
      out->first[runs++] = i;
    }
  }
  out->runs = runs;
  out->tiltedRuns = tilted;
}

void Describe(const FitTarget& target, FitNeighbours* out) { DescribeWith<true>(target, out); }
void Locate(const FitTarget& target, FitNeighbours* out) { DescribeWith<false>(target, out); }

// The records of one set.
struct Records8 {
  const Real *count, *light[3];
  Records8(const FragmentRows& rows, FragmentRows::Column set) : count(rows.At(set)) {
    for (int c = 0; c < 3; ++c) light[c] = rows.At(FragmentRows::Column(set + 1 + c));
  }
};

// Adds the moments of position.
void AddFilmMoments(const FitNeighbours& from, Real radius, const Records8& records,
                    FitMoments* moments) {
  using N = FitNeighbours;
  const FitKernel kernel(radius);
  const bool isSmaller = radius < from.radius;
  Real8 matrix[6], right[9];
  for (Real8& sum : matrix) sum = Real8::All(0);
  for (Real8& sum : right) sum = Real8::All(0);
  for (std::size_t run = 0; run < from.runs; ++run) {
    const std::size_t at = run * N::kRun, i = from.first[run];
    const Real8 k = kernel.At(Real8::LoadUnaligned(from.At(N::Distance2) + at));
    if (isSmaller && HasNone(IsLess(Real8::All(0), k))) continue;
    const Real8 u1 = Real8::LoadUnaligned(from.At(N::U1) + at),
                u2 = Real8::LoadUnaligned(from.At(N::U2) + at);
    const Real8 w = k * Real8::LoadUnaligned(records.count + i), w1 = w * u1, w2 = w * u2;
    const Real8 terms[6] = {w, w1, w2, w1 * u1, w1 * u2, w2 * u2};
    for (int m = 0; m < 6; ++m) matrix[m] = matrix[m] + terms[m];
    for (int c = 0; c < 3; ++c) {
      const Real8 light = k * Real8::LoadUnaligned(records.light[c] + i);
      right[c] = right[c] + light;
      right[3 + c] = right[3 + c] + light * u1;
      right[6 + c] = right[6 + c] + light * u2;
    }
  }
  constexpr std::size_t kPlaces[6] = {0, 1, 2, 5, 6, 9};
  for (std::size_t m = 0; m < 6; ++m) moments->matrix[kPlaces[m]] = SumOf(matrix[m]);
  for (std::size_t m = 0; m < 9; ++m) moments->right[m / 3][m % 3] = SumOf(right[m]);
}

// Adds the moments of tilt.
void AddTiltMoments(const FitNeighbours& from, Real radius, const Records8& records,
                    FitMoments* moments) {
  using N = FitNeighbours;
  const FitKernel kernel(radius);
  Real8 matrix[9], right[6];
  for (Real8& sum : matrix) sum = Real8::All(0);
  for (Real8& sum : right) sum = Real8::All(0);
  for (std::size_t t = 0; t < from.tiltedRuns; ++t) {
    const std::size_t at = from.tilted[t] * N::kRun, i = from.first[from.tilted[t]];
    const Real8 k = kernel.At(Real8::LoadUnaligned(from.At(N::Distance2) + at));
    if (HasNone(IsLess(Real8::All(0), k))) continue;
    const Real8 u3 = Real8::LoadUnaligned(from.At(N::U3) + t * N::kRun),
                u4 = Real8::LoadUnaligned(from.At(N::U4) + t * N::kRun);
    const Real8 w = k * Real8::LoadUnaligned(records.count + i);
    const Real8 w1 = w * Real8::LoadUnaligned(from.At(N::U1) + at),
                w2 = w * Real8::LoadUnaligned(from.At(N::U2) + at), w3 = w * u3, w4 = w * u4;
    const Real8 terms[9] = {w3, w4, w1 * u3, w1 * u4, w2 * u3, w2 * u4, w3 * u3, w3 * u4, w4 * u4};
    for (int m = 0; m < 9; ++m) matrix[m] = matrix[m] + terms[m];
    for (int c = 0; c < 3; ++c) {
      const Real8 light = k * Real8::LoadUnaligned(records.light[c] + i);
      right[c] = right[c] + light * u3;
      right[3 + c] = right[3 + c] + light * u4;
    }
  }
  constexpr std::size_t kPlaces[9] = {3, 4, 7, 8, 10, 11, 12, 13, 14};
  for (std::size_t m = 0; m < 9; ++m) moments->matrix[kPlaces[m]] = SumOf(matrix[m]);
  for (std::size_t m = 0; m < 6; ++m) moments->right[3 + m / 3][m % 3] = SumOf(right[m]);
}

void Accumulate(const FitNeighbours& from, Real radius, FragmentRows::Column set,
                FitMoments* moments) {
  const Records8 records(*from.rows, set);
  AddFilmMoments(from, radius, records, moments);
  if (from.tiltedRuns > 0) AddTiltMoments(from, radius, records, moments);
}

}  // namespace

extern const LocalFitLoops kLocalFitLoops;
const LocalFitLoops kLocalFitLoops{Describe, Locate, Accumulate};

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
