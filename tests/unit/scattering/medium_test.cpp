// SPDX-License-Identifier: BSD-2-Clause
// These tests check media by themselves: densities at points, and optical depths along rays whose
// directions have any length.
#include "core/scattering/medium.h"

#include <gtest/gtest.h>

#include "core/math/sampling/random.h"
#include "tests/support/geometry_scenes.h"
#include "tests/support/test_scene.h"

namespace exphoton {
namespace {

// Returns a grid that has 40 cells of uneven densities along one axis ("nx") and one along others.
std::string LongGrid(const std::string& axis) {
  std::string text = "\"volumegrid\" \"integer " + axis + "\" 40 \"float density\" [";
  for (int i = 0; i < 40; ++i) text += std::to_string(1 + i * 7 % 10) + " ";
  return text + "]";
}

const std::string kMedia[] = {
    "\"homogeneous\"",
    "\"exponential\" \"float a\" 2 \"float b\" .7 \"vector updir\" [.3 .5 .8]",
    "\"volumegrid\" \"integer nx\" 2 \"integer ny\" 3 \"integer nz\" 4 \"float density\" [1 2 3 4 "
    "5 6 "
    "2 4 6 1 3 5  9 7 5 3 1 8  6 4 2 9 8 7]",
    LongGrid("nx"),
    LongGrid("ny"),
    LongGrid("nz")};

LoadedScene SceneOf(const std::string& medium) {
  return LoadSceneText("WorldBegin\nTranslate 1 2 3 Rotate 30 1 1 0 Scale 2 1 .5\nVolume " +
                       medium +
                       " \"point p0\" [-1 -2 -1] \"point p1\" [1 1 2] \"color sigma_a\" [1 1 1]\n"
                       "LightSource \"point\"\nWorldEnd\n");
}

// The expected value is the integral of the coefficient over the length, by the midpoint rule.
TEST(Medium, OpticalDepthIsTheIntegralOfItsDensityOverLength) {
  for (const std::string& text : kMedia) {
    const LoadedScene loaded = SceneOf(text);
    const Medium& medium = *loaded.setup->scene->Media().front();
    RandomStream random(2);
    int inside = 0;
    for (int i = 0; i < 60; ++i) {
      Ray ray;
      ray.o = medium.Bounds().Center() + RandomVector(random) * 3;
      ray.d = medium.Bounds().Center() + RandomVector(random) * Real(.5) - ray.o;
      ray.d = ray.d * std::exp2(Between(random, -3, 3));
      const auto part = medium.Overlap(ray);
      if (!part) continue;
      ++inside;
      const double length = double(Length(ray.d)) * (double(part->max) - double(part->min));
      constexpr int kSteps = 4000;
      double sum = 0;
      for (int k = 0; k < kSteps; ++k) {
        const Real t = part->min + (part->max - part->min) * (Real(k) + Real(.5)) / kSteps;
        sum += double(medium.At(ray(t)).absorption.g) * length / kSteps;
      }
      EXPECT_NEAR(double(medium.OpticalDepth(ray, {0, kInfinity}).g) / sum, 1, 2e-3) << text;
    }
    EXPECT_GT(inside, 30) << text;
  }
}

// A medium is empty if all coefficients or all densities are 0.
TEST(Medium, KnowsThatItIsEmpty) {
  const auto load = [](const std::string& medium) {
    return LoadSceneText("WorldBegin\nVolume " + medium +
                         "\nVolume \"homogeneous\" \"color sigma_a\" [1 1 1]\n"
                         "LightSource \"point\"\nWorldEnd\n");
  };
  const auto isEmpty = [&](const std::string& medium) {
    return load(medium).setup->scene->Media().front()->IsProvablyEmpty();
  };
  const std::string fog = " \"color sigma_a\" [1 1 1]";
  for (const std::string& medium : kMedia) {
    EXPECT_TRUE(isEmpty(medium)) << medium;
    for (const std::string coefficient : {"sigma_a", "sigma_s", "Le"})
      EXPECT_FALSE(isEmpty(medium + " \"color " + coefficient + "\" [0 1 0]")) << medium;
  }
  EXPECT_TRUE(isEmpty("\"exponential\" \"float a\" 0" + fog));
  EXPECT_FALSE(isEmpty("\"exponential\" \"float a\" 1" + fog));
  const std::string grid = "\"volumegrid\" \"integer nx\" 2 \"float density\" ";
  EXPECT_TRUE(isEmpty(grid + "[0 0]" + fog));
  EXPECT_FALSE(isEmpty(grid + "[0 1]" + fog));
}

// A grid lists its cells with x fastest, and each cell has its density at its centre.
TEST(VolumeGrid, HasTheDensityOfEachCellAtItsMiddle) {
  std::string densities;
  for (int i = 0; i < 24; ++i) densities += std::to_string(i + 1) + " ";
  const LoadedScene loaded = LoadSceneText(
      "WorldBegin\nVolume \"volumegrid\" \"integer nx\" 2 \"integer ny\" 3 \"integer nz\" 4 "
      "\"point p0\" [0 0 0] \"point p1\" [2 3 4] \"color sigma_a\" [1 1 1] \"float density\" [" +
      densities + "]\nLightSource \"point\"\nWorldEnd\n");
  const Medium& medium = *loaded.setup->scene->Media().front();
  for (int i = 0; i < 24; ++i) {
    const Point3 middle(Real(i % 2) + Real(.5), Real(i / 2 % 3) + Real(.5), Real(i / 6) + Real(.5));
    EXPECT_NEAR(double(medium.At(middle).absorption.g), i + 1, 1e-4);
  }
}

// The height is counted from the lower corner, in whatever order the corners are given.
TEST(Exponential, FallsWithTheHeightOverItsLowerCorner) {
  for (const char* corners : {"\"point p0\" [-1 -2 -3] \"point p1\" [4 3 2]",
                              "\"point p0\" [4 3 2] \"point p1\" [-1 -2 -3]"}) {
    const LoadedScene loaded = LoadSceneText(
        std::string("WorldBegin\nVolume \"exponential\" \"float a\" 2 \"float b\" .7 \"vector "
                    "updir\" [.3 .5 .8] \"color sigma_a\" [1 2 3] \"color sigma_s\" [4 5 6] "
                    "\"color Le\" [7 8 9] ") +
        corners + "\nLightSource \"point\"\nWorldEnd\n");
    const Medium& medium = *loaded.setup->scene->Media().front();
    RandomStream random(4);
    for (int i = 0; i < 20; ++i) {
      const double x = 5 * double(random.Uniform()), y = 5 * double(random.Uniform());
      const double z = 5 * double(random.Uniform());
      const MediumPoint at = medium.At({Real(x - 1), Real(y - 2), Real(z - 3)});
      const double density = 2 * std::exp(-.7 * (.3 * x + .5 * y + .8 * z));
      for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(double(at.absorption[c]), (1 + c) * density, 1e-4);
        EXPECT_NEAR(double(at.scattering[c]), (4 + c) * density, 1e-4);
        EXPECT_NEAR(double(at.emission[c]), (7 + c) * density, 1e-4);
      }
    }
    EXPECT_TRUE(medium.Emits() && medium.Scatters());
    EXPECT_EQ(medium.At({5, 0, 0}).absorption, Spectrum());
  }
}

// Straight down through 2000 scale heights, the optical depth is a / b.
TEST(Exponential, HasTheSameDepthInBothDirections) {
  const LoadedScene loaded = LoadSceneText(
      "WorldBegin\nVolume \"exponential\" \"color sigma_a\" [1 1 1] \"point p0\" [-50 0 -50] "
      "\"point p1\" [50 2000 50]\nLightSource \"point\"\nWorldEnd\n");
  const Medium& medium = *loaded.setup->scene->Media().front();
  for (const Real top : {Real(700), Real(730), Real(800), Real(1990)}) {
    Ray down, up;
    down.o = {0, top, 0}, down.d = {0, -1, 0}, up.d = {0, 1, 0}, up.tMax = top;
    EXPECT_NEAR(double(medium.OpticalDepth(down, {0, kInfinity}).g), 1, 1e-4) << top;
    EXPECT_NEAR(double(medium.OpticalDepth(up, {0, top}).g), 1, 1e-4) << top;
  }
}

// Fog that grows denser with height, as far as a float goes, has no value that is no number.
TEST(Exponential, IsFiniteWhereItsDensityIsNot) {
  for (const char* lowest : {"0", "1"}) {
    const LoadedScene loaded = LoadSceneText(
        "WorldBegin\nVolume \"exponential\" \"float b\" -1 \"color sigma_s\" [1 0 1] \"point p1\" "
        "[1 2000 1] \"float a\" " +
        std::string(lowest) +
        "\nVolume \"homogeneous\" \"color sigma_a\" [1 1 1]\n"  // which keeps media on
        "LightSource \"point\"\nWorldEnd\n");
    const Medium& medium = *loaded.setup->scene->Media().front();
    const MediumPoint at = medium.At({.5, 1500, .5});
    EXPECT_TRUE(at.absorption.IsBlack()) << lowest;
    EXPECT_TRUE(at.emission.IsBlack()) << lowest;
    EXPECT_TRUE(at.scattering.IsFinite()) << lowest;
    EXPECT_EQ(at.scattering.IsBlack(), *lowest == '0') << lowest;
    Ray down;
    down.o = {Real(.5), 1999, Real(.5)}, down.d = {0, -1, 0};
    const Spectrum depth = medium.OpticalDepth(down, {0, kInfinity});
    EXPECT_EQ(depth.IsBlack(), *lowest == '0') << lowest;
    EXPECT_EQ(depth.g, 0) << lowest;
  }
}

// A box far away has its own thickness, up to the rounding of the distance.
TEST(Medium, OfABoxFarAwayHasItsThickness) {
  const LoadedScene loaded = LoadSceneText(
      "WorldBegin\nVolume \"homogeneous\" \"color sigma_a\" [1 1 1] \"point p0\" [-50 -50 0] "
      "\"point p1\" [50 50 1]\nLightSource \"point\"\nWorldEnd\n");
  const Medium& medium = *loaded.setup->scene->Media().front();
  Ray ray;
  ray.o = {0, 0, Real(-65536)}, ray.d = {0, 0, 1};
  EXPECT_NEAR(double(medium.OpticalDepth(ray, {0, kInfinity}).g), 1, 1e-3);
}

}  // namespace
}  // namespace exphoton
