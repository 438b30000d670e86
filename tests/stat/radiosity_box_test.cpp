// SPDX-License-Identifier: BSD-2-Clause
// These tests compare a closed box with six reflectances and a square lamp with an independent
// radiosity solution. The solution uses patches and Lambert's form factors for polygons, in
// double precision and without the renderer's code. Each rendered picture shows one whole wall
// without perspective.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "tests/support/equivalence.h"
#include "tests/support/test_scene.h"

namespace exphoton {
namespace {

using V = std::array<double, 3>;

V Minus(const V& a, const V& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
double DotOf(const V& a, const V& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
V CrossOf(const V& a, const V& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

// Wall w of the unit cube is the plane where axis w / 2 is 0 (w even) or 1 (w odd). The coordinates
// (s, t) run over the other two axes.
struct Wall {
  double albedo;
  V At(int w, double s, double t) const {
    V p{};
    p[std::size_t(w / 2)] = w % 2;
    p[std::size_t((w / 2 + 1) % 3)] = s;
    p[std::size_t((w / 2 + 2) % 3)] = t;
    return p;
  }
};
constexpr std::array<Wall, 6> kWalls{{{.3}, {.6}, {.7}, {.8}, {.4}, {.5}}};  // x, y, z: 0 and 1
constexpr int kCeiling = 3;
constexpr double kLampRadiosity = 10;
constexpr double kPi64 = 3.14159265358979323846;

// Returns the fraction of the light from a point with this normal that meets the polygon. The
// polygon must lie entirely in front of the point.
double FormFactor(const V& from, const V& normal, const std::array<V, 4>& corners) {
  double sum = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    const V a = Minus(corners[i], from), b = Minus(corners[(i + 1) % 4], from);
    const V cross = CrossOf(a, b);
    const double sine = std::sqrt(DotOf(cross, cross));
    if (sine < 1e-14) continue;
    sum += std::atan2(sine, DotOf(a, b)) * DotOf(cross, normal) / sine;
  }
  return std::abs(sum) / (2 * kPi64);
}

// Returns the mean radiosity of each wall from n x n patches per wall. The lamp is the middle
// quarter of the ceiling and reflects nothing.
std::array<double, 6> Radiosity(int n) {
  const auto isLamp = [&](int w, int s, int t) {
    return w == kCeiling && s >= n / 4 && s < 3 * n / 4 && t >= n / 4 && t < 3 * n / 4;
  };
  const auto index = [&](int w, int s, int t) { return std::size_t((w * n + s) * n + t); };
  const std::size_t count = std::size_t(6 * n * n);
  std::vector<float> factor(count * count, 0);
  std::vector<double> emitted(count, 0), reflectance(count, 0);
  for (int w = 0; w < 6; ++w) {
    V normal{};
    normal[std::size_t(w / 2)] = w % 2 ? -1 : 1;
    for (int i = 0; i < n * n; ++i) {
      const int s = i / n, t = i % n;
      const V centre = kWalls[0].At(w, (s + .5) / n, (t + .5) / n);
      emitted[index(w, s, t)] = isLamp(w, s, t) ? kLampRadiosity : 0;
      reflectance[index(w, s, t)] = isLamp(w, s, t) ? 0 : kWalls[std::size_t(w)].albedo;
      for (int other = 0; other < 6; ++other) {
        if (other == w) continue;
        for (int j = 0; j < n * n; ++j) {
          const double s0 = double(j / n) / n, t0 = double(j % n) / n, h = 1.0 / n;
          factor[index(w, s, t) * count + index(other, j / n, j % n)] = float(
              FormFactor(centre, normal,
                         {kWalls[0].At(other, s0, t0), kWalls[0].At(other, s0 + h, t0),
                          kWalls[0].At(other, s0 + h, t0 + h), kWalls[0].At(other, s0, t0 + h)}));
        }
      }
    }
  }
  std::vector<double> radiosity = emitted;
  for (int bounce = 0; bounce < 40; ++bounce) {
    std::vector<double> next = emitted;
    for (std::size_t i = 0; i < count; ++i) {
      double sum = 0;
      for (std::size_t j = 0; j < count; ++j) sum += double(factor[i * count + j]) * radiosity[j];
      next[i] += reflectance[i] * sum;
    }
    radiosity = next;
  }
  std::array<double, 6> means{};
  for (std::size_t i = 0; i < count; ++i)
    means[i / std::size_t(n * n)] += radiosity[i] / double(n * n);
  return means;
}

std::string Quad(const std::array<V, 4>& p) {
  std::string text = "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] \"point P\" [";
  for (const V& v : p)
    for (const double x : v) text += std::to_string(x) + " ";
  return text + "]\n";
}

std::string BoxWorld() {
  std::string world = "WorldBegin\n";
  for (int w = 0; w < 6; ++w) {
    const std::string albedo = std::to_string(kWalls[std::size_t(w)].albedo);
    world += "Material \"matte\" \"color Kd\" [" + albedo + " " + albedo + " " + albedo + "]\n";
    const auto piece = [&](double s0, double s1, double t0, double t1) {
      const Wall& wall = kWalls[0];
      world +=
          Quad({wall.At(w, s0, t0), wall.At(w, s1, t0), wall.At(w, s1, t1), wall.At(w, s0, t1)});
    };
    if (w != kCeiling) {
      piece(0, 1, 0, 1);
      continue;
    }
    piece(0, .25, 0, 1), piece(.75, 1, 0, 1), piece(.25, .75, 0, .25), piece(.25, .75, .75, 1);
    const std::string radiance = std::to_string(kLampRadiosity / kPi64);
    world +=
        "AttributeBegin\nMaterial \"matte\" \"color Kd\" [0 0 0]\nReverseOrientation\n"
        "AreaLightSource \"area\" \"color L\" [" +
        radiance + " " + radiance + " " + radiance + "]\n";
    piece(.25, .75, .25, .75);
    world += "AttributeEnd\n";
  }
  return world + "WorldEnd\n";
}

// The camera is at the centre and sees exactly the wall.
std::string WallView(const std::string& integrator, int wall, int samples) {
  std::array<std::string, 3> target{".5", ".5", ".5"};
  target[std::size_t(wall / 2)] = wall % 2 ? "1" : "0";
  const std::string up = wall / 2 == 1 ? "0 0 1" : "0 1 0";
  return "SurfaceIntegrator " + integrator +
         "\nFilm \"image\" \"integer xresolution\" [8] \"integer yresolution\" [8]\n"
         "PixelFilter \"box\"\nSampler \"lowdiscrepancy\" \"integer pixelsamples\" [" +
         std::to_string(samples) + "]\nLookAt .5 .5 .5 " + target[0] + " " + target[1] + " " +
         target[2] + " " + up +
         "\nCamera \"orthographic\" \"float screenwindow\" [-.5 .5 -.5 .5]\n" + BoxWorld();
}

struct View {
  const char* integrator;
  int samples;
};

class RadiosityBox : public testing::TestWithParam<View> {};

// The test covers a side wall and the back wall. The tolerance is 2 %, as for every
// photon-mapped picture.
TEST_P(RadiosityBox, HasTheWallsOfTheRadiositySolution) {
  static const std::array<double, 6> truth = Radiosity(16);
  for (const int wall : {0, 5}) {
    const std::string scene = WallView(GetParam().integrator, wall, GetParam().samples);
    const auto estimate = EstimateOverSeeds([&](std::uint64_t seed) {
      TestRenderOptions options;
      options.seed = seed;
      return MeanRadiance(RenderSceneText(scene, options).image);
    });
    EXPECT_TRUE(IsWithin(.02, estimate, truth[std::size_t(wall)] / kPi64)) << "wall " << wall;
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, RadiosityBox,
    testing::Values(
        View{"\"path\" \"integer maxdepth\" [30]", 64},
        View{"\"bidirectional\" \"integer maxdepth\" [30]", 64},
        View{"\"irradiancecache\" \"integer maxindirectdepth\" 30 \"integer nsamples\" 1024", 16},
        View{"\"igi\" \"integer nlights\" 256 \"integer nsets\" 16 \"float mindist\" .01", 16},
        View{"\"exphotonmap\" \"integer indirectphotons\" [200000] \"integer finalgathersamples\" "
             "[8]",
             64},
        View{
            "\"photonmap\" \"integer indirectphotons\" [100000] \"integer finalgathersamples\" [8]",
            32}));

// Patches of half the size must change the solution by less than 1 %.
TEST(RadiosityBoxItself, Converges) {
  const auto coarse = Radiosity(8), fine = Radiosity(16);
  for (std::size_t w = 0; w < 6; ++w) EXPECT_NEAR(coarse[w] / fine[w], 1, .01) << w;
}

}  // namespace
}  // namespace exphoton
