// SPDX-License-Identifier: BSD-2-Clause
// These tests compare spheres, disks and cylinders with their parametric formulas in double
// precision: points, normals and their derivatives, the ends of the parameters, areas, bounds,
// and samples of points and of directions.
#include <gtest/gtest.h>

#include <functional>

#include "core/geometry/vec3d.h"
#include "core/math/sampling/sampling.h"
#include "tests/support/geometry_scenes.h"
#include "tests/support/test_plugin.h"

namespace exphoton {
namespace {

// A shape's text with its formulas in object space. The normal need not have unit length.
struct Quadric {
  std::string text;
  double area;  // in object space
  std::function<Vec3d(double u, double v)> point;
  std::function<Vec3d(double u, double v)> normal;
};

Quadric SphereOf(const std::string& parameters, double r, double low, double high, double degrees) {
  const double phiMax = degrees * M_PI / 180;
  const double from = std::acos(low / r), to = std::acos(high / r);
  const auto direction = [=](double u, double v) {
    const double theta = from + v * (to - from), phi = u * phiMax;
    return Vec3d(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta));
  };
  return {"\"sphere\" " + parameters, phiMax * r * (high - low),
          [=](double u, double v) { return direction(u, v) * r; }, direction};
}

Quadric CylinderOf(const std::string& parameters, double r, double low, double high,
                   double degrees) {
  const double phiMax = degrees * M_PI / 180;
  return {"\"cylinder\" " + parameters, phiMax * r * (high - low),
          [=](double u, double v) {
            return Vec3d(r * std::cos(u * phiMax), r * std::sin(u * phiMax),
                         low + v * (high - low));
          },
          [=](double u, double) { return Vec3d(std::cos(u * phiMax), std::sin(u * phiMax), 0); }};
}

Quadric DiskOf(const std::string& parameters, double r, double inner, double height,
               double degrees) {
  const double phiMax = degrees * M_PI / 180;
  return {"\"disk\" " + parameters, phiMax * (r * r - inner * inner) / 2,
          [=](double u, double v) {
            const double rho = r + v * (inner - r);
            return Vec3d(rho * std::cos(u * phiMax), rho * std::sin(u * phiMax), height);
          },
          [](double, double) { return Vec3d(0, 0, 1); }};
}

std::vector<Quadric> Quadrics() {
  return {SphereOf("", 1, -1, 1, 360),
          SphereOf(R"("float radius" 2 "float zmin" -1.5 "float zmax" .7 "float phimax" 250)", 2,
                   -1.5, .7, 250),
          SphereOf(R"("float radius" .5 "float zmin" .4)", .5, .4, .5, 360),
          SphereOf(R"("float radius" .5 "float zmax" .1)", .5, -.5, .1, 360),
          SphereOf(R"("float zmin" .6 "float zmax" -.2)", 1, -.2, .6, 360),
          CylinderOf("", 1, -1, 1, 360),
          CylinderOf(R"("float radius" .7 "float zmin" .5 "float zmax" 2 "float phimax" 100)", .7,
                     .5, 2, 100),
          CylinderOf(R"("float zmin" 2 "float zmax" -.5)", 1, -.5, 2, 360),
          DiskOf("", 1, 0, 0, 360),
          DiskOf(R"("float radius" 2 "float innerradius" .5 "float height" .8 "float phimax" 200)",
                 2, .5, .8, 200)};
}

const Transform kQuadricPlace = Transform::Translate({1, -2, 3}) *
                                *Transform::Rotate(35, {1, 2, -1}) * *Transform::Scale(1, 2, -1.5);

Vec3d PointToWorld(const Transform& map, const Vec3d& p) {
  const auto& m = map.Matrix().m;
  const auto row = [&](int i) { return m[i][0] * p.x + m[i][1] * p.y + m[i][2] * p.z + m[i][3]; };
  return {row(0), row(1), row(2)};
}
// With the inverse's transpose.
Vec3d NormalToWorld(const Transform& map, const Vec3d& n) {
  const auto& m = map.InverseMatrix().m;
  const auto column = [&](int i) { return m[0][i] * n.x + m[1][i] * n.y + m[2][i] * n.z; };
  return NormalizeOrZero({column(0), column(1), column(2)});
}

void ExpectNear(const Vec3& a, const Vec3d& b, double tolerance, const char* what) {
  EXPECT_LT(Length(Vec3d(a) - b), tolerance * (1 + Length(b))) << what;
}

void ExpectShadingOfTheSurface(const SurfaceInteraction& surface) {
  EXPECT_EQ(surface.shading.n, surface.ng);
  EXPECT_EQ(surface.shading.dpdu, surface.dpdu);
  EXPECT_EQ(surface.shading.dpdv, surface.dpdv);
  EXPECT_EQ(surface.shading.dndu, surface.dndu);
  EXPECT_EQ(surface.shading.dndv, surface.dndv);
}

// A ray that ends at the hit misses; the error of the point is its rounding.
void ExpectEndAndError(const Shape& shape, Ray ray, const ShapeHit& hit) {
  const SurfaceInteraction surface = shape.Surface(ray, hit);
  ray.tMax = hit.t;
  EXPECT_FALSE(shape.Intersect(ray));
  ray.tMax = NextUp(hit.t);
  EXPECT_TRUE(shape.Intersect(ray));
  EXPECT_TRUE(shape.Occludes(ray));
  for (int axis = 0; axis < 3; ++axis) {
    const double rounding = double(Gamma(2)) * std::abs(double(surface.p[axis]));
    EXPECT_GE(double(surface.pError[axis]), rounding * .999999);
    EXPECT_LE(double(surface.pError[axis]), rounding * 1.000001 + 1e-11);
  }
}

class QuadricFormulas : public testing::Test {
 protected:
  std::unique_ptr<Shape> Make(const std::string& text, const Transform& toWorld = {},
                              bool reverse = false) {
    ShapeGeometry geometry = plugins_.MakeShape(text, toWorld, reverse);
    return std::move(std::get<std::unique_ptr<Shape>>(geometry));
  }
  TestPlugins plugins_;
};

TEST_F(QuadricFormulas, GiveThePointsNormalsAndDerivatives) {
  RandomStream random(3);
  for (const Quadric& quadric : Quadrics()) {
    for (const bool reverse : {false, true}) {
      SCOPED_TRACE(quadric.text + (reverse ? " reversed" : ""));
      const auto shape = Make(quadric.text, kQuadricPlace, reverse);
      const double side = reverse ? -1 : 1;
      const auto point = [&](double u, double v) {
        return PointToWorld(kQuadricPlace, quadric.point(u, v));
      };
      const auto normal = [&](double u, double v) {
        return NormalToWorld(kQuadricPlace, quadric.normal(u, v)) * side;
      };
      for (int i = 0; i < 40; ++i) {
        const double u = double(Between(random, Real(.02), Real(.98)));
        const double v = double(Between(random, Real(.05), Real(.95)));
        const Vec3d p = point(u, v), n = normal(u, v);
        // From a quarter away on either side, and at a slant.
        Ray ray;
        ray.d = (n * (i % 2 ? -1 : 1)).ToReal() + RandomVector(random) * Real(.3);
        ray.o = (p - Vec3d(ray.d) * .25).ToReal();
        const auto hit = shape->Intersect(ray);
        ASSERT_TRUE(hit);
        EXPECT_NEAR(double(hit->t), .25, 1e-4);
        const SurfaceInteraction surface = shape->Surface(ray, *hit);
        ExpectNear(surface.p, p, 1e-4, "p");
        EXPECT_NEAR(double(surface.uv.x), u, 1e-4);
        EXPECT_NEAR(double(surface.uv.y), v, 1e-4);
        ExpectNear(surface.ng, n, 1e-4, "ng");
        constexpr double e = 1e-4;
        const auto alongU = [&](const auto& f) { return (f(u + e, v) - f(u - e, v)) * (.5 / e); };
        const auto alongV = [&](const auto& f) { return (f(u, v + e) - f(u, v - e)) * (.5 / e); };
        ExpectNear(surface.dpdu, alongU(point), 1e-3, "dpdu");
        ExpectNear(surface.dpdv, alongV(point), 1e-3, "dpdv");
        ExpectNear(surface.dndu, alongU(normal), 1e-3, "dndu");
        ExpectNear(surface.dndv, alongV(normal), 1e-3, "dndv");
        ExpectShadingOfTheSurface(surface);
        ExpectEndAndError(*shape, ray, *hit);
        if (HasFailure()) FAIL() << "u " << u << ", v " << v;
      }
    }
  }
}

// Just inside of each end of u and v there is a hit, and just outside there is none.
TEST_F(QuadricFormulas, EndWhereTheirParametersSay) {
  for (const Quadric& quadric : Quadrics()) {
    const auto shape = Make(quadric.text);
    SCOPED_TRACE(quadric.text);
    const auto isHit = [&](double u, double v) {
      const Vec3d p = quadric.point(u, v), n = quadric.normal(u, v);
      Ray ray;
      ray.o = (p + n * .02).ToReal();
      ray.d = (n * -1).ToReal();
      ray.tMax = Real(.04);
      return shape->Intersect(ray).has_value();
    };
    constexpr double e = 2e-3;
    const bool isRound = quadric.text.find("phimax") == std::string::npos;
    const bool hasPoles = Length(quadric.point(0, 0) - quadric.point(.3, 0)) < 1e-9;
    const bool hasUpperPole = Length(quadric.point(0, 1) - quadric.point(.3, 1)) < 1e-9;
    EXPECT_TRUE(isHit(e, .5) && isHit(1 - e, .5) && isHit(.5, e) && isHit(.5, 1 - e));
    EXPECT_EQ(isHit(-e, .5), isRound);
    EXPECT_EQ(isHit(1 + e, .5), isRound);
    EXPECT_EQ(isHit(.5, -e), hasPoles);
    EXPECT_EQ(isHit(.5, 1 + e), hasUpperPole);
  }
}

TEST_F(QuadricFormulas, GiveAreaAndSamplesOfPoints) {
  RandomStream random(4);
  const Transform similar = Transform::Translate({1, -2, 3}) * *Transform::Rotate(35, {1, 2, -1}) *
                            *Transform::Scale(2, 2, 2);
  for (const Quadric& quadric : Quadrics()) {
    SCOPED_TRACE(quadric.text);
    const auto shape = Make(quadric.text, similar);
    EXPECT_NEAR(double(shape->Area()) / (4 * quadric.area), 1, 1e-5);
    const bool isDisk = quadric.text.starts_with("\"disk\"");
    const Vec3d outer = quadric.point(0, 0), inner = quadric.point(0, 1);
    for (int i = 0; i < 50; ++i) {
      const Point2 u(random.Uniform(), random.Uniform());
      const EmitterSample sample = shape->SamplePoint(u, Real(.3), Real(.2));
      EXPECT_EQ(sample.pdf, 1 / shape->Area());
      EXPECT_NEAR(double(sample.uv.x), double(u.y), 1e-4);
      const Vec3d p = quadric.point(double(sample.uv.x), double(sample.uv.y));
      ExpectNear(sample.point.p, PointToWorld(similar, p), 1e-4, "p");
      ExpectNear(sample.point.ng,
                 NormalToWorld(similar, quadric.normal(double(sample.uv.x), double(sample.uv.y))),
                 1e-3, "ng");
      EXPECT_GT(Length(sample.point.pError), 0);
      // u.x is the part of the area, by z (a theorem of Archimedes) or by squares of radii.
      const double part = isDisk ? (p.x * p.x + p.y * p.y - inner.x * inner.x) /
                                       (outer.x * outer.x - inner.x * inner.x)
                                 : (p.z - outer.z) / (inner.z - outer.z);
      EXPECT_NEAR(part, double(u.x), 1e-3);
    }
  }
}

TEST_F(QuadricFormulas, BoundAllPointsTightly) {
  for (const Quadric& quadric : Quadrics()) {
    for (const Transform& place : {Transform(), kQuadricPlace}) {
      const auto shape = Make(quadric.text, place);
      const Bounds3 bounds = shape->Bounds();
      Bounds3 points;
      for (int i = 0; i <= 200; ++i)
        for (int j = 0; j <= 50; ++j)
          points.Extend(PointToWorld(place, quadric.point(i / 200., j / 50.)).ToReal());
      const bool isWhole = quadric.text.find("float") == std::string::npos;
      const bool isTight =
          isWhole && (quadric.text.starts_with("\"sphere\"") || &place != &kQuadricPlace);
      for (int axis = 0; axis < 3; ++axis) {
        EXPECT_LE(bounds.min[axis], points.min[axis] + Real(1e-6)) << quadric.text;
        EXPECT_GE(bounds.max[axis], points.max[axis] - Real(1e-6)) << quadric.text;
        if (!isTight || quadric.text.starts_with("\"cylinder\"")) continue;
        if (place.Matrix().m[0][1] != 0 && quadric.text.starts_with("\"disk\"")) continue;
        EXPECT_NEAR(double(bounds.min[axis]), double(points.min[axis]), .01) << quadric.text;
        EXPECT_NEAR(double(bounds.max[axis]), double(points.max[axis]), .01) << quadric.text;
      }
    }
  }
}

// Partial shapes have a box of zmin..zmax and +-radius.
TEST_F(QuadricFormulas, BoundPartsByTheirHeights) {
  const auto expectBox = [&](const char* text, const Bounds3& box) {
    const Bounds3 bounds = Make(text)->Bounds();
    EXPECT_LT(Distance(bounds.min, box.min) + Distance(bounds.max, box.max), Real(1e-5)) << text;
  };
  expectBox(R"("sphere" "float radius" 2 "float zmin" -1.5 "float zmax" .5)",
            {{-2, -2, Real(-1.5)}, {2, 2, Real(.5)}});
  expectBox(R"("cylinder" "float radius" 2 "float zmin" -1.5 "float zmax" .5)",
            {{-2, -2, Real(-1.5)}, {2, 2, Real(.5)}});
  expectBox(R"("disk" "float radius" 2 "float height" .5)", {{-2, -2, Real(.5)}, {2, 2, Real(.5)}});
}

// The density of directions with a uniform density on the area.
double ByArea(const Vec3d& ref, const SurfacePoint& on, double area) {
  const Vec3d between = Vec3d(on.p) - ref;
  const double d2 = Dot(between, between);
  return d2 * std::sqrt(d2) / (area * std::abs(Dot(between, Vec3d(on.ng))));
}

// Expects the step from a reference to a sample of a whole sphere of radius 2 that is seen from
// outside, where u chose the sample. Returns the density of directions.
double ExpectCone(double distance, const Vec3d& axis, Point2 u, const Vec3d& step) {
  const Vec3d w = NormalizeOrZero(step);
  const double cosMax = std::sqrt(1 - 4 / (distance * distance)), cosine = Dot(w, axis);
  EXPECT_NEAR((1 - cosine) / (1 - cosMax), double(u.x), 2e-3);
  // The nearer of the two points in this direction.
  const double b = distance * cosine;
  EXPECT_NEAR(Length(step), b - std::sqrt(std::max(b * b - distance * distance + 4, 0.)), 5e-3);
  const Frame frame = Frame::FromZ(axis.ToReal());
  if (u.x > Real(.01) && u.x < Real(.99)) {
    const double phi = std::atan2(Dot(w, Vec3d(frame.y)), Dot(w, Vec3d(frame.x)));
    EXPECT_NEAR(std::cos(phi - 2 * M_PI * double(u.y)), 1, 1e-4);
  }
  return 1 / (2 * M_PI * (1 - cosMax));
}

TEST_F(QuadricFormulas, GiveSamplesOfDirections) {
  RandomStream random(5);
  const Transform similar = Transform::Translate({1, -2, 3}) * *Transform::Rotate(35, {1, 2, -1}) *
                            *Transform::Scale(2, 2, 2);
  const Vec3d center(1, -2, 3);
  for (const Quadric& quadric : Quadrics()) {
    const bool isWhole = quadric.text == "\"sphere\" ";
    const auto shape = Make(quadric.text, similar);
    SCOPED_TRACE(quadric.text);
    for (int i = 0; i < 120; ++i) {
      SurfacePoint ref;
      // Outside, inside, and (a whole sphere's radius is 2) just outside.
      const double distance = i % 3 == 0   ? 2.5 + 4 * double(random.Uniform())
                              : i % 3 == 1 ? 1.5 * double(random.Uniform())
                                           : 2 + 2e-7;
      const Vec3d away = NormalizeOrZero(Vec3d(RandomVector(random)));
      ref.p = (center + away * distance).ToReal();
      ref.time = Real(.25);
      const Point2 u(random.Uniform(), random.Uniform());
      const auto sample = shape->SampleToward(ref, u, 0);
      if (!sample) continue;
      const Vec3d from(ref.p), w = NormalizeOrZero(Vec3d(sample->point.p) - from);
      double pdf = ByArea(from, sample->point, 4 * quadric.area);
      if (isWhole && i % 3 == 0) {
        pdf = ExpectCone(distance, away * -1, u, Vec3d(sample->point.p) - from);
      } else if (isWhole && i % 3 == 1) {
        pdf = 1 / (4 * M_PI);
        ExpectNear(w.ToReal(), Vec3d(SampleUniformSphere(u)), 1e-4, "direction");
        EXPECT_NEAR(Length(Vec3d(sample->point.p) - center), 2, 1e-4);
      }
      if (isWhole && i % 3 == 2) continue;  // rounding decides
      EXPECT_NEAR(double(sample->pdf) / pdf, 1, 2e-3) << i;
      const Real same = shape->PdfToward(ref, w.ToReal(), sample->point);
      EXPECT_NEAR(double(same / sample->pdf), 1, 2e-3) << i;
      if (HasFailure()) FAIL() << i;
    }
  }
}

// On the surface and very close to it, the cone would be a half-space; points are sampled by area.
TEST_F(QuadricFormulas, SampleANearSphereByArea) {
  const auto sphere = Make(R"("sphere" "float radius" 2)");
  SurfacePoint ref;
  for (const Real z : {Real(2), Real(2.0000005), Real(1.9995)}) {
    ref.p = {0, 0, z};
    const auto sample = sphere->SampleToward(ref, {Real(.3), Real(.7)}, 0);
    ASSERT_TRUE(sample);
    EXPECT_EQ(sample->point.p, sphere->SamplePoint({Real(.3), Real(.7)}, 0, 0).point.p);
    const double pdf = ByArea(Vec3d(ref.p), sample->point, 16 * M_PI);
    EXPECT_NEAR(double(sample->pdf) / pdf, 1, 1e-4);
    EXPECT_NEAR(double(sphere->PdfToward(ref, {}, sample->point)) / pdf, 1, 1e-4);
  }
  // 1 % away it is a cone, 1 % inside all directions.
  ref.p = {0, 0, Real(2.02)};
  const double cosMax = std::sqrt(1 - 1 / (1.01 * 1.01));
  EXPECT_NEAR(double(sphere->PdfToward(ref, {0, 0, -1}, {})), 1 / (2 * M_PI * (1 - cosMax)), 1e-3);
  ref.p = {0, 0, Real(1.98)};
  EXPECT_NEAR(double(sphere->PdfToward(ref, {0, 0, -1}, {})), 1 / (4 * M_PI), 1e-6);
}

}  // namespace
}  // namespace exphoton
