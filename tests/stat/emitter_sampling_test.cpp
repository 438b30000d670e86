// SPDX-License-Identifier: BSD-2-Clause
// These tests check surfaces as emitters. SampleToward and SamplePoint must have the densities that
// they state, for reference points outside, far away, inside and very close. The false-alarm rate
// is 1 % over all chi-square tests of this file.
#include <gtest/gtest.h>

#include "core/scene/primitive.h"
#include "tests/support/chi_square.h"
#include "tests/support/equivalence.h"
#include "tests/support/geometry_scenes.h"
#include "tests/support/test_plugin.h"

namespace exphoton {
namespace {

constexpr int kEmitterTests = 32;

struct Case {
  const char* name;
  const char* shape;
  Point3 ref;
  // Whether SampleToward may return any of several points along one direction. If so, their
  // densities add up. Otherwise only the nearest point counts.
  bool countsAllHits;
  Transform toWorld = {};
};

const Transform kUneven = *Transform::Rotate(40, {1, 2, -1}) * *Transform::Scale(1.4, .5, -.9);

const Case kCases[] = {
    {"SphereOutside", R"("sphere")", {3, 1, -2}, false},
    {"SphereFar", R"("sphere" "float radius" .01)", {300, 100, -200}, false},
    {"SphereVeryClose", R"("sphere")", {0, 0, Real(1.0005)}, false},
    {"SphereInside", R"("sphere")", {Real(.3), Real(.5), Real(-.2)}, false},
    {"SphereOnIt", R"("sphere")", {0, 0, Real(-.9999)}, true},
    {"Disk", R"("disk")", {Real(.5), 1, 2}, true},
    {"DiskRingSector", R"("disk" "float innerradius" .4 "float phimax" 250)", {-1, 1, -2}, true},
    {"CylinderInside", R"("cylinder" "float phimax" 180)", {Real(.1), Real(.3), 0}, true},
    {"ConeInside", R"("cone" "float phimax" 300)", {Real(.1), Real(.05), Real(.4)}, true},
    {"ParaboloidInside", R"("paraboloid" "float zmax" 2)", {Real(.1), Real(.1), 1}, true},
    {"HyperboloidInside",
     R"("hyperboloid" "point p1" [1 0 -1] "point p2" [-.5 .8 1])",
     {Real(.05), Real(-.1), Real(.2)},
     true},
    {"Mesh",
     R"("trianglemesh" "integer indices" [0 1 2 0 2 3]
        "point P" [-1 -1 0  2 -1 0  2 1 1  -1 1 0])",
     {0, 0, 3},
     true},
    {"EllipsoidOutside", R"("sphere")", {3, 1, -2}, false, kUneven},
    {"EllipsoidInside", R"("sphere")", {Real(.2), Real(.1), Real(-.1)}, false, kUneven},
    {"PartOfAnEllipsoid", R"("sphere" "float zmax" .3)", {Real(.2), Real(.1), 0}, true, kUneven},
    {"EllipticTube", R"("cylinder" "float phimax" 200)", {1, -1, 2}, true, kUneven},
};

class EmitterSampling : public testing::TestWithParam<Case> {
 protected:
  EmitterSampling() {
    ShapeGeometry geometry = plugins_.MakeShape(GetParam().shape, GetParam().toWorld);
    if (auto* shape = std::get_if<std::unique_ptr<Shape>>(&geometry)) {
      std::shared_ptr<const Shape> shared = std::move(*shape);
      emitter_ = shared;
      set_.AddShape(shared, {});
    } else {
      mesh_ = std::move(std::get<std::unique_ptr<TriangleMesh>>(geometry));
      emitter_ = MakeMeshEmitter(*mesh_);
      set_.AddMesh(mesh_, {});
    }
    set_.Finish();
    aggregate_ = plugins_.MakeAccelerator(R"("bruteforce")", set_);
    ref_.p = GetParam().ref;
  }

  // Returns the sum of the densities of the surface points along w, or only the density of the
  // nearest point if countsAllHits is false.
  double Pdf(const Vector3& w) const {
    Ray ray;
    ray.o = ref_.p;
    ray.d = w;
    double sum = 0;
    for (int i = 0; i < 8; ++i) {
      const Hit hit = aggregate_->Intersect(ray);
      if (!hit.IsHit()) break;
      const SurfaceInteraction on = set_.Surface(ray, hit);
      sum += double(emitter_->PdfToward(ref_, w, on));
      if (!GetParam().countsAllHits) break;
      ray = SpawnRay(on, w);
    }
    return sum;
  }

  std::optional<EmitterSample> Sample(RandomStream& random) const {
    const Real x = random.Uniform(), y = random.Uniform(), part = random.Uniform();
    return emitter_->SampleToward(ref_, {x, y}, part);
  }

