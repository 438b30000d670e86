// SPDX-License-Identifier: BSD-2-Clause
// BlockRay is a ray in the form that tests blocks of triangles in single precision. This file is
// part of traverse.inl. It does the same operations in the same order as HitInSingle
// (triangle_single.h), so it accepts the same hits and returns the same values.

// BlockHits is the result for a block, with one bit per triangle in each mask. Possible: the
// triangle may be hit. Crossed: the ray's line certainly crosses it, so the computed determinant
// has the right sign. Sure: it is certainly hit, and the values are those of HitInSingle. e1 and e2
// are edge functions; divided by the determinant they are barycentric coordinates.
struct BlockHits {
  unsigned possible = 0, crossed = 0, sure = 0;
  Real8 t, e1, e2, determinant;
};

// BlockRay holds the shear of TriangleRay, eight wide.
struct BlockRay {
  Real8 ox, oy, oz, sx, sy, sz;
  int kx, ky, kz;
  unsigned sureLanes;  // all bits set, or none

  explicit BlockRay(const TriangleRay& ray)
      : ox(Real8::All(ray.ox)), oy(Real8::All(ray.oy)), oz(Real8::All(ray.oz)),
        sx(Real8::All(ray.sx)), sy(Real8::All(ray.sy)), sz(Real8::All(ray.sz)), kx(ray.kx),
        ky(ray.ky), kz(ray.kz), sureLanes(kHitsInSingle && MayHitInSingle(ray) ? ~0u : 0u) {}

  // Returns the triangles that may be hit at t in (0, tMax]. Left out are those that the ray's line
  // certainly misses, and those certainly beyond tMax or behind the origin.
  BlockHits Hits(const BvhBlock& block, Real tMax) const {
    Real8 x[3], y[3], z[3], e[3];
    for (int v = 0; v < 3; ++v) {
      z[v] = Real8::Load(block.vertices[v][kz]) - oz;
      x[v] = (Real8::Load(block.vertices[v][kx]) - ox) - sx * z[v];
      y[v] = (Real8::Load(block.vertices[v][ky]) - oy) - sy * z[v];
    }
    for (int v = 0; v < 3; ++v) {
      const int next = (v + 1) % 3, last = (v + 2) % 3;
      e[v] = x[last] * y[next] - y[last] * x[next];
    }
    const Real8 zero = Real8::All(Real(0));
    const Real8 least = Min(Min(e[0], e[1]), e[2]), most = Max(Max(e[0], e[1]), e[2]);
    BlockHits hits;
    // Edge functions have the right sign or are 0 (MissesTriangle): opposite signs prove a miss.
    hits.possible = PresentMask(block.ids) & ~(LessMask(least, zero) & LessMask(zero, most));
    if (hits.possible == 0) return hits;
    if (!kHitsInSingle) {  // t lies between the vertices' t
      const Real8 t[3] = {z[0] * sz, z[1] * sz, z[2] * sz};
      hits.possible &= ~(LessMask(Real8::All(Limit(tMax)), Min(Min(t[0], t[1]), t[2])) |
                         LessMask(Max(Max(t[0], t[1]), t[2]), zero));
      hits.t = hits.e1 = hits.e2 = hits.determinant = zero;
      return hits;
    }
    const Real8 X = LargestOf(x), Y = LargestOf(y), Z = LargestOf(z);
    const auto of = [](int i) { return Real8::All(LargeVolume::of[i]); };
    const Real8 area = X * Y;
    const Real8 bound =
        Z * (of(0) * area + Z * (of(1) * (X + Y) + of(2) * Z)) + Real8::All(LargeVolume::least);
    const Real8 volume = (e[0] * z[0] + e[1] * z[1]) + e[2] * z[2];
    hits.determinant = (e[0] + e[1]) + e[2];
    hits.t = volume / hits.determinant * sz;
    hits.e1 = e[1], hits.e2 = e[2];
    const Real8 size = Abs(hits.t);
    hits.crossed = hits.possible & LessMask(zero, least * most);
    const unsigned isSure = hits.crossed & sureLanes & LessMask(bound, Abs(volume)) &
                            LessMask(Real8::All(kLeastSingle), size) &
                            LessMask(size, Real8::All(kLargestSingle));
    const unsigned isBeyond = isSure & LessMask(Real8::All(tMax * kBeyond), hits.t);
    // HitInDouble finds the same sign of the volume. The error of the volume is less than
    // kVolumeError X Y Z plus the underflow of its products.
    // Underflow in the edges is negligible: least * most is not 0, so an edge exceeds 2^-75.
    const Real8 error = area * Z * Real8::All(kVolumeError) + Real8::All(Square(kLeastSingle));
    const unsigned isBehind = hits.crossed & LessMask(hits.t, zero) & LessMask(error, Abs(volume));
    hits.possible &= ~(isBeyond | isBehind);
    hits.sure = hits.possible & isSure;
    return hits;
  }

 private:
  static Real8 LargestOf(const Real8 (&a)[3]) { return Max(Max(Abs(a[0]), Abs(a[1])), Abs(a[2])); }
};
