// SPDX-License-Identifier: BSD-2-Clause
// These tests check bump mapping: slopes tilt the normal like real geometry, and unusual input
// does no harm.
#include "core/scattering/bump.h"

#include <array>
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

// The surface z = x / 2 has the normal (-1/2, 0, 1), normalised.
TEST(Bump, ASlopeTiltsTheNormal) {
  const Vector3 expected = Normalize(Vector3(Real(-.5), 0, 1));
  for (bool byPoint : {false, true}) {
    SurfaceInteraction si = FlatSurface();
    ApplyBump(Height([&](const auto& at) { return (byPoint ? at.p.x : at.uv.x) / 2; }), &si);
    EXPECT_LT(Distance(si.shading.n, expected), Real(1e-4));
    EXPECT_EQ(si.ng, Vector3(0, 0, 1));
  }
}

// The surface is z = x / 2 + y / 4, with footprints that are longer along one axis.
TEST(Bump, SlopesDoNotDependOnTheFootprint) {
  const Vector3 expected = Normalize(Vector3(Real(-.5), Real(-.25), 1));
  for (const auto& [dudx, dvdy] : {std::pair<Real, Real>{.01, .08}, {.08, .01}}) {
    SurfaceInteraction si = FlatSurface();
    si.hasDifferentials = true;
    si.dudx = dudx, si.dvdy = dvdy;
    ApplyBump(Height([](const auto& at) { return at.uv.x / 2 + at.uv.y / 4; }), &si);
    EXPECT_LT(Distance(si.shading.n, expected), Real(1e-4)) << dudx;
  }
}

// The slope of x^2 over a step s forwards is 2 x + s, for u, v and the point itself.
TEST(Bump, StepsForwardAlongBothAxes) {
  for (const bool byPoint : {true, false}) {
    for (const bool alongU : {true, false}) {
      SurfaceInteraction si = FlatSurface();
      si.p = {Real(.25), Real(.75), 0};
      ApplyBump(Height([&](const auto& at) {
                  const Point2 place = byPoint ? Point2(at.p.x, at.p.y) : at.uv;
                  const Real x = alongU ? place.x : place.y;
                  return x * x;
                }),
                &si);
      const Real slope = 2 * (alongU ? Real(.25) : Real(.75)) + Real(.01);
      const Vector3 expected = Normalize(alongU ? Vector3(-slope, 0, 1) : Vector3(0, -slope, 1));
      EXPECT_LT(Distance(si.shading.n, expected), Real(1e-4)) << alongU << byPoint;
    }
  }
}

// A unit sphere has u once around the axis and v from pole to pole. It is displaced by
// d = .3 sin(4 u) sin(3 v). The expected normal of the surface p + d n comes from central
// differences in double precision.
TEST(Bump, OnACurvedSurfaceIsTheNormalOfTheDisplacedOne) {
  using Triple = std::array<double, 3>;
  const auto onSphere = [](double u, double v) {
    return Triple{std::sin(v) * std::cos(u), std::sin(v) * std::sin(u), std::cos(v)};
  };
  const auto height = [](double u, double v) { return .3 * std::sin(4 * u) * std::sin(3 * v); };
  const auto displaced = [&](double u, double v) {
    Triple p = onSphere(u, v);
    for (double& x : p) x *= 1 + height(u, v);
    return p;
  };
  const auto toVector = [](const Triple& a) { return Vector3(Real(a[0]), Real(a[1]), Real(a[2])); };
  const auto slope = [&](const auto& surface, double u, double v, double du, double dv) {
    const Triple a = surface(u - du, v - dv), b = surface(u + du, v + dv);
    Triple d;
    for (std::size_t i = 0; i < 3; ++i) d[i] = (b[i] - a[i]) / (2 * (du + dv));
    return toVector(d);
  };
  for (const auto& [u, v] : {std::pair{.3, 1.1}, {2.0, .7}, {4.4, 2.2}, {5.5, 1.6}}) {
    SurfaceInteraction si;
    si.p = Point3() + toVector(onSphere(u, v));
    si.uv = {Real(u), Real(v)};
    si.dpdu = si.shading.dpdu = slope(onSphere, u, v, 1e-5, 0);
    si.dpdv = si.shading.dpdv = slope(onSphere, u, v, 0, 1e-5);
    si.ng = si.shading.n = Normalize(Cross(si.dpdu, si.dpdv));
    const Real sign = Dot(si.ng, si.p - Point3()) > 0 ? 1 : -1;  // sign of the normal's derivatives
    si.dndu = si.shading.dndu = si.dpdu * sign;
    si.dndv = si.shading.dndv = si.dpdv * sign;
    si.hasDifferentials = true;
    si.dudx = si.dvdy = Real(2e-3);  // steps of 1e-3
    ApplyBump(Height([&](const auto& at) {
                return sign * Real(height(double(at.uv.x), double(at.uv.y)));
              }),
              &si);
    const Vector3 expected =
        Normalize(Cross(slope(displaced, u, v, 1e-5, 0), slope(displaced, u, v, 0, 1e-5)));
    EXPECT_LT(Distance(si.shading.n, expected), Real(.01)) << u << " " << v;
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
  si.ng = {0, 0, -1};  // as with ReverseOrientation: the tangents give the other side
  si.shading.n = si.ng;
  ApplyBump(Height([](const auto& at) { return at.uv.x / 2; }), &si);
  EXPECT_GT(Dot(si.shading.n, si.ng), 0);
  // The surface is displaced towards -z: the point moves down as u grows.
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