  ChiSquareResult Test() const {
    const auto sample = [&](RandomStream& random) -> std::optional<Vector3> {
      const auto s = Sample(random);
      if (!s) return std::nullopt;
      return NormalizeOr(s->point.p - ref_.p, {0, 0, 1});
    };
    const auto pdf = [&](const Vector3& w) { return Pdf(w); };
    const Sphere3 ball = BoundingSphere(emitter_->Bounds());
    const Vector3 axis = ball.center - ref_.p;
    const double sine = double(ball.radius / Length(axis));
    DirectionGrid grid{axis, 2};
    if (sine < 0.99) grid.oneMinusCosMax = 1 - std::sqrt(1 - sine * sine);
    ChiSquareOptions options;
    options.rows = 10, options.columns = 16, options.samples = 40000;
    options.quadratureDepth = 6;
    return TestDirections(grid, sample, pdf, options);
  }

  TestPlugins plugins_;
  std::shared_ptr<const TriangleMesh> mesh_;
  std::shared_ptr<const EmitterSurface> emitter_;
  PrimitiveSet set_;
  std::unique_ptr<Aggregate> aggregate_;
  SurfacePoint ref_;
};

TEST_P(EmitterSampling, TowardAPointFitsItsDensity) {
  EXPECT_TRUE(FitsDensity(Test(), kEmitterTests));
}

TEST_P(EmitterSampling, SaysOfASampleWhatItSaysOfAHit) {
  RandomStream random(4);
  for (int i = 0; i < 1000; ++i) {
    const auto s = Sample(random);
    if (!s) continue;
    EXPECT_GT(s->pdf, 0);
    const Vector3 w = NormalizeOr(s->point.p - ref_.p, {});
    EXPECT_NEAR(emitter_->PdfToward(ref_, w, s->point) / s->pdf, 1, 1e-4);
    EXPECT_NEAR(Length(s->point.ng), 1, 1e-5);
    EXPECT_TRUE(emitter_->Bounds().Contains(s->point.p) ||
                Length(emitter_->Bounds().Diagonal()) > 0);
  }
}

INSTANTIATE_TEST_SUITE_P(All, EmitterSampling, testing::ValuesIn(kCases),
                         [](const auto& info) { return std::string(info.param.name); });

// SamplePoint must be uniform in the coordinates to which toSquare maps its points.
struct AreaCase {
  const char* name;
  const char* shape;
  double area;
  std::function<Point2(const Point3&)> toSquare;
};

Real Turn(const Point3& p, Real degrees) {
  const Real phi = std::atan2(p.y, p.x);
  return std::min((phi < 0 ? phi + 2 * kPi : phi) / Radians(degrees), kOneMinusEpsilon);
}

std::vector<AreaCase> AreaCases() {
  const double pi = double(kPi);
  return {
      {"sphere", R"("sphere" "float radius" 2)", 16 * pi,
       [](const Point3& p) { return Point2((p.z + 2) / 4, Turn(p, 360)); }},
      {"part of a sphere", R"("sphere" "float zmin" -.5 "float phimax" 200)", 1.5 * pi * 200 / 180,
       [](const Point3& p) { return Point2((p.z + Real(.5)) / Real(1.5), Turn(p, 200)); }},
      {"ring", R"("disk" "float innerradius" .5 "float phimax" 250)", .75 * pi * 250 / 360,
       [](const Point3& p) {
         return Point2((p.x * p.x + p.y * p.y - Real(.25)) / Real(.75), Turn(p, 250));
       }},
      {"cylinder", R"("cylinder" "float zmax" 2 "float phimax" 90)", 3 * pi / 2,
       [](const Point3& p) { return Point2((p.z + 1) / 3, Turn(p, 90)); }},
      {"cone", R"("cone" "float radius" 3 "float height" 4 "float phimax" 120)", 5 * pi,
       [](const Point3& p) { return Point2((1 - p.z / 4) * (1 - p.z / 4), Turn(p, 120)); }},
      {"paraboloid", R"("paraboloid" "float phimax" 90)", pi / 24 * (std::pow(5., 1.5) - 1),
       [](const Point3& p) {
         const auto area = Real((std::pow(1 + 4 * double(p.z), 1.5) - 1) / (std::pow(5., 1.5) - 1));
         return Point2(std::min(area, kOneMinusEpsilon), Turn(p, 90));
       }},
      {"two cones of a line through the axis",
       R"("hyperboloid" "point p1" [-1 0 -1] "point p2" [2 0 2])", 5 * pi * std::sqrt(2.),
       [](const Point3& p) {
         const Real signedArea = p.z * std::abs(p.z);
         return Point2(std::min((signedArea + 1) / 5, kOneMinusEpsilon), Turn(p, 360));
       }},
      {"quads of a mesh", R"("trianglemesh" "integer indices" [0 1 2  0 2 3  1 4 5  1 5 2]
          "point P" [0 0 0  .1 0 0  .1 1 0  0 1 0  1 0 0  1 1 0])",
       1, [](const Point3& p) { return Point2(p.x, p.y); }}};
}

