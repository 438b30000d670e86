// SPDX-License-Identifier: BSD-2-Clause
// Bump mapping: slopes tilt the normal as geometry would, and nothing awkward breaks it.
#include "core/scattering/bump.h"

#include <functional>

#include "gtest/gtest.h"
#include "tests/support/scattering.h"

namespace exphoton {
namespace {

class Height final : public Texture<Real> {
 public:
  explicit Height(std::function<Real(const SurfaceInteraction&)> height)
      : height_(std::move(height)) {}
  Real Evaluate(const SurfaceInteraction& si) const override { return height_(si); }

 private:
  std::function<Real(const SurfaceInteraction&)> height_;
};

// z = x / 2 has the normal (-1/2, 0, 1), normalised.
TEST(Bump, ASlopeTiltsTheNormal) {
  const Vector3 expected = Normalize(Vector3(Real(-.5), 0, 1));
  for (bool byPoint : {false, true}) {
    SurfaceInteraction si = FlatSurface();
    ApplyBump(Height([&](const auto& at) { return (byPoint ? at.p.x : at.uv.x) / 2; }), &si);
    EXPECT_LT(Distance(si.shading.n, expected), Real(1e-4));
    EXPECT_EQ(si.ng, Vector3(0, 0, 1));
  }
}

TEST(Bump, IsTheSameAtEveryScaleOfTheScene) {
  for (int k : {-20, 20}) {
    const Real scale = std::ldexp(Real(1), k);
    SurfaceInteraction a = FlatSurface(), b = FlatSurface();
    b.dpdu *= scale;
    b.dpdv *= scale;
    b.shading.dpdu *= scale;
    b.shading.dpdv *= scale;
    const auto wave = [](const SurfaceInteraction& at) { return std::sin(7 * at.uv.x + at.uv.y); };
    ApplyBump(Height(wave), &a);
    ApplyBump(Height([&](const auto& at) { return scale * wave(at); }), &b);
    EXPECT_EQ(a.shading.n, b.shading.n);
  }
}

TEST(Bump, StepsOverHalfTheFootprint) {
  SurfaceInteraction si = FlatSurface();
  si.hasDifferentials = true;
  si.dudx = Real(.2);
  si.dvdy = Real(-.4);
  std::vector<Point2> asked;
  ApplyBump(Height([&](const auto& at) {
              asked.push_back(at.uv);
              return Real(0);
            }),
            &si);
  ASSERT_EQ(asked.size(), 3u);
  EXPECT_NEAR(asked[1].x, .35, 1e-6);
  EXPECT_NEAR(asked[2].y, .95, 1e-6);
}

TEST(Bump, KeepsTheGeometricSide) {
  SurfaceInteraction si = FlatSurface();
  si.ng = {0, 0, -1};  // as with ReverseOrientation: tangents say the other side
  si.shading.n = si.ng;
  ApplyBump(Height([](const auto& at) { return at.uv.x / 2; }), &si);
  EXPECT_GT(Dot(si.shading.n, si.ng), 0);
  // Displaced towards -z: the point moves down as u grows.
  EXPECT_LT(Distance(si.shading.n, Normalize(Vector3(Real(-.5), 0, -1))), Real(1e-4));
}

TEST(Bump, OfValuesThatAreNoNumbersChangesNothing) {
  for (Real bad : {std::numeric_limits<Real>::quiet_NaN(), kInfinity}) {
    SurfaceInteraction si = FlatSurface();
    ApplyBump(Height([&](const auto&) { return bad; }), &si);
    EXPECT_EQ(si.shading.n, Vector3(0, 0, 1));
    EXPECT_EQ(si.shading.dpdu, Vector3(1, 0, 0));
  }
}

TEST(Bump, OfTheSteepestSlopeStaysUnit) {
  SurfaceInteraction si = FlatSurface();
  ApplyBump(Height([](const auto& at) { return Real(1e20) * at.uv.x; }), &si);
  EXPECT_TRUE(IsFinite(si.shading.n));
  EXPECT_NEAR(LengthSquared(si.shading.n), 1, 1e-5);
  EXPECT_GE(Dot(si.shading.n, si.ng), 0);
}

}  // namespace
}  // namespace exphoton
