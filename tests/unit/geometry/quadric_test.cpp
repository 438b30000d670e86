// SPDX-License-Identifier: BSD-2-Clause
// These tests check spheres, disks, cylinders and the surfaces of revolution. Hits must be accurate
// from afar and at grazing incidence, a ray must not hit the surface that it leaves, and shapes
// must be refused if nothing of them is left.
#include <gtest/gtest.h>

#include "core/geometry/vec3d.h"
#include "tests/support/geometry_scenes.h"
#include "tests/unit/geometry/quadric_shapes.h"

namespace exphoton {
namespace {

class Quadrics : public QuadricShapes {};

TEST_F(Quadrics, AreNeverHitAgainByARayThatLeavesThem) {
  RandomStream random(21);
  struct Kind {
    const char* text;
    bool isBelowItsTangents;  // no ray that leaves outwards meets the shape again
  };
  const Kind kinds[] = {{R"("sphere" "float radius" 1.3)", true},
                        {R"("disk" "float radius" 1.3 "float height" .7)", true},
                        {R"("cylinder" "float radius" 1.3)", false},
                        {R"("cone" "float radius" 1.3)", false},
                        {R"("paraboloid" "float radius" .7)", false},
                        {R"("hyperboloid" "point p1" [1 0 -1] "point p2" [-.5 .9 .8])", false}};
  int hits = 0, found = 0;
  for (int i = 0; i < 600; ++i) {
    const Kind& kind = kinds[i % 6];
    const double scale = std::pow(10.0, double(Between(random, -4, 4)));
    const Transform toWorld =
        Transform::Translate(RandomVector(random) * Real(scale * 3)) *
        *Transform::Rotate(double(random.Uniform()) * 360, RandomVector(random)) *
        *Transform::Scale(scale, scale, scale * (i / 6 % 2 ? 1 : 0.3));
    const auto shape = Make(kind.text, toWorld);
    for (int k = 0; k < 200; ++k) {
      const Bounds3 bounds = shape->Bounds();
      const Ray in = RayFromTo(bounds.Center() + RandomVector(random) * Real(scale * 6),
                               bounds.Center() + RandomVector(random) * Real(scale));
      const auto hit = shape->Intersect(in);
      if (!hit) continue;
      ++found;
      const SurfaceInteraction surface = shape->Surface(in, *hit);
      Vector3 w = RandomVector(random);
      if (k % 4 == 0) w = w - surface.ng * Dot(surface.ng, w) * Real(.9999);
      // A ray that leaves a convex body outwards must not hit it again. A ray through the body must
      // have its next hit far away.
      const auto again = shape->Intersect(SpawnRay(surface, w));
      if (!again) continue;
      const SurfaceInteraction next = shape->Surface(SpawnRay(surface, w), *again);
      hits += Dot(w, surface.ng) > 0 && Dot(surface.ng, surface.p - next.p) >= 0 &&
              kind.isBelowItsTangents;
      hits += Distance(next.p, surface.p) < Real(1e-5 * scale) * AbsDot(w, surface.ng);
    }
  }
  EXPECT_EQ(hits, 0);
  EXPECT_GT(found, 20000);
}

TEST_F(Quadrics, SphereIsAccurateFromAfar) {
  const auto sphere = Make(R"("sphere")");
  for (const double distance : {10.0, 1e3, 1e5, 1e6}) {
    constexpr int kGrid = 64;
    int hits = 0, exactHits = 0;
    double worst = 1;
    for (int i = 0; i < kGrid; ++i) {
      for (int j = 0; j < kGrid; ++j) {
        const double x = (i + .5) * 2 / kGrid - 1, y = (j + .5) * 2 / kGrid - 1;
        const Ray ray = RayFromTo({0, 0, Real(-distance)}, {Real(x), Real(y), 0});
        const auto hit = sphere->Intersect(ray);
        const Vec3d d(ray.d), o(ray.o);
        const double a = Dot(d, d), b = Dot(o, d), nearest = -b / a;
        const Vec3d q = o + d * nearest;
        hits += hit.has_value();
        exactHits += Dot(q, q) < 1;
        if (!hit) continue;
        const double half = std::sqrt(std::max((1 - Dot(q, q)) / a, 0.0));
        const Vec3d exact = NormalizeOrZero(o + d * (nearest - half));
        worst = std::min(worst, Dot(exact, Vec3d(sphere->Surface(ray, *hit).ng)));
      }
    }
    EXPECT_NEAR(hits, exactHits, 0.01 * exactHits);
    EXPECT_GT(exactHits, 3000);
    EXPECT_GT(worst, std::cos(3.14159265 / 180)) << distance;
  }
}

TEST_F(Quadrics, GrazingAndUnnormalisedRaysStayFinite) {
  const auto sphere = Make(R"("sphere")");
  for (const Real length : {Real(1e-20), Real(1), Real(1e18)}) {
    for (int ulps = -3; ulps <= 3; ++ulps) {
      Real x = 1;
      for (int k = 0; k < std::abs(ulps); ++k) x = ulps < 0 ? NextDown(x) : NextUp(x);
      Ray ray;
      ray.o = {x, 0, -2};
      ray.d = {0, 0, length};
      const auto hit = sphere->Intersect(ray);
      EXPECT_EQ(hit.has_value(), x <= 1);
      if (!hit) continue;
      const SurfaceInteraction surface = sphere->Surface(ray, *hit);
      EXPECT_TRUE(IsFinite(surface.p) && IsFinite(surface.ng) && IsFinite(surface.dpdu));
      EXPECT_NEAR(hit->t * length, 2, 1e-2);
    }
  }
}

TEST_F(Quadrics, NormalsPointOutUnlessReversedOrMirrored) {
  const auto mirror = *Transform::Scale(-1, 1, 1);
  for (const bool reverse : {false, true}) {
    for (const Transform& toWorld : {Transform(), mirror}) {
      const Ray ray = RayFromTo({5, 0, Real(.3)}, {0, 0, Real(.3)});
      const Real side = reverse ? -1 : 1;
      for (const char* text : {R"("sphere")", R"("cylinder")", R"("cone" "float height" 9)",
                               R"("paraboloid" "float zmin" 0 "float zmax" .4)",
                               R"("hyperboloid" "point p1" [1 0 0] "point p2" [1 .1 2])"}) {
        const auto shape = Make(text, toWorld, reverse);
        // The paraboloid leans outwards and down; all others are nearly upright.
        const bool leans = std::string(text).find("paraboloid") != std::string::npos;
        EXPECT_GT(shape->Surface(ray, *shape->Intersect(ray)).ng.x * side,
                  leans ? Real(.2) : Real(.9))
            << text;
      }
      const auto disk = Make(R"("disk")", toWorld, reverse);
      const Ray down = RayFromTo({Real(.2), Real(.1), 5}, {Real(.2), Real(.1), 0});
      EXPECT_EQ(disk->Surface(down, *disk->Intersect(down)).ng.z, side);
    }
  }
}

TEST_F(Quadrics, DiskHitAtItsCentreHasAFiniteFrame) {
  const auto disk = Make(R"("disk")");
  const Ray ray = RayFromTo({0, 0, 3}, {0, 0, 0});
  const auto hit = disk->Intersect(ray);
  ASSERT_TRUE(hit);
  const SurfaceInteraction surface = disk->Surface(ray, *hit);
  EXPECT_EQ(surface.ng, Normal3(0, 0, 1));
  EXPECT_GT(Length(Cross(surface.dpdu, surface.dpdv)), 0);
  EXPECT_FALSE(disk->Intersect(RayFromTo({-3, 0, 0}, {3, 0, 0})));
  EXPECT_FALSE(disk->Intersect(RayFromTo({-3, 0, 1}, {3, 0, 1})));
}

TEST_F(Quadrics, DerivativesAgreeWithDifferences) {
  const char* const kinds[] = {R"("sphere" "float zmin" -.9 "float zmax" .8 "float phimax" 300)",
                               R"("sphere" "float radius" 2 "float zmin" -1.8 "float phimax" 300)",
                               R"("disk" "float innerradius" .1)",
                               R"("cylinder" "float phimax" 300)",
                               R"("cylinder" "float radius" 2 "float phimax" 300)",
                               R"("cone" "float height" 2)",
                               R"("paraboloid" "float zmax" 3)",
                               R"("hyperboloid" "point p1" [2 .3 -3] "point p2" [1 2 4])"};
  for (int i = 0; i < 32; ++i) {
    const std::string text = kinds[i % 8];
    const bool reverse = i / 8 % 2 == 1, mirrored = i / 16 == 1;
    SCOPED_TRACE(text + (reverse ? ", reversed" : "") + (mirrored ? ", mirrored" : ""));
    // The rays pass near the origin, where cone and paraboloid have their base and their tip.
    const bool isLowered =
        text.find("cone") != std::string::npos || text.find("paraboloid") != std::string::npos;
    const auto shape = Make(text,
                            Transform::Translate({0, 0, isLowered ? Real(-.6) : Real(0)}) *
                                *Transform::Scale(2, mirrored ? -1 : 1, Real(.5)),
                            reverse);
    const bool isDisk = text.find("disk") != std::string::npos;
    const auto at = [&](Real dx, Real dy) {
      const Ray ray =
          isDisk ? RayFromTo({Real(.4) + dx, Real(.5) + dy, 4}, {Real(.4) + dx, Real(.5) + dy, 0})
                 : RayFromTo({9, 2 + dx, Real(.2) + dy}, {0, dx, dy});
      return shape->Surface(ray, *shape->Intersect(ray));
    };
    const SurfaceInteraction s = at(0, 0);
    const Real e = Real(.002);
    for (const SurfaceInteraction& other : {at(e, 0), at(0, e)}) {
      const Real du = other.uv.x - s.uv.x, dv = other.uv.y - s.uv.y;
      EXPECT_LT(Distance(other.p - s.p, s.dpdu * du + s.dpdv * dv),
                Real(.03) * Distance(other.p, s.p));
      EXPECT_LT(Distance(other.ng - s.ng, s.dndu * du + s.dndv * dv),
                Real(.05) * Distance(other.p, s.p));
    }
  }
}

TEST_F(Quadrics, ScaleByPowersOfTwoBitForBit) {
  RandomStream random(31);
  int hits = 0;
  for (const char* text :
       {R"("sphere")", R"("sphere" "float zmax" .5 "float phimax" 270)", R"("disk")",
        R"("cylinder")", R"("cone")", R"("paraboloid" "float zmin" .1)",
        R"("hyperboloid" "float phimax" 270)"}) {
    const Vector3 shift = RandomVector(random);
    const Transform turned = *Transform::Rotate(37, {1, 2, 3});
    const auto shape = Make(text, Transform::Translate(shift) * turned);
    for (const int k : {-20, 10, 20}) {
      const Real factor = std::ldexp(Real(1), k);
      const auto scale = *Transform::Scale(double(factor), double(factor), double(factor));
      const auto larger = Make(text, Transform::Translate(shift * factor) * turned * scale);
      EXPECT_EQ(shape->Area() * factor * factor, larger->Area());
      for (int i = 0; i < 500; ++i) {
        Ray ray = RayFromTo(RandomVector(random) * 4, shift + RandomVector(random));
        ray.d = NormalizeOr(ray.d, {0, 0, 1});
        Ray far = ray;
        far.o = ray.o * factor;
        const auto hit = shape->Intersect(ray), farHit = larger->Intersect(far);
        ASSERT_EQ(hit.has_value(), farHit.has_value());
        const Point2 u(random.Uniform(), random.Uniform());
        SurfacePoint ref, farRef;
        ref.p = ray.o, farRef.p = far.o;
        const auto sample = shape->SampleToward(ref, u, 0);
        const auto farSample = larger->SampleToward(farRef, u, 0);
        ASSERT_EQ(sample.has_value(), farSample.has_value());
        if (sample) {
          EXPECT_EQ(sample->pdf, farSample->pdf);
          EXPECT_EQ(sample->point.p * factor, farSample->point.p);
        }
        if (!hit) continue;
        ++hits;
        EXPECT_EQ(hit->t * factor, farHit->t);
        const SurfaceInteraction a = shape->Surface(ray, *hit), b = larger->Surface(far, *farHit);
        EXPECT_EQ(a.p * factor, b.p);
        EXPECT_EQ(a.pError * factor, b.pError);
        EXPECT_EQ(a.ng, b.ng);
        EXPECT_EQ(a.uv, b.uv);
        EXPECT_EQ(a.dpdu * factor, b.dpdu);
      }
    }
  }
  EXPECT_GT(hits, 1000);
}

TEST_F(Quadrics, WithNothingLeftAreRefused) {
  for (const char* text : {R"("sphere" "float radius" 0)",
                           R"("sphere" "float radius" -1)",
                           R"("sphere" "float zmin" .5 "float zmax" .5)",
                           R"("sphere" "float phimax" 0)",
                           R"("sphere" "float zmin" 2)",
                           R"("disk" "float radius" 0)",
                           R"("disk" "float innerradius" 1)",
                           R"("disk" "float phimax" 361)",
                           R"("cylinder" "float zmin" 1)",
                           R"("cylinder" "float radius" -2)",
                           R"("cylinder" "float phimax" 0)",
                           R"("cone" "float height" 0)",
                           R"("cone" "float radius" 0)",
                           R"("cone" "float phimax" 0)",
                           R"("paraboloid" "float zmin" 1)",
                           R"("paraboloid" "float zmin" -.1)",
                           R"("paraboloid" "float radius" 0)",
                           R"("paraboloid" "float phimax" 361)",
                           R"("hyperboloid" "point p2" [1 1 0])",
                           R"("hyperboloid" "point p2" [0 0 1])",
                           R"("hyperboloid" "float phimax" 0)"}) {
    EXPECT_THROW(Make(text), Error) << text;
  }
}

TEST_F(Quadrics, UnevenlyScaledOnesHaveAnAreaAndAreNotSwitchedOff) {
  const auto uneven = *Transform::Scale(1, 1, 2), even = *Transform::Scale(3, 3, 3);
  EXPECT_NEAR(Make(R"("sphere")", even)->Area(), 4 * kPi * 9, 1e-3);
  EXPECT_NEAR(Make(R"("cylinder")", even)->Area(), 4 * kPi * 9, 1e-3);
  EXPECT_NEAR(Make(R"("disk" "float innerradius" .5 "float phimax" 90)", *Transform::Scale(1, 2, 1))
                  ->Area(),
              kPi * Real(.75) / 4 * 2, 1e-5);
  // The cases are a prolate spheroid, half of it, and elliptic tubes, whose area follows from the
  // circumference of the ellipse with the semi-axes 1 and 2.
  const double e = std::sqrt(.75), spheroid = 2 * M_PI * (1 + 2 / e * std::asin(e));
  const struct {
    const char* shape;
    Transform toWorld;
    double area;
  } cases[] = {
      {R"("sphere")", uneven, spheroid},
      {R"("sphere" "float zmin" 0)", *Transform::Rotate(50, {1, 2, 3}) * uneven, spheroid / 2},
      {R"("cylinder")", *Transform::Scale(1, 2, 1), 2 * 9.688448220547675},
      {R"("cylinder" "float phimax" 180)", *Transform::Scale(-2, 1, .5), 9.688448220547675 / 2},
      {R"("cone")", *Transform::Scale(1, 1, 2), M_PI * std::sqrt(5.)},
      {R"("paraboloid" "float phimax" 90)", *Transform::Scale(2, 2, 1),
       (std::pow(8., 1.5) - 8) * M_PI / 12}};
  for (const auto& [text, toWorld, area] : cases) {
    const auto shape = Make(text, toWorld);
    EXPECT_EQ(shape->EmitterProblem(), nullptr);
    EXPECT_NEAR(double(shape->Area()) / area, 1, 1e-3) << text;
    // For emission samples, the mean of 1 / pdf is the area.
    RandomStream random(5);
    double sum = 0;
    constexpr int kSamples = 40000;
    for (int i = 0; i < kSamples; ++i) {
      const Point2 u(random.Uniform(), random.Uniform());
      const EmitterSample sample = shape->SamplePoint(u, 0, 0);
      sum += 1 / double(sample.pdf) / kSamples;
      const Ray ray = RayFromTo(sample.point.p + sample.point.ng * Real(.01), sample.point.p);
      const auto hit = shape->Intersect(ray);
      if (i % 100 || !hit) continue;
      EXPECT_GT(Dot(shape->Surface(ray, *hit).ng, sample.point.ng), Real(.999)) << text;
    }
    EXPECT_NEAR(sum / area, 1, .01) << text;
  }
}

}  // namespace
}  // namespace exphoton
