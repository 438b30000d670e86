// SPDX-License-Identifier: BSD-2-Clause
// These tests check what "irradiancecache" does beside matte surfaces that stand still: records of
// moving surfaces, leaves, fog between dark walls, and mirrors at the depth limit.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/equivalence.h"
#include "tests/support/test_scene.h"

namespace exphoton {
namespace {

TestRender RenderLight(const std::string& integrator, const std::string& world, int samples) {
  TestRenderOptions options;
  options.aovs = {Aov::Indirect};
  return RenderSceneText(
      TestHeader(integrator, 8, 8, samples) + "WorldBegin\n" + world + "\nWorldEnd\n", options);
}
double Indirect(const TestRender& render) { return MeanChannel(render.image, "indirect.G"); }

const std::string kFill =
    "LightSource \"point\" \"point from\" [.5 1.5 -1] \"color I\" [4 4 4]\nMaterial \"matte\" "
    "\"color Kd\" [.5 .5 .5]\nShape \"sphere\" \"float radius\" 4\n";

// The disk fills the picture at all times, and moves along its normal. Where its records are
// sought or stored in another place than at the start, each point takes rays of its own.
TEST(CachedLight, OfASurfaceThatMovesIsFoundOnIt) {
  const std::string cached =
      "\"irradiancecache\" \"integer nsamples\" 64 \"float maxpixelspacing\" 1000";
  const TestRender render =
      RenderLight(cached,
                  kFill +
                      "ActiveTransform EndTime Translate 0 0 -1 ActiveTransform "
                      "All\nTranslate 0 0 2 Shape \"disk\" \"float radius\" 3.4",
                  16);
  const double gathered = double(render.rays.counts[std::size_t(RayKind::Gather)]);
  EXPECT_LT(gathered, 1.05 * 64 * render.Counter("irradiance/records"));
}

// The two sides of the leaf scatter unlike shares.
TEST(CachedLight, OfALeafIsTransmittedByItsTransmittance) {
  const std::string leaf = kFill +
                           "Material \"translucent\" \"color Ks\" [0 0 0] \"color reflect\" [.1 .1 "
                           ".1] \"color transmit\" [.7 .7 .7]\nTranslate 0 0 .5 Shape \"disk\"";
  const double cached =
      Indirect(RenderLight("\"irradiancecache\" \"integer nsamples\" 1024", leaf, 4));
  const double traced = Indirect(RenderLight("\"path\" \"integer maxdepth\" 3", leaf, 1024));
  EXPECT_NEAR(cached / traced, 1, .05);
}

// Each bounce off a wall takes nine tenths of the light of the fog behind it.
TEST(CachedLight, OfFogBetweenDarkWallsIsThatOfPathTracing) {
  const std::string world =
      "Volume \"homogeneous\" \"point p0\" [-4 -4 -4] \"point p1\" [4 4 4] \"color Le\" [.2 .2 "
      ".2]\nMaterial \"matte\" \"color Kd\" [.1 .1 .1]\nShape \"sphere\" \"float radius\" 3";
  const double cached =
      Indirect(RenderLight("\"irradiancecache\" \"integer nsamples\" 256", world, 4));
  const double traced = Indirect(RenderLight("\"path\" \"integer maxdepth\" 3", world, 256));
  EXPECT_GT(traced, 0);
  EXPECT_NEAR(cached / traced, 1, .04);
}

// Every ray from the disk meets a mirror or the lamp itself, which is direct light.
TEST(CachedLight, HasNoMirrorAfterItsLastBounce) {
  const std::string world =
      "AttributeBegin Material \"mirror\" Shape \"sphere\" \"float radius\" 4 AttributeEnd\n"
      "AttributeBegin AreaLightSource \"area\" \"color L\" [5 5 5] Translate 0 2 0 Shape "
      "\"sphere\" \"float radius\" .7 AttributeEnd\nTranslate 0 0 1.5 Shape \"disk\"";
  const std::string cached =
      "\"irradiancecache\" \"integer nsamples\" 256 \"integer "
      "maxspeculardepth\" 0 \"integer maxindirectdepth\" ";
  EXPECT_EQ(Indirect(RenderLight(cached + "1", world, 4)), 0);
  EXPECT_GT(Indirect(RenderLight(cached + "2", world, 4)), 0);
}

}  // namespace
}  // namespace exphoton
