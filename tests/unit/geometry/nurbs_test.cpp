// SPDX-License-Identifier: BSD-2-Clause
// These tests check NURBS surfaces and height fields: basis functions by their identities, rational
// circles, Bezier patches by Bernstein polynomials, and the meshes that the shapes make.
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <sstream>

#include "shapes/mesh/nurbs_surface.h"
#include "tests/support/test_plugin.h"

namespace exphoton {
namespace {

std::unique_ptr<TriangleMesh> MakeNurbs(TestPlugins& plugins, const std::string& text) {
  return std::move(std::get<std::unique_ptr<TriangleMesh>>(plugins.MakeShape(text)));
}

// A tube of radius 1 and height 2 about z. The circle consists of four rational quarters.
const char* const kTube =
    R"("nurbs" "integer nu" 9 "integer nv" 2 "integer uorder" 3 "integer vorder" 2
    "float uknots" [0 0 0 1 1 2 2 3 3 4 4 4] "float vknots" [0 0 1 1] "float Pw" [
    1 0 0 1  .70710678 .70710678 0 .70710678  0 1 0 1  -.70710678 .70710678 0 .70710678
    -1 0 0 1  -.70710678 -.70710678 0 .70710678  0 -1 0 1  .70710678 -.70710678 0 .70710678
    1 0 0 1
    1 0 2 1  .70710678 .70710678 1.41421356 .70710678  0 1 2 1
    -.70710678 .70710678 1.41421356 .70710678  -1 0 2 1
    -.70710678 -.70710678 1.41421356 .70710678  0 -1 2 1
    .70710678 -.70710678 1.41421356 .70710678  1 0 2 1] )";

TEST(NurbsBasis, SumsToOneWithSlopesByDifferences) {
  const NurbsBasis basis{4, {-1, 0, 0, .5, 1, 1, 1, 2.5, 3, 4, 4}};
  std::vector<double> values, slopes, above, below, unused;
  for (int i = 0; i <= 200; ++i) {
    const double t = basis.First() + (basis.Last() - basis.First()) * i / 200;
    basis.Evaluate(t, &values, &slopes);
    EXPECT_NEAR(std::accumulate(values.begin(), values.end(), 0.), 1, 1e-14);
    EXPECT_NEAR(std::accumulate(slopes.begin(), slopes.end(), 0.), 0, 1e-12);
    for (const double value : values) EXPECT_GE(value, 0);
    const double step = 1e-6;
    if (i == 0 || i == 200) continue;
    const int first = basis.Evaluate(t - step, &below, &unused);
    if (basis.Evaluate(t + step, &above, &unused) != first) continue;  // across a knot
    for (std::size_t k = 0; k < slopes.size(); ++k)
      EXPECT_NEAR(slopes[k], (above[k] - below[k]) / (2 * step), 1e-5) << t;
  }
}

TEST(NurbsBasis, IsExactAtItsEnds) {
  const NurbsBasis basis{3, {0, 0, 0, .3, .7, .7, .7}};
  std::vector<double> values, slopes;
  EXPECT_EQ(basis.Evaluate(0, &values, &slopes), 0);
  EXPECT_EQ(values, (std::vector<double>{1, 0, 0}));
  EXPECT_EQ(basis.Evaluate(.7, &values, &slopes), 1);
  EXPECT_EQ(values, (std::vector<double>{0, 0, 1}));
}

TEST(NurbsBasis, SubdividesBetweenItsKnots) {
  using Parameters = std::vector<NurbsParameter>;
  const NurbsBasis basis{3, {0, 0, 0, 1, 4, 4, 4}};
  EXPECT_EQ(basis.Subdivide(0, 4, 5, 2), (Parameters{0., 1. / 3, 2. / 3, 1., 2., 3., {4, true}}));
  EXPECT_EQ(basis.Subdivide(.5, 3, 1, 2), (Parameters{.5, .75, 1., 2., 3.}));
}

TEST(NurbsBasis, HasACreaseWhereItsSlopesMayJump) {
  using Parameters = std::vector<NurbsParameter>;
  const NurbsBasis basis{3, {0, 0, 0, 1, 1, 4, 4, 4}};
  EXPECT_EQ(basis.Subdivide(0, 4, 1, 2), (Parameters{0., .5, {1, true}, 1., 2.5, {4, true}}));
  EXPECT_EQ(basis.Subdivide(0, 1, 1, 2), (Parameters{0., .5, {1, true}}));
  EXPECT_EQ(basis.Subdivide(1, 3, 1, 2), (Parameters{1., 2., 3.}));
  std::vector<double> values, slopes;
  EXPECT_EQ(basis.Evaluate({1, true}, &values, &slopes), 0);
  EXPECT_EQ(values, (std::vector<double>{0, 0, 1}));
  EXPECT_EQ(slopes, (std::vector<double>{0, -2, 2}));
  EXPECT_EQ(basis.Evaluate(1, &values, &slopes), 2);
  EXPECT_EQ(values, (std::vector<double>{1, 0, 0}));
}

TEST(NurbsSurface, OfOneSpanIsABezierPatch) {
  NurbsSurface surface{{4, {0, 0, 0, 0, 1, 1, 1, 1}}, {3, {0, 0, 0, 1, 1, 1}}, {}};
  const auto height = [](int i, int j) { return std::sin(3. * i + 5 * j); };
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 4; ++i) surface.controls.push_back({{i / 3., j / 2., height(i, j)}, 1});
  for (const double s : {0., .2, .9, 1.}) {
    for (const double t : {0., .4, 1.}) {
      const double bs[] = {std::pow(1 - s, 3), 3 * s * std::pow(1 - s, 2), 3 * s * s * (1 - s),
                           s * s * s};
      const double bt[] = {(1 - t) * (1 - t), 2 * t * (1 - t), t * t};
      double z = 0;
      for (int j = 0; j < 3; ++j)
        for (int i = 0; i < 4; ++i) z += bs[i] * bt[j] * height(i, j);
      const NurbsPoint point = surface.At(s, t);
      EXPECT_NEAR(point.p.x, s, 1e-14);
      EXPECT_NEAR(point.p.y, t, 1e-14);
      EXPECT_NEAR(point.p.z, z, 1e-13);
      EXPECT_NEAR(Length(point.normal), 1, 1e-12);
    }
  }
}

