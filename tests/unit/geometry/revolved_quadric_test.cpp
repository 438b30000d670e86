// SPDX-License-Identifier: BSD-2-Clause
// These tests check cone, paraboloid and hyperboloid against their equations and areas.
#include <gtest/gtest.h>

#include <functional>

#include "core/geometry/vec3d.h"
#include "core/math/sampling/sampling.h"
#include "tests/support/geometry_scenes.h"
#include "tests/unit/geometry/quadric_shapes.h"

namespace exphoton {
namespace {

class RevolvedQuadrics : public QuadricShapes {};

TEST_F(RevolvedQuadrics, SurfacesOfRevolutionHaveTheirAreas) {
  EXPECT_NEAR(Make(R"("cone" "float radius" 3 "float height" 4 "float phimax" 120)")->Area(),
              5 * kPi, 1e-5);
  // The area of a paraboloid rho^2 = z is pi / 6 ((1 + 4 z)^1.5 - 1).
  EXPECT_NEAR(
      double(Make(R"("paraboloid" "float radius" 2 "float zmin" 1 "float zmax" 4)")->Area()),
      M_PI / 6 * (std::pow(17., 1.5) - std::pow(5., 1.5)), 1e-4);
  // Lines through the axis make two cones, and vertical lines make tubes.
  EXPECT_NEAR(Make(R"("hyperboloid" "point p1" [-1 0 -1] "point p2" [2 0 2])")->Area(),
              5 * kPi * std::sqrt(Real(2)), 1e-4);
  EXPECT_NEAR(Make(R"("hyperboloid" "point p1" [3 4 1] "point p2" [3 4 3])")->Area(), 20 * kPi,
              1e-4);
  // A hyperboloid by the midpoint rule: its line has the squared radius 1 + v^2 at height v.
  double area = 0;
  for (int i = 0; i < 10000; ++i) {
    const double v = (i + .5) / 10000;
    area += 2 * M_PI * std::sqrt(1 + 2 * v * v) / 10000;
  }
  EXPECT_NEAR(double(Make(R"("hyperboloid" "point p1" [1 0 0] "point p2" [1 1 1])")->Area()), area,
              1e-5);
}

// Hits lie on the surface that the implicit equation gives, and uv are the stated parameters.
TEST_F(RevolvedQuadrics, SurfacesOfRevolutionAreHitWhereTheirEquationsHold) {
  const struct {
    const char* text;
    std::function<Point3(double phi, double v)> point;
  } cases[] = {
      {R"("cone" "float radius" 2 "float height" 3 "float phimax" 200)",
       [](double phi, double v) {
         return Point3(Real(2 * (1 - v) * std::cos(phi)), Real(2 * (1 - v) * std::sin(phi)),
                       Real(3 * v));
       }},
      {R"("paraboloid" "float radius" 2 "float zmin" .5 "float zmax" 2 "float phimax" 200)",
       [](double phi, double v) {
         const double z = .5 + 1.5 * v, r = 2 * std::sqrt(z / 2);
         return Point3(Real(r * std::cos(phi)), Real(r * std::sin(phi)), Real(z));
       }},
      {R"("hyperboloid" "point p1" [1 .2 -1] "point p2" [-.4 .9 2] "float phimax" 200)",
       [](double phi, double v) {
         const double x = 1 - 1.4 * v, y = .2 + .7 * v;
         return Point3(Real(x * std::cos(phi) - y * std::sin(phi)),
                       Real(x * std::sin(phi) + y * std::cos(phi)), Real(-1 + 3 * v));
       }}};
  RandomStream random(3);
  for (const auto& [text, point] : cases) {
    const auto shape = Make(text);
    int outside = 0;
    for (int i = 0; i < 500; ++i) {
      const double u = double(random.Uniform()), v = double(random.Uniform());
      const Point3 p = point(u * 200 * M_PI / 180, v);
      EXPECT_TRUE(shape->Bounds().Contains(p)) << text;
      const Vector3 w = RandomVector(random);
      const Ray ray = RayFromTo(p + w * Real(.01), p);
      const auto hit = shape->Intersect(ray);
      ASSERT_TRUE(hit) << text << u << " " << v;
      if (std::abs(hit->t - 1) > Real(.1)) continue;  // another part of the surface is nearer
      const SurfaceInteraction surface = shape->Surface(ray, *hit);
      const Real cosine = AbsDot(NormalizeOr(ray.d, {}), surface.ng);
      EXPECT_LT(Distance(surface.p, p) * cosine, Real(2e-6)) << text;
      EXPECT_NEAR(surface.uv.x, u, 1e-5 / double(cosine)) << text;
      EXPECT_NEAR(surface.uv.y, v, 1e-5 / double(cosine)) << text;
      // A point beyond phimax is not on the shape.
      const Point3 off = point((201 + 158 * u) * M_PI / 180, v);
      const Ray beside = RayFromTo(off + w * Real(.01), off);
      const auto other = shape->Intersect(beside);
      outside += other && std::abs(other->t - 1) < Real(.01);
    }
    EXPECT_EQ(outside, 0) << text;
  }
}

TEST_F(RevolvedQuadrics, HyperboloidExchangesItsEndsLikeVersion1) {
  // With p2 in the plane z = 0 the line runs from p2 to p1, so that v and the normal turn round.
  const auto shape = Make(R"("hyperboloid" "point p1" [1 0 2] "point p2" [1 0 0])");
  const Ray ray = RayFromTo({5, 0, Real(.5)}, {0, 0, Real(.5)});
  const SurfaceInteraction surface = shape->Surface(ray, *shape->Intersect(ray));
  EXPECT_NEAR(surface.uv.y, .25, 1e-6);
  EXPECT_GT(surface.ng.x, Real(.99));
}

TEST_F(RevolvedQuadrics, ConeTipHasAFiniteFrame) {
  const auto cone = Make(R"("cone")");
  const Ray ray = RayFromTo({0, 0, 5}, {0, 0, 0});
  const auto hit = cone->Intersect(ray);
  ASSERT_TRUE(hit);
  const SurfaceInteraction surface = cone->Surface(ray, *hit);
  EXPECT_EQ(surface.ng, Normal3(0, 0, 1));
  EXPECT_NEAR(surface.p.z, 1, 1e-6);
  EXPECT_TRUE(IsFinite(surface.dpdu) && IsFinite(surface.dpdv));
  EXPECT_GT(Length(Cross(surface.dpdu, surface.dpdv)), 0);
}

// Returns the density of SampleToward in direction w: the sum over all points along w.
double DensityToward(const Shape& shape, const SurfacePoint& ref, const Vector3& w) {
  Ray ray;
  ray.o = ref.p;
  ray.d = w;
  double sum = 0;
  for (int i = 0; i < 8; ++i) {
    const auto hit = shape.Intersect(ray);
    if (!hit) break;
    const SurfaceInteraction on = shape.Surface(ray, *hit);
    sum += double(shape.PdfToward(ref, w, on));
    ray = SpawnRay(on, w);
  }
  return sum;
}

// The mean of 1 / density over samples is the solid angle that the shape covers. Uniform directions
// measure it independently. Densities are infinite at silhouettes, where a histogram would fail.
TEST_F(RevolvedQuadrics, SampledFromOutsideCoverTheirSolidAngle) {
  for (const char* text : {R"("cone" "float radius" .7 "float phimax" 300)", R"("paraboloid")",
                           R"("hyperboloid" "point p1" [1 0 -1] "point p2" [-.5 .8 1])"}) {
    const auto shape = Make(text);
    SurfacePoint ref;
    ref.p = {2, 1, Real(1.5)};
    RandomStream random(4);
    constexpr int kSamples = 200000;
    double sampled = 0, uniform = 0;
    for (int i = 0; i < kSamples; ++i) {
      const Real x = random.Uniform();
      const Point2 u(x, random.Uniform());
      if (const auto s = shape->SampleToward(ref, u, 0)) {
        const double pdf = DensityToward(*shape, ref, NormalizeOr(s->point.p - ref.p, {0, 0, 1}));
        if (pdf > 0) sampled += 1 / pdf / kSamples;
      }
      const Vector3 w = SampleUniformSphere(u);
      Ray ray;
      ray.o = ref.p;
      ray.d = w;
      uniform += shape->Intersect(ray) ? 4 * M_PI / kSamples : 0;
    }
    EXPECT_NEAR(sampled / uniform, 1, .03) << text;
  }
}

}  // namespace
}  // namespace exphoton
