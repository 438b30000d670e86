// SPDX-License-Identifier: BSD-2-Clause
// Eight Reals, three axes, and the order in which the eight children of a node are visited. This
// file is part of traverse_simd.cpp.

using Real8 = Reals<kBvhWidth>;
using Ids8 = Registers<std::uint32_t, kBvhWidth>;

// Returns the mask of the triangles of a block that exist.
HWY_INLINE unsigned PresentMask(const std::uint32_t* ids) {
  const Ids8::Tag tag;
  unsigned mask = 0;
  for (int i = 0; i < Ids8::kRegisters; ++i)
    mask |= BitsOf(tag, hn::Ne(hn::Load(tag, ids + i * Ids8::kLanes), hn::Set(tag, kNoId)))
            << (i * Ids8::kLanes);
  return mask;
}

// Eight Reals are one register of AVX2 and AVX-512, which one instruction permutes.
#if (HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_AVX3) && !defined(EXPHOTON_DOUBLE)

using Integers8 = hn::RebindToSigned<Real8::Tag>;

// Tests IsTraceable for the origin and the direction in one register.
HWY_INLINE bool IsWorthTracing(const Ray& ray) {
  static_assert(offsetof(Ray, o) == 0 && offsetof(Ray, d) == 12 && sizeof(Ray) >= 32);
  const Integers8 integers;  // the bits are ordered like the floats, NaN last
  const auto components = hn::LoadU(Real8::Tag(), reinterpret_cast<const Real*>(&ray));
  const auto bits = hn::BitCast(integers, hn::Abs(components));
  const auto infinity = hn::BitCast(integers, hn::Set(Real8::Tag(), kInfinity));
  const unsigned finite = BitsOf(integers, hn::Gt(infinity, bits));
  const unsigned notZero = BitsOf(integers, hn::Gt(bits, hn::Zero(integers)));
  return (finite & 0x3f) == 0x3f && (notZero & 0x38) != 0 && ray.tMax > 0;
}

// Lanes 0 to 2 are the axes. The other lanes hold 1, so division by them is safe.
using Axes = Real8;
HWY_INLINE Real8 AllOf(const Axes& a, int axis) {
  Real8 r;
  r.part[0] =
      hn::TableLookupLanes(a.part[0], hn::IndicesFromVec(Real8::Tag(), hn::Set(Integers8(), axis)));
  return r;
}

// PushOrder reads an order from its end to its beginning, so that the nearest child comes last, on
// top of the stack. For the opposite direction it reads from the beginning to the end.
class PushOrder {
 public:
  explicit PushOrder(bool isOpposite)
      : flip_(isOpposite ? 0 : 28),
        shifts_(hn::Xor(hn::Load(ids_, kShifts), hn::Set(ids_, flip_))) {}

  // Finds the children with first <= last and returns their number. Returns the first of the order
  // in *next and pushes the others, the second on top. It writes eight values.
  HWY_INLINE std::size_t Push(const BvhNode& node, std::size_t orderIndex, const Real8& first,
                              const Real8& last, BvhChild* children, Real* enters,
                              BvhChild* next) const {
    const Real8::Tag reals;
    const BvhOrder order = node.orders[orderIndex];
    // The lane at each place is in the three low bits. Permutations ignore the other bits.
    const auto lanes = hn::Shr(hn::Set(ids_, order), shifts_);
    const auto permutation = hn::IndicesFromVec(reals, lanes);
    const auto firsts = hn::TableLookupLanes(first.part[0], permutation);
    const auto lasts = hn::TableLookupLanes(last.part[0], permutation);
    const auto met = hn::Le(firsts, lasts);
    const unsigned bits = BitsOf(reals, met);
    if (bits == 0) return 0;
    const unsigned lastPlace = 4 * unsigned(std::bit_width(bits)) - 4;
    *next = node.children[order >> (lastPlace ^ flip_) & 7];
    const auto all =
        hn::TableLookupLanes(hn::Load(ids_, reinterpret_cast<const std::uint32_t*>(node.children)),
                             hn::IndicesFromVec(ids_, lanes));
    hn::StoreU(Compressed(ids_, all, hn::RebindMask(ids_, met), bits), ids_,
               reinterpret_cast<std::uint32_t*>(children));
    hn::StoreU(Compressed(reals, firsts, met, bits), reals, enters);
    return std::size_t(std::popcount(bits));
  }

 private:
  alignas(32) static constexpr std::uint32_t kShifts[8] = {0, 4, 8, 12, 16, 20, 24, 28};
  static constexpr Ids8::Tag ids_{};
  unsigned flip_;
  hn::Vec<Ids8::Tag> shifts_;
};

#else

HWY_INLINE bool IsWorthTracing(const Ray& ray) { return IsTraceable(ray); }

using Axes = Reals<4>;
HWY_INLINE Real8 AllOf(const Axes& a, int axis) {
  Real lanes[4];
  a.StoreUnaligned(lanes);
  return Real8::All(lanes[axis]);
}

class PushOrder {
 public:
  explicit PushOrder(bool isOpposite) : flip_(isOpposite ? 0 : 28) {}

  HWY_INLINE std::size_t Push(const BvhNode& node, std::size_t orderIndex, const Real8& first,
                              const Real8& last, BvhChild* children, Real* enters,
                              BvhChild* next) const {
    const BvhOrder order = node.orders[orderIndex];
    Real firsts[kBvhWidth], lasts[kBvhWidth];
    first.StoreUnaligned(firsts), last.StoreUnaligned(lasts);
    std::size_t count = 0;
    for (unsigned i = 0; i < unsigned(kBvhWidth); ++i) {
      const unsigned lane = order >> (4 * i ^ flip_) & 7;
      children[count] = node.children[lane];
      enters[count] = firsts[lane];
      count += firsts[lane] <= lasts[lane];
    }
    if (count > 0) *next = children[count - 1];
    return count;
  }

 private:
  unsigned flip_;
};

#endif

// Assembles the vector in registers, because a vector load stalls on the narrower stores before it.
HWY_INLINE Axes AxesOf(const Vec3& a) {
  const Axes::Tag tag;
  const auto set = [&](Real x) HWY_ATTR { return hn::Set(tag, x); };
  Axes r;
  r.part[0] = set(1);
  for (int i = 1; i < Axes::kRegisters; ++i) r.part[i] = set(1);
  const Real components[3] = {a.x, a.y, a.z};
  for (int axis = 2; axis >= 0; --axis) {
    auto& part = r.part[axis / Axes::kLanes];
    part = hn::IfThenElse(MaskOf(tag, 1u << axis % Axes::kLanes), set(components[axis]), part);
  }
  return r;
}