TEST(Nurbs, MakesAnExactTube) {
  TestPlugins plugins;
  const auto mesh = MakeNurbs(plugins, kTube);
  ASSERT_EQ(mesh->p.size(), mesh->n.size());
  double area = 0;
  for (std::size_t i = 0; i < mesh->p.size(); ++i) {
    const Point3& p = mesh->p[i];
    EXPECT_NEAR(std::hypot(p.x, p.y), 1, 1e-6);
    EXPECT_NEAR(Dot(mesh->n[i], Normal3(p.x, p.y, 0)), 1, 1e-6);
  }
  for (const auto& [a, b, c] : mesh->indices) {
    const Vec3d across = Cross(Vec3d(mesh->p[b] - mesh->p[a]), Vec3d(mesh->p[c] - mesh->p[a]));
    EXPECT_GT(Dot(across, Vec3d(mesh->n[a])), 0);
    area += Length(across) / 2;
  }
  EXPECT_NEAR(area / (4 * M_PI), 1, .005);
  // The texture coordinates are the parameters, and the seam closes without a gap.
  EXPECT_EQ(mesh->uv.front(), Point2(0, 0));
  EXPECT_EQ(mesh->uv.back(), Point2(4, 1));
  EXPECT_EQ(mesh->uv[1], Point2(Real(.125), 0));
  // Three knots within the circle are double, and so are their vertices.
  for (std::size_t row = 0; row < 31; ++row) EXPECT_EQ(mesh->p[row * 36], mesh->p[row * 36 + 35]);
}

// Returns a quarter of the upper half of a sphere of radius 1. Its first row is the pole, or its
// last one.
std::string Dome(const Vec3d& center, bool endsAtPole) {
  const double half = std::sqrt(.5), w[] = {1, half, 1}, up[] = {1, 1, 0}, out[] = {0, 1, 1};
  std::ostringstream text;
  text.precision(9);
  text << R"("nurbs" "integer nu" 3 "integer nv" 3 "integer uorder" 3 "integer vorder" 3
             "float uknots" [0 0 0 1 1 1] "float vknots" [0 0 0 1 1 1] "float Pw" [)";
  for (int row = 0; row < 3; ++row) {
    const int j = endsAtPole ? 2 - row : row;
    for (int i = 0; i < 3; ++i) {
      const Vec3d p = (center + Vec3d(out[j] * up[i], out[j] * out[i], up[j])) * (w[i] * w[j]);
      text << p.x << ' ' << p.y << ' ' << p.z << ' ' << w[i] * w[j] << "  ";
    }
  }
  return text.str() + "]";
}

