// SPDX-License-Identifier: BSD-2-Clause
// These tests compare boxes, vectors, colours and octahedral codes with independent computations.
#include <gtest/gtest.h>

#include "core/geometry/vec3d.h"
#include "core/math/bounds.h"
#include "core/math/octahedral.h"
#include "core/math/spectrum.h"
#include "tests/support/geometry_scenes.h"

namespace exphoton {
namespace {

void ExpectNearVector(const Vec3& a, const Vec3d& b, const char* what) {
  EXPECT_LT(Length(Vec3d(a) - b), 2e-6 * (1 + Length(b))) << what;
}

TEST(Bounds, MeasureThemselves) {
  Bounds3 box(Point3(1, 7, -2), Point3(4, 5, 3));
  EXPECT_EQ(box.min, Point3(1, 5, -2));
  EXPECT_EQ(box.max, Point3(4, 7, 3));
  EXPECT_EQ(box.Diagonal(), Vector3(3, 2, 5));
  EXPECT_EQ(box.LongestAxis(), 2);
  EXPECT_EQ(Bounds3({}, {1, 3, 2}).LongestAxis(), 1);
  EXPECT_EQ(Bounds3({}, {4, 3, 2}).LongestAxis(), 0);
  EXPECT_EQ(Bounds3({}, {3, 3, 3}).LongestAxis(), 0);
  EXPECT_EQ(Bounds3({}, {1, 3, 3}).LongestAxis(), 1);
  EXPECT_EQ(Bounds3({}, {3, 1, 3}).LongestAxis(), 0);
  EXPECT_EQ(box.Center(), Point3(Real(2.5), 6, Real(.5)));
  EXPECT_EQ(box.SurfaceArea(), 2 * (6 + 10 + 15));
  EXPECT_EQ(Bounds3().SurfaceArea(), 0);
  EXPECT_TRUE(Bounds3().IsEmpty());
  EXPECT_FALSE(Bounds3(Point3(1, 1, 1)).IsEmpty());
  EXPECT_EQ(BoundingSphere(box).center, box.Center());
  EXPECT_NEAR(double(BoundingSphere(box).radius), std::sqrt(9 + 4 + 25.) / 2, 1e-6);
  EXPECT_EQ(BoundingSphere({}).radius, 0);
  for (int i = 0; i < 8; ++i)
    EXPECT_EQ(box.Corner(i), Point3(i & 1 ? 4 : 1, i & 2 ? 7 : 5, i & 4 ? 3 : -2));
  for (int axis = 0; axis < 3; ++axis) {
    Point3 p = box.Center();
    p[axis] = box.min[axis];
    EXPECT_TRUE(box.Contains(p));
    p[axis] = NextDown(p[axis]);
    EXPECT_FALSE(box.Contains(p));
    p[axis] = box.max[axis];
    EXPECT_TRUE(box.Contains(p));
    p[axis] = NextUp(p[axis]);
    EXPECT_FALSE(box.Contains(p));
  }
  box.Extend(Point3(0, 6, 9));
  box.Extend(Bounds3({2, 2, 2}, {8, 3, 3}));
  EXPECT_EQ(box.min, Point3(0, 2, -2));
  EXPECT_EQ(box.max, Point3(8, 7, 9));
}

// Against the slabs in double precision.
TEST(Bounds, AreMetByTheRaysThatCrossThem) {
  RandomStream random(8);
  int hits = 0;
  for (int k = 0; k < 5000; ++k) {
    const Bounds3 box(RandomVector(random), RandomVector(random));
    const Point3 o = RandomVector(random) * 2;
    Vector3 d = box.Center() - o + RandomVector(random) * Real(.7);
    if (k % 4 == 0) d[k % 3] = k % 8 ? Real(0) : -Real(0);
    const Real tMax = k % 3 ? Real(2) : kInfinity;
    double low = 0, high = double(tMax);
    for (int axis = 0; axis < 3; ++axis) {
      const double at = double(o[axis]), along = double(d[axis]);
      if (along == 0) {
        if (at < double(box.min[axis]) || at > double(box.max[axis])) high = -1;
        continue;
      }
      const double a = (double(box.min[axis]) - at) / along;
      const double b = (double(box.max[axis]) - at) / along;
      low = std::max(low, std::min(a, b)), high = std::min(high, std::max(a, b));
    }
    const auto found = IntersectBox(box, o, d, tMax);
    if (std::abs(high - low) < 1e-5) continue;  // rounding decides
    ASSERT_EQ(found.has_value(), low < high) << k;
    if (!found) continue;
    ++hits;
    EXPECT_NEAR(double(found->min), low, 1e-5 * (1 + low));
    EXPECT_NEAR(double(found->max), high, 1e-5 * (1 + high));
    EXPECT_GE(double(found->max), high * (1 - 1e-7));
  }
  EXPECT_GT(hits, 500);
  EXPECT_FALSE(IntersectBox({{0, 0, 0}, {1, 1, 1}}, {NAN, 0, 0}, {1, 0, 0}, kInfinity));
  EXPECT_FALSE(IntersectBox({{0, 0, 0}, {1, 1, 1}}, {0, 0, 0}, {NAN, 1, 0}, kInfinity));
}

TEST(Vectors, HaveTheUsualProducts) {
  const Vec3 a(1, -2, 3), b(4, 5, -6);
  EXPECT_EQ(Dot(a, b), -24);
  EXPECT_EQ(AbsDot(a, b), 24);
  EXPECT_EQ(Cross(a, b), Vec3(-3, 18, 13));
  EXPECT_EQ(LengthSquared(a), 14);
  EXPECT_EQ(DistanceSquared(a, b), 9 + 49 + 81);
  EXPECT_EQ(Abs(a), Vec3(1, 2, 3));
  EXPECT_EQ(Min(a, b), Vec3(1, -2, -6));
  EXPECT_EQ(Max(a, b), Vec3(4, 5, 3));
  EXPECT_EQ(MaxComponent(b), 5);
  EXPECT_EQ(MaxDimension(a), 2);
  EXPECT_EQ(MaxDimension(b), 1);
  EXPECT_EQ(MaxDimension(Vec3(3, 1, 2)), 0);
  EXPECT_EQ(a / 2, Vec3(Real(.5), -1, Real(1.5)));
  EXPECT_EQ(FaceForward(a, b), Vec3(-1, 2, -3));
  EXPECT_EQ(FaceForward(a, -b), a);
  RandomStream random(9);
  for (int k = 0; k < 50; ++k) {
    const Vector3 z = NormalizeOr(RandomVector(random), {0, 0, 1});
    const Frame frame = Frame::FromZ(z);
    EXPECT_EQ(frame.z, z);
    EXPECT_LT(Distance(Cross(frame.x, frame.y), z), Real(1e-6));
    EXPECT_NEAR(double(Length(frame.x)), 1, 1e-6);
    const Vector3 v = RandomVector(random);
    EXPECT_LT(Distance(frame.ToWorld(frame.ToLocal(v)), v), Real(1e-6));
    EXPECT_NEAR(double(frame.ToLocal(v).y), double(Dot(v, frame.y)), 1e-6);
  }
}

TEST(Vectors, AreNormalisedAtAnyLength) {
  RandomStream random(10);
  for (const int exponent : {-140, -100, -60, 0, 60, 100, 120}) {
    const Vector3 v = RandomVector(random);
    const Vector3 extreme(std::ldexp(v.x, exponent), std::ldexp(v.y, exponent),
                          std::ldexp(v.z, exponent));
    ExpectNearVector(NormalizeOr(extreme, {}), NormalizeOrZero(Vec3d(extreme)), "unit");
    ExpectNearVector(NormalizeExtremeOr(extreme, {}), NormalizeOrZero(Vec3d(extreme)), "unit");
  }
  EXPECT_EQ(NormalizeOr({}, {1, 2, 3}), Vec3(1, 2, 3));
  EXPECT_EQ(NormalizeOr({kInfinity, 0, 0}, {1, 2, 3}), Vec3(1, 2, 3));
  EXPECT_EQ(NormalizeOr({0, NAN, 0}, {1, 2, 3}), Vec3(1, 2, 3));
}

TEST(OctahedralCode, IsWithinItsErrorOfTheDirection) {
  RandomStream random(11);
  for (int k = 0; k < 3000; ++k) {
    const Vec3d v = NormalizeOrZero(Vec3d(RandomVector(random)));
    const std::uint8_t note = std::uint8_t(k);
    const std::uint32_t code = EncodeOctahedral(v.ToReal(), note);
    const auto angleTo = [&](std::uint32_t bits) {
      return Length(Cross(Vec3d(DecodeOctahedral(bits)), v)) +
             (Dot(Vec3d(DecodeOctahedral(bits)), v) < 0 ? 9 : 0);
    };
    EXPECT_LT(angleTo(EncodeOctahedral(v.ToReal())), 7e-5);
    EXPECT_LT(angleTo(code), 1.2e-3);
    EXPECT_EQ(OctahedralPayload(code), note);
  }
  for (int axis = 0; axis < 6; ++axis) {
    Vector3 v;
    v[axis % 3] = axis < 3 ? 1 : -1;
    EXPECT_EQ(DecodeOctahedral(EncodeOctahedral(v)), v);
  }
}

TEST(SpectrumTest, HasItsOperationsByChannel) {
  const Spectrum a(1, 2, 4), b(Real(.5), 3, -1);
  EXPECT_EQ(a + b, Spectrum(Real(1.5), 5, 3));
  EXPECT_EQ(a - b, Spectrum(Real(.5), -1, 5));
  EXPECT_EQ(a * b, Spectrum(Real(.5), 6, -4));
  EXPECT_EQ(a / 2, Spectrum(Real(.5), 1, 2));
  EXPECT_EQ(a.MaxComponent(), 4);
  EXPECT_EQ(b.MinComponent(), -1);
  EXPECT_NEAR(double(a.Y()), .212671 + 2 * .715160 + 4 * .072169, 1e-6);
  EXPECT_EQ(Clamp(Spectrum(-1, Real(.5), 3), 0, 1), Spectrum(0, Real(.5), 1));
  EXPECT_EQ(Lerp(Real(.25), a, Spectrum(5, 6, 0)), Spectrum(2, 3, 3));
  EXPECT_EQ(Sqrt(Spectrum(4, -1, 9)), Spectrum(2, 0, 3));
  EXPECT_NEAR(double(Exp(a).g), std::exp(2.), 1e-5);
  EXPECT_TRUE(Spectrum().IsBlack());
  for (int c = 0; c < 3; ++c) {
    Spectrum s;
    s[c] = Real(1e-30);
    EXPECT_FALSE(s.IsBlack());
    s[c] = kInfinity;
    EXPECT_FALSE(s.IsFinite());
  }
}

TEST(Real, HasItsHelpers) {
  EXPECT_EQ(Lerp(Real(.25), Real(2), Real(6)), 3);
  EXPECT_NEAR(double(Radians(90)), M_PI / 2, 1e-6);
  EXPECT_NEAR(double(Degrees(kPi)), 180, 1e-4);
  EXPECT_EQ(SafeSqrt(-1), 0);
  EXPECT_EQ(SafeAcos(2), 0);
  EXPECT_NEAR(double(SafeAsin(-2)), -M_PI / 2, 1e-6);
  EXPECT_EQ(SafeDivide(6, 3, 9), 2);
  EXPECT_EQ(SafeDivide(6, 0, 9), 9);
  EXPECT_EQ(SafeDivide(kInfinity, 1, 9), 9);
  EXPECT_EQ(NextUp(1), std::nextafter(Real(1), kInfinity));
  EXPECT_EQ(NextUp(-1), std::nextafter(Real(-1), kInfinity));
  EXPECT_EQ(NextDown(1), std::nextafter(Real(1), -kInfinity));
  EXPECT_EQ(NextUp(kInfinity), kInfinity);
  EXPECT_EQ(NextUp(-Real(0)), std::numeric_limits<Real>::denorm_min());
  EXPECT_NEAR(double(Gamma(5) / kMachineEpsilon), 5, 1e-5);
  EXPECT_NEAR(double(kPi * kInvPi), 1, 1e-7);
  EXPECT_NEAR(double(kPi * kInv2Pi), .5, 1e-7);
  EXPECT_NEAR(double(kPi * kInv4Pi), .25, 1e-7);
}

}  // namespace
}  // namespace exphoton