TEST(EmitterArea, IsSampledUniformly) {
  TestPlugins plugins;
  for (const AreaCase& test : AreaCases()) {
    const auto emitter = plugins.MakeEmitter(test.shape);
    EXPECT_NEAR(double(emitter->Area()) / test.area, 1, 1e-5) << test.name;
    const auto sample = [&](RandomStream& random) -> std::optional<Point2> {
      const Real x = random.Uniform(), y = random.Uniform(), part = random.Uniform();
      const EmitterSample s = emitter->SamplePoint({x, y}, part, 0);
      EXPECT_EQ(s.pdf, 1 / emitter->Area());
      return test.toSquare(s.point.p);
    };
    EXPECT_TRUE(FitsDensity(TestPlane({}, sample, [](Point2) { return 1.0; }), kEmitterTests))
        << test.name;
  }
}

// From outside, the density per solid angle grows without bound towards a silhouette, where the
// surface is seen edge-on. Quadrature over cells of directions then fails, and a histogram of
// directions with it (EmitterSampling has such shapes from inside only). In the coordinates of the
// area the density is even, and the density per solid angle is distance^2 / (area cos) of it.
TEST(EmitterArea, IsSampledUniformlyTowardsAPointOutside) {
  TestPlugins plugins;
  SurfacePoint ref;
  ref.p = {3, 1, Real(2.5)};
  for (const AreaCase& test : AreaCases()) {
    const std::string name = test.name;
    if (name.find("sphere") != std::string::npos) continue;  // sampled by solid angle
    const auto emitter = plugins.MakeEmitter(test.shape);
    int edgeOn = 0;
    const auto sample = [&](RandomStream& random) -> std::optional<Point2> {
      const Real x = random.Uniform(), y = random.Uniform(), part = random.Uniform();
      const auto s = emitter->SampleToward(ref, {x, y}, part);
      if (!s) return ++edgeOn, std::nullopt;
      const Vector3 to = s->point.p - ref.p;
      const double cosine = double(AbsDot(s->point.ng, to) / Length(to));
      const double pdf = double(LengthSquared(to)) / (cosine * test.area);
      if (cosine > .01) {
        EXPECT_NEAR(double(s->pdf) / pdf, 1, 1e-3) << name;
      }
      return test.toSquare(s->point.p);
    };
    EXPECT_TRUE(FitsDensity(TestPlane({}, sample, [](Point2) { return 1.0; }), kEmitterTests))
        << name;
    EXPECT_LT(edgeOn, 10) << name;
  }
}

// The irradiance of a receiver that faces the sphere's centre is pi L (r / d)^2 outside the sphere
// and pi L inside.
TEST(SphereEmitter, GivesTheIrradianceOfTheClosedForm) {
  TestPlugins plugins;
  const auto sphere = plugins.MakeEmitter(R"("sphere")");
  for (const double d : {0.5, 1.000001, 1.1, 10.0, 1e3, 1e6}) {
    SurfacePoint ref;
    ref.p = {0, 0, Real(d)};
    const double truth = d < 1 ? 1 : 1 / (double(ref.p.z) * double(ref.p.z));
    const auto estimate = EstimateOverSeeds([&](std::uint64_t seed) {
      RandomStream random(seed);
      double sum = 0;
      constexpr int kSide = 200, kSamples = kSide * kSide;  // stratified
      for (int i = 0; i < kSamples; ++i) {
        const Real x = (Real(i % kSide) + random.Uniform()) / kSide;
        const Real y = (Real(i / kSide) + random.Uniform()) / kSide;
        const auto s = sphere->SampleToward(ref, {x, y}, 0);
        if (!s) continue;
        const Vector3 w = NormalizeOr(s->point.p - ref.p, {});
        // Outside, the receiver sees the near half of the sphere. Inside, it sees the far wall.
        if ((Dot(w, s->point.ng) < 0) == (d > 1)) sum += std::max(double(-w.z / s->pdf), 0.0);
      }
      return sum / kSamples / double(kPi);
    });
    EXPECT_TRUE(IsWithin(0.002, estimate, truth)) << "distance " << d;
  }
}

}  // namespace
}  // namespace exphoton