// The positions of a pole's control points are rounded, so their differences are not exactly 0.
TEST(Nurbs, HasTheNormalOfThePoleAtEachOfItsVertices) {
  for (const Vec3d& pole :
       {Vec3d(0, 0, 1), Vec3d(1, 2, 3), Vec3d(.1, .2, .3), Vec3d(-7, .3, 11), Vec3d(50, 70, 90)}) {
    for (const bool endsAtPole : {false, true}) {
      TestPlugins plugins;
      const Vec3d center = pole - Vec3d(0, 0, 1);
      const auto mesh = MakeNurbs(plugins, Dome(center, endsAtPole));
      for (const std::string& message : plugins.GetLog().Messages())
        EXPECT_EQ(message.find("normals"), std::string::npos) << message;
      ASSERT_EQ(mesh->n.size(), 31u * 31u);
      for (std::size_t i = 0; i < mesh->n.size(); ++i) {
        const Vec3d outside = Vec3d(mesh->p[i]) - center;
        EXPECT_GT(Dot(Vec3d(mesh->n[i]), outside * (endsAtPole ? 1. : -1.)), .9999)
            << pole.x << ' ' << endsAtPole << ' ' << i;
      }
    }
  }
}

// A disk of one patch: at its four corners, both derivatives point along the rim.
TEST(Nurbs, HasTheNormalOfADiskAtItsCorners) {
  const double half = std::sqrt(.5), w[] = {1, half, 1, half, 1, half, 1, half, 1};
  const double x[] = {-half, 0, half, -1, 0, 1, -half, 0, half};
  const double y[] = {-half, -1, -half, 0, 0, 0, half, 1, half};
  std::ostringstream text;
  text.precision(9);
  text << R"("nurbs" "integer nu" 3 "integer nv" 3 "integer uorder" 3 "integer vorder" 3
             "float uknots" [0 0 0 1 1 1] "float vknots" [0 0 0 1 1 1] "float Pw" [)";
  for (int i = 0; i < 9; ++i)
    text << x[i] + w[i] * .1 << ' ' << y[i] + w[i] * .2 << ' ' << w[i] * .3 << ' ' << w[i] << "  ";
  TestPlugins plugins;
  const auto mesh = MakeNurbs(plugins, text.str() + "]");
  for (std::size_t i = 0; i < mesh->n.size(); ++i) {
    EXPECT_GT(mesh->n[i].z, Real(.9999)) << i;
    EXPECT_LT(Length(Vec3d(mesh->p[i]) - Vec3d(.1, .2, .3)), 1 + 1e-5) << i;
  }
}

// A roof of order 2: each side is flat up to its ridge.
TEST(Nurbs, HasTheNormalsOfBothSidesAtACrease) {
  const std::string knots = "[0 0 1 2 2]", ends = "[0 0 1 1]";
  const std::string alongU = R"("integer nu" 3 "integer nv" 2 "float uknots" )" + knots +
                             R"( "float vknots" )" + ends +
                             R"( "point P" [-1 0 0  0 0 1  1 0 0  -1 1 0  0 1 1  1 1 0] )";
  const std::string alongV = R"("integer nu" 2 "integer nv" 3 "float uknots" )" + ends +
                             R"( "float vknots" )" + knots +
                             R"( "point P" [-1 0 0  -1 1 0  0 0 1  0 1 1  1 0 0  1 1 0] )";
  const std::string left = R"("float u1" 1 )";
  for (const std::string& text : {alongU, alongV, alongU + left}) {
    TestPlugins plugins;
    const auto mesh =
        MakeNurbs(plugins, R"("nurbs" "integer uorder" 2 "integer vorder" 2 )" + text);
    double area = 0;
    for (const auto& v : mesh->indices) {
      const Vec3d across =
          Cross(Vec3d(mesh->p[v[1]] - mesh->p[v[0]]), Vec3d(mesh->p[v[2]] - mesh->p[v[0]]));
      area += Length(across) / 2;
      for (const std::uint32_t i : v)
        EXPECT_GT(Dot(Vec3d(mesh->n[i]), NormalizeOrZero(across)), .9999) << text << i;
    }
    EXPECT_NEAR(area, std::sqrt(2.) * (text == alongU + left ? 1 : 2), 1e-5);
    EXPECT_TRUE(plugins.GetLog().Messages().empty());
  }
}

