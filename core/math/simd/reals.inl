// SPDX-License-Identifier: BSD-2-Clause
// Reals<n> holds n Reals in as many registers of the SIMD target as they need: Real16 is one
// register of AVX-512, two of AVX2, four of NEON. A kernel file includes this file once per target,
// after hwy/foreach_target.h and outside of namespaces. Lanes are rounded like scalars, and no
// operation is fused unless it is called MultiplyAdd, so all targets give the same bits.
//
// Masks have one bit per lane, the lowest bit for the first lane.
#include <hwy/highway.h>

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <limits>

#include "core/math/vec.h"

HWY_BEFORE_NAMESPACE();
namespace exphoton::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

constexpr const char* kTargetName = HWY_TARGET == HWY_SSE4   ? "SSE4"
                                    : HWY_TARGET == HWY_AVX2 ? "AVX2"
                                    : HWY_TARGET == HWY_AVX3 ? "AVX-512"
                                    : HWY_TARGET == HWY_NEON ? "NEON"
                                                             : "portable";

// Registers<T, n> holds n values of type T.
template <class T, int kCount>
struct Registers {
  using Tag = hn::CappedTag<T, kCount>;
  using Register = hn::Vec<Tag>;
  static constexpr int kLanes = int(hn::MaxLanes(Tag()));  // of one register
  static constexpr int kRegisters = kCount / kLanes;

  Register part[kRegisters];

  // Returns the bits of a mask that belong to register i.
  static constexpr unsigned BitsOfRegister(unsigned mask, int i) {
    return kRegisters == 1 ? mask : mask >> (i * kLanes) & ((1u << kLanes) - 1);
  }
};

template <int kCount>
struct Reals : Registers<Real, kCount> {
  using Base = Registers<Real, kCount>;
  using typename Base::Tag;

  // The address is a multiple of the size of a register.
  static HWY_INLINE Reals Load(const Real* row) {
    Reals r;
    for (int i = 0; i < Base::kRegisters; ++i) r.part[i] = hn::Load(Tag(), row + i * Base::kLanes);
    return r;
  }
  static HWY_INLINE Reals LoadUnaligned(const Real* row) {
    Reals r;
    for (int i = 0; i < Base::kRegisters; ++i) r.part[i] = hn::LoadU(Tag(), row + i * Base::kLanes);
    return r;
  }
  static HWY_INLINE Reals All(Real x) {
    Reals r;
    for (int i = 0; i < Base::kRegisters; ++i) r.part[i] = hn::Set(Tag(), x);
    return r;
  }
  HWY_INLINE void StoreUnaligned(Real* row) const {
    for (int i = 0; i < Base::kRegisters; ++i)
      hn::StoreU(this->part[i], Tag(), row + i * Base::kLanes);
  }
};
using Real16 = Reals<16>;

// Minimum and maximum are the second operand if one operand is NaN.
template <class V>
HWY_INLINE V MinOrSecond(V a, V b) {
#if HWY_TARGET == HWY_SSE4 || HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_AVX3
  return hn::Min(a, b);
#else
  return hn::IfThenElse(hn::Lt(a, b), a, b);
#endif
}
template <class V>
HWY_INLINE V MaxOrSecond(V a, V b) {
#if HWY_TARGET == HWY_SSE4 || HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_AVX3
  return hn::Max(a, b);
#else
  return hn::IfThenElse(hn::Lt(b, a), a, b);
#endif
}

#define EXPHOTON_LANEWISE(name, operation)                                              \
  template <int kCount>                                                                 \
  HWY_INLINE Reals<kCount> name(const Reals<kCount>& a, const Reals<kCount>& b) {       \
    Reals<kCount> r;                                                                    \
    for (int i = 0; i < r.kRegisters; ++i) r.part[i] = operation(a.part[i], b.part[i]); \
    return r;                                                                           \
  }
EXPHOTON_LANEWISE(operator+, hn::Add)
EXPHOTON_LANEWISE(operator-, hn::Sub)
EXPHOTON_LANEWISE(operator*, hn::Mul)
EXPHOTON_LANEWISE(operator/, hn::Div)
EXPHOTON_LANEWISE(Min, MinOrSecond)
EXPHOTON_LANEWISE(Max, MaxOrSecond)
EXPHOTON_LANEWISE(CopySign, hn::CopySignToAbs)  // a must not be negative
#undef EXPHOTON_LANEWISE

template <int kCount>
HWY_INLINE Reals<kCount> Abs(const Reals<kCount>& a) {
  Reals<kCount> r;
  for (int i = 0; i < r.kRegisters; ++i) r.part[i] = hn::Abs(a.part[i]);
  return r;
}
// Returns a * b + c. Targets with fused operations round once.
template <int kCount>
HWY_INLINE Reals<kCount> MultiplyAdd(const Reals<kCount>& a, const Reals<kCount>& b,
                                     const Reals<kCount>& c) {
  Reals<kCount> r;
  for (int i = 0; i < r.kRegisters; ++i) r.part[i] = hn::MulAdd(a.part[i], b.part[i], c.part[i]);
  return r;
}

