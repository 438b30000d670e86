// SPDX-License-Identifier: BSD-2-Clause
// These tests check which lamps are tiny, and in which pixels. tests/stat/still_emitter_test.cpp
// checks their light.
#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <random>

#include "core/math/sampling/sampling.h"
#include "core/render/emitters/still_emitters.h"
#include "tests/support/test_scene.h"

namespace exphoton {
namespace {

StillEmitters StillIn(const LoadedScene& scene) {
  const RenderSetup& setup = *scene.setup;
  const Film film(setup.film.Full(), setup.crop);
  return StillEmitters({*setup.scene, *setup.camera, *setup.filter, film}, 0);
}

// Returns a row of lamps in one pixel.
std::string LampsInOnePixel(int count) {
  std::string world;
  for (int i = 0; i < count; ++i)
    world += "AttributeBegin AreaLightSource \"area\" \"color L\" [9 9 9]\nTranslate " +
             std::to_string(.05 + .01 * i) +
             " .05 2 Shape \"sphere\" \"float radius\" .004 AttributeEnd\n";
  return world;
}

TEST(TinyEmitters, LampsSmallerThanTheFilterAreTiny) {
  const Point2i pixel{12, 8};
  for (const int count : {1, 2, TinyEmitters::kMost, TinyEmitters::kMost + 1}) {
    const LoadedScene scene = LoadSceneText(
        "SurfaceIntegrator \"path\"\nPixelFilter \"box\"\nFilm \"image\" \"integer "
        "xresolution\" 24 \"integer yresolution\" 18\nWorldBegin\n" +
        LampsInOnePixel(count) + "WorldEnd\n");
    const StillEmitters emitters = StillIn(scene);
    const bool isCrowd = count > TinyEmitters::kMost;
    EXPECT_EQ(emitters.Tiny().In(pixel).size(), isCrowd ? 0u : unsigned(count));
    EXPECT_EQ(emitters.PlacesIn(pixel), isCrowd ? StillEmitters::kMostPlaces : 1);
  }
}

// A pixel meets the lamps that its filter meets, and no black ones.
TEST(TinyEmitters, NeighboursOfAPixelAreNoCrowd) {
  std::string world;
  for (int i = 0; i < 81; ++i)  // one in each of 9 x 9 pixels; the screen is 1 high at z = 1
    world += "AttributeBegin AreaLightSource \"area\" \"color L\" [9 9 9] Translate " +
             std::to_string((i % 9 - 4) / 9.) + " " + std::to_string((i / 9 - 4) / 9.) +
             " 1 Shape \"sphere\" \"float radius\" .004 AttributeEnd\n";
  world +=
      "AttributeBegin AreaLightSource \"area\" \"color L\" [0 0 0] Translate 0 0 .9 Shape "
      "\"sphere\" \"float radius\" .004 AttributeEnd\n";
  const LoadedScene scene = LoadSceneText(
      "SurfaceIntegrator \"path\"\nPixelFilter \"box\"\nCamera \"perspective\" \"float fov\" 90\n"
      "Film \"image\" \"integer xresolution\" 18 \"integer yresolution\" 18\nWorldBegin\n" +
      world + "WorldEnd\n");
  const StillEmitters emitters = StillIn(scene);
  int lamps = 0;
  for (int y = 0; y < 18; ++y) {
    for (int x = 0; x < 18; ++x) {
      EXPECT_EQ(emitters.PlacesIn({x, y}), 1);
      lamps += int(emitters.Tiny().In({x, y}).size());
    }
  }
  EXPECT_EQ(lamps, 4 * 81);  // each lies where four pixels meet
}

// Rays and boxes are rounded differently, far from the origin above all.
TEST(TinyEmitters, BoxesContainAllRaysToTheirLamps) {
  std::mt19937_64 random(7);
  const auto uniform = [&] { return double(random() >> 11) * 0x1p-53; };
  int boxes = 0, rays = 0;
  for (const double far : {0., 3., 100., 1000., 1e4, 1e5}) {
    for (const double fov : {90., 10., 1.}) {
      const std::string x = std::to_string(far + .3), ahead = std::to_string(far + 1.3);
      const double pixel = 2 * std::tan(fov * 3.14159 / 360) * 2 / 16, radius = .1 * pixel;
      const LoadedScene scene = LoadSceneText(
          "LookAt " + x + " .2 " + x + "  " + ahead + " .3 " + ahead +
          "  0 1 0\nSurfaceIntegrator \"path\"\nFilm \"image\" \"integer xresolution\" 16 "
          "\"integer yresolution\" 16\nPixelFilter \"box\"\nCamera \"perspective\" \"float fov\" " +
          std::to_string(fov) +
          "\nWorldBegin\nAreaLightSource \"area\" \"color L\" [9 9 9]\nTranslate " +
          std::to_string(far + 1.7) + " .339 " + std::to_string(far + 1.71) +
          " Shape \"sphere\" \"float radius\" " + std::to_string(radius) + "\nWorldEnd\n");
      const RenderSetup& setup = *scene.setup;
      const StillEmitters emitters = StillIn(scene);
      for (int y = 0; y < 16; ++y) {
        for (int column = 0; column < 16; ++column) {
          const auto met = emitters.Tiny().In({column, y});
          for (int i = 0; !met.empty() && i < 20000; ++i) {
            const FilmBox& box = emitters.Tiny()[met[0]].box;
            CameraSample sample;
            sample.film = box.Grown(.5).At({Real(uniform()), Real(uniform())});
            sample.lens = Point2(Real(.5), Real(.5));
            const RayDifferential ray = setup.camera->GenerateRay(sample, false);
            if (!emitters.FirstAlong(ray).lamp) continue;
            ++rays;
            EXPECT_TRUE(box.Contains(sample.film)) << far << " " << fov;
          }
          boxes += met.empty() ? 0 : 1;
        }
      }
    }
  }
  EXPECT_GT(boxes, 8);
  EXPECT_GT(rays, 5000);
}

// Returns whether all rays through a lens that meet its lamp lie in the lamp's box, in a pixel that
// knows the lamp. Counts them.
bool FindsRaysThroughTheLens(const std::string& camera, int* rays) {
  std::mt19937_64 random(8);
  const auto uniform = [&] { return Real(double(random() >> 11) * 0x1p-53); };
  const LoadedScene scene = LoadSceneText(
      "LookAt 3 .2 3  4 .3 4  0 1 0\nSurfaceIntegrator \"path\" PixelFilter \"box\"\n"
      "Film \"image\" \"integer xresolution\" 16 \"integer yresolution\" 16\nCamera " +
      camera +
      " \"float lensradius\" .1 \"float focaldistance\" .8\nWorldBegin\n"
      "AreaLightSource \"area\" \"color L\" [9 9 9]\n"
      "Translate 4.2 .339 4.21 Shape \"sphere\" \"float radius\" .03\nWorldEnd\n");
  const StillEmitters emitters = StillIn(scene);
  const std::optional<TinyEmitters::InPixel> lamp = [&]() -> std::optional<TinyEmitters::InPixel> {
    for (int y = 0; y < 16; ++y)
      for (int x = 0; x < 16; ++x)
        if (const auto met = emitters.Tiny().In({x, y}); !met.empty()) return met[0];
    return std::nullopt;
  }();
  if (!lamp) return false;
  bool areFound = true;
  for (int i = 0; i < 400000; ++i) {
    CameraSample sample;
    sample.lens = Point2(uniform(), uniform());
    sample.film = Point2(uniform() * 16, uniform() * 16);
    if (!emitters.FirstAlong(scene.setup->camera->GenerateRay(sample, false)).lamp) continue;
    ++*rays;
    const FilmBox box =
        emitters.Tiny().BoxIn(emitters.Tiny()[*lamp], sample.film, SampleDisk(sample.lens));
    const Point2i pixel{int(sample.film.x), int(sample.film.y)};
    areFound = areFound && box.Contains(sample.film) && !emitters.Tiny().In(pixel).empty();
  }
  return areFound;
}

TEST(TinyEmitters, BoxesContainAllRaysThroughTheLens) {
  const std::string window = " \"float screenwindow\" [1.2 -1 -1 1.1]";
  for (const std::string camera : {std::string("\"perspective\""), std::string("\"orthographic\""),
                                   "\"perspective\"" + window, "\"orthographic\"" + window}) {
    int rays = 0;
    EXPECT_TRUE(FindsRaysThroughTheLens(camera, &rays)) << camera;
    EXPECT_GT(rays, 50) << camera;
  }
}

// The mean over places needs weights that are not negative.
TEST(TinyEmitters, AreNotSoughtForFiltersWithNegativeValues) {
  for (const std::string filter :
       {"\"mitchell\" \"float xwidth\" 1 \"float ywidth\" 1", "\"box\""}) {
    const LoadedScene scene =
        LoadSceneText("SurfaceIntegrator \"path\"\nPixelFilter " + filter +
                      "\nFilm \"image\" \"integer xresolution\" 24 \"integer yresolution\" "
                      "18\nWorldBegin\n" +
                      LampsInOnePixel(1) + "WorldEnd\n");
    const StillEmitters emitters = StillIn(scene);
    EXPECT_EQ(emitters.Tiny().In({12, 8}).size(), filter == "\"box\"" ? 1u : 0u);
    EXPECT_EQ(emitters.PlacesIn({12, 8}), 1);
  }
}

}  // namespace
}  // namespace exphoton