TEST(Nurbs, ThatNeedsMoreMemoryThanThereIsIsRefusedBeforeItBegins) {
  const int count = 80000;
  std::string text = R"("nurbs" "integer nv" 2 "integer uorder" 2 "integer vorder" 2
                        "float vknots" [0 0 1 1] "integer nu" )" +
                     std::to_string(count);
  text += " \"float uknots\" [0";
  for (int i = 0; i < count; ++i) text += ' ' + std::to_string(i);
  text += ' ' + std::to_string(count - 1) + "] \"point P\" [";
  for (int i = 0; i < 2 * count; ++i) text += "0 0 0 ";
  const std::string problem = RefusalForMemory(text + "]", 1024);
  EXPECT_NE(problem.find("a surface of 80000 x 2 control points needs about "), std::string::npos)
      << problem;
  EXPECT_NE(problem.find("and this process may use 1024 MB"), std::string::npos) << problem;
}

TEST(Nurbs, MakesPartOfTheSurface) {
  TestPlugins plugins;
  const auto mesh =
      MakeNurbs(plugins, kTube + std::string(R"("float u0" 1 "float u1" 2 "float v0" .5)"));
  EXPECT_NEAR(mesh->p.front().y, 1, 1e-6);
  EXPECT_NEAR(mesh->p.front().z, 1, 1e-6);
  EXPECT_NEAR(mesh->p.back().x, -1, 1e-6);
  EXPECT_NEAR(mesh->p.back().z, 2, 1e-6);
}

TEST(Nurbs, RefusesWrongCountsAndKnots) {
  TestPlugins plugins;
  const std::string counts =
      R"("nurbs" "integer nu" 2 "integer nv" 2 "integer uorder" 2 "integer vorder" 2 )";
  const std::string knots = R"("float uknots" [0 0 1 1] "float vknots" [0 0 1 1] )";
  const std::string points = R"("point P" [0 0 0  1 0 0  0 1 0  1 1 0] )";
  EXPECT_NO_THROW(MakeNurbs(plugins, counts + knots + points));
  for (const std::string& text :
       {counts + knots, counts + knots + R"("point P" [0 0 0])",
        counts + knots + points + R"("float Pw" [0 0 0 1  1 0 0 1  0 1 0 1  1 1 0 1])",
        counts + knots + R"("float Pw" [0 0 0 1  1 0 0 1  0 1 0 0  1 1 0 1])",
        counts + R"("float uknots" [0 0 1] "float vknots" [0 0 1 1] )" + points,
        counts + R"("float uknots" [0 1 0 1] "float vknots" [0 0 1 1] )" + points,
        counts + R"("float uknots" [0 1 1 2] "float vknots" [0 0 1 1] )" + points,
        counts + knots + points + R"("float u0" -.1)",
        counts + knots + points + R"("float v1" 1.1)",
        counts + knots + points + R"("float u0" .5 "float u1" .5)",
        R"("nurbs" "integer nu" 2 "integer nv" 2 "integer uorder" 3 "integer vorder" 2 )" +
            std::string(R"("float uknots" [0 0 0 1 1] "float vknots" [0 0 1 1] )") + points}) {
    EXPECT_THROW(MakeNurbs(plugins, text), Error) << text;
  }
}

TEST(Heightfield, SpansTheUnitSquare) {
  TestPlugins plugins;
  const auto mesh = MakeNurbs(
      plugins, R"("heightfield" "integer nu" 3 "integer nv" 2 "float Pz" [0 1 2  3 4 5])");
  ASSERT_EQ(mesh->p.size(), 6u);
  EXPECT_EQ(mesh->p[1], Point3(Real(.5), 0, 1));
  EXPECT_EQ(mesh->p[5], Point3(1, 1, 5));
  EXPECT_EQ(mesh->uv[4], Point2(Real(.5), 1));
  EXPECT_EQ(mesh->TriangleCount(), 4u);
  // Normals point to +z, and the diagonal of each cell runs from its lowest to its highest corner.
  for (const auto& [a, b, c] : mesh->indices) {
    EXPECT_GT(Cross(mesh->p[b] - mesh->p[a], mesh->p[c] - mesh->p[a]).z, 0);
    EXPECT_EQ(a + 4, std::max(b, c));
  }
  for (const char* text : {R"("heightfield" "integer nu" 3 "integer nv" 2 "float Pz" [0 1 2])",
                           R"("heightfield" "integer nu" 1 "integer nv" 2 "float Pz" [0 1])",
                           R"("heightfield" "integer nu" 2 "integer nv" 2)"})
    EXPECT_THROW(MakeNurbs(plugins, text), Error) << text;
}

}  // namespace
}  // namespace exphoton