// BitsOf and MaskOf convert between masks of one register and bits.
template <class Tag>
HWY_INLINE unsigned BitsOf(Tag tag, hn::Mask<Tag> mask) {
#if HWY_TARGET == HWY_AVX2
  // Highway would narrow the bits to a byte, which makes searches up to a tenth slower.
  if constexpr (hn::MaxLanes(Tag()) == 8) {
    const hn::RebindToFloat<Tag> floats;
    return unsigned(_mm256_movemask_ps(hn::BitCast(floats, hn::VecFromMask(tag, mask)).raw));
  }
#endif
  std::uint8_t bytes[8];
  hn::StoreMaskBits(tag, mask, bytes);
  if constexpr (hn::MaxLanes(Tag()) <= 8) return bytes[0];
  std::uint16_t bits;
  std::memcpy(&bits, bytes, sizeof(bits));
  return bits;
}
template <class Tag>
HWY_INLINE hn::Mask<Tag> MaskOf(Tag tag, unsigned bits) {
  const std::uint8_t bytes[8] = {std::uint8_t(bits), std::uint8_t(bits >> 8)};
  return hn::LoadMaskBits(tag, bytes);
}

#define EXPHOTON_COMPARE(name, comparison)                                            \
  template <int kCount>                                                               \
  HWY_INLINE unsigned name(const Reals<kCount>& a, const Reals<kCount>& b) {          \
    unsigned mask = 0;                                                                \
    for (int i = 0; i < a.kRegisters; ++i)                                            \
      mask |= BitsOf(typename Reals<kCount>::Tag(), comparison(a.part[i], b.part[i])) \
              << (i * a.kLanes);                                                      \
    return mask;                                                                      \
  }
EXPHOTON_COMPARE(LessEqualMask, hn::Le)
EXPHOTON_COMPARE(LessMask, hn::Lt)
EXPHOTON_COMPARE(EqualMask, hn::Eq)
#undef EXPHOTON_COMPARE

HWY_INLINE std::size_t CountLessEqual(const Real16& a, const Real16& b) {
  return unsigned(__builtin_popcount(LessEqualMask(a, b)));
}
// Returns a where a <= b, 0 elsewhere.
HWY_INLINE Real16 IfLessEqual(const Real16& a, const Real16& b) {
  Real16 r;
  for (int i = 0; i < r.kRegisters; ++i)
    r.part[i] = hn::IfThenElseZero(hn::Le(a.part[i], b.part[i]), a.part[i]);
  return r;
}

// Returns first, first + 1 ... Highway's Iota is slow unless first is a constant.
template <class T>
alignas(64) constexpr T kLaneNumbers[16] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
template <class Tag>
HWY_INLINE hn::Vec<Tag> NumbersFrom(Tag tag, hn::TFromD<Tag> first) {
  return hn::Add(hn::Load(tag, kLaneNumbers<hn::TFromD<Tag>>), hn::Set(tag, first));
}

HWY_INLINE hn::Vec<Real16::Tag> ToReals(hn::Vec<hn::Rebind<std::int32_t, Real16::Tag>> v) {
#if defined(EXPHOTON_DOUBLE)
  return hn::PromoteTo(Real16::Tag(), v);
#else
  return hn::ConvertTo(Real16::Tag(), v);
#endif
}
// Converts the lower or the upper half of each word, both signed.
template <bool kIsUpper>
HWY_INLINE Real16 LoadHalves(const std::uint32_t* words) {
  const hn::Rebind<std::int32_t, Real16::Tag> tag;
  Real16 r;
  for (int i = 0; i < Real16::kRegisters; ++i) {
    const auto word =
        hn::Load(tag, reinterpret_cast<const std::int32_t*>(words + i * Real16::kLanes));
    r.part[i] = ToReals(hn::ShiftRight<16>(kIsUpper ? word : hn::ShiftLeft<16>(word)));
  }
  return r;
}

// Keys are the bits of values as signed integers. They have the same order as the values if no
// value is negative.
using Keys = hn::RebindToSigned<Real16::Tag>;
using Key = hn::TFromD<Keys>;

// Returns the smallest of key(i), a register of keys, among the lanes of the mask.
template <class KeyOf>
HWY_INLINE Key LeastKey(unsigned mask, const KeyOf& keyOf) {
  const auto masked = [&](int i) HWY_ATTR {
    const unsigned bits = Real16::BitsOfRegister(mask, i);
    return hn::IfThenElse(MaskOf(Keys(), bits), keyOf(i),
                          hn::Set(Keys(), std::numeric_limits<Key>::max()));
  };
  auto least = masked(0);
  for (int i = 1; i < Real16::kRegisters; ++i) least = hn::Min(least, masked(i));
  return hn::GetLane(hn::MinOfLanes(Keys(), least));
}
// Returns the lane with the smallest value among the lanes of the mask, which must not be 0. The
// last four bits of each value are replaced by its lane number and do not count. Values must not be
// negative.
HWY_INLINE unsigned NearestLane(const Real16& values, unsigned mask) {
  return unsigned(LeastKey(mask,
                           [&](int i) HWY_ATTR {
                             return hn::Or(hn::AndNot(hn::Set(Keys(), 15),
                                                      hn::BitCast(Keys(), values.part[i])),
                                           NumbersFrom(Keys(), Key(i * Real16::kLanes)));
                           })) &
         15;
}
// Returns the smallest value among the lanes of the mask. Values must not be negative. The result
// is unspecified if the mask is 0.
HWY_INLINE Real LeastOf(const Real16& values, unsigned mask) {
  return std::bit_cast<Real>(
      LeastKey(mask, [&](int i) HWY_ATTR { return hn::BitCast(Keys(), values.part[i]); }));
}
// Returns the largest value. Values must not be NaN.
HWY_INLINE Real LargestOf(const Real16& values) {
  auto largest = values.part[0];
  for (int i = 1; i < Real16::kRegisters; ++i) largest = MaxOrSecond(largest, values.part[i]);
  return hn::GetLane(hn::MaxOfLanes(Real16::Tag(), largest));
}

// For each 8-bit mask, this table lists the lanes of the mask in order.
constexpr auto kCompressedOrder = [] {
  std::array<std::array<std::uint8_t, 8>, 256> table{};
  for (unsigned mask = 0; mask < 256; ++mask)
    for (std::uint8_t lane = 0, at = 0; lane < 8; ++lane)
      if (mask >> lane & 1) table[mask][at++] = lane;
  return table;
}();

// Moves the lanes of the mask to the front. `bits` are the bits of the mask. Highway's own function
// copies its table to the stack in each call if a register has eight lanes and the target cannot
// compress (AVX2).
template <class Tag>
HWY_INLINE hn::Vec<Tag> Compressed(Tag tag, hn::Vec<Tag> v, hn::Mask<Tag> mask,
                                   [[maybe_unused]] unsigned bits) {
  if constexpr (HWY_TARGET == HWY_AVX2 && hn::MaxLanes(Tag()) == 8) {
    const hn::Rebind<std::uint8_t, Tag> bytes;
    const hn::RebindToSigned<Tag> lanes;
    const auto order = hn::PromoteTo(lanes, hn::Load(bytes, kCompressedOrder[bits].data()));
    return hn::TableLookupLanes(v, hn::IndicesFromVec(tag, order));
  } else {
    return hn::Compress(v, mask);
  }
}

// Writes the lanes of the mask contiguously and returns their number. load(i) is register i. It may
// write all lanes.
template <class T, int kCount, class Load>
HWY_INLINE std::size_t StoreCompressed(unsigned mask, const Load& load, T* to) {
  using Type = Registers<T, kCount>;
  std::size_t count = 0;
  for (int i = 0; i < Type::kRegisters; ++i) {
    const unsigned bits = Type::BitsOfRegister(mask, i);
    // Registers are stored whole, because compressing stores are slow on some machines.
    const typename Type::Tag tag;
    hn::StoreU(Compressed(tag, load(i), MaskOf(tag, bits), bits), tag, to + count);
    count += unsigned(__builtin_popcount(bits));
  }
  return count;
}
HWY_INLINE std::size_t StoreLanes(const Real16& values, unsigned mask, Real* to) {
  return StoreCompressed<Real, 16>(
      mask, [&](int i) HWY_ATTR { return values.part[i]; }, to);
}
// Writes the lanes of the mask and their indices contiguously, and returns their number. It may
// write sixteen values and indices.
HWY_INLINE std::size_t AppendLanes(const Real16& values, std::uint32_t firstIndex, unsigned mask,
                                   Real* to, std::uint32_t* index) {
  using Indices = Registers<std::uint32_t, 16>;
  StoreCompressed<std::uint32_t, 16>(
      mask,
      [&](int i) HWY_ATTR {
        return NumbersFrom(Indices::Tag(), firstIndex + std::uint32_t(i * Indices::kLanes));
      },
      index);
  return StoreLanes(values, mask, to);
}
// Does the same with the indices in `from`.
HWY_INLINE std::size_t KeepLanes(const Real16& values, unsigned mask, const std::uint32_t* from,
                                 Real* to, std::uint32_t* index) {
  using Indices = Registers<std::uint32_t, 16>;
  Indices indices;  // read before the writes, which may overlap
  for (int i = 0; i < Indices::kRegisters; ++i)
    indices.part[i] = hn::LoadU(Indices::Tag(), from + i * Indices::kLanes);
  StoreCompressed<std::uint32_t, 16>(
      mask, [&](int i) HWY_ATTR { return indices.part[i]; }, index);
  return StoreLanes(values, mask, to);
}

}  // namespace
}  // namespace exphoton::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
