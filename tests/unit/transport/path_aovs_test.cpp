// SPDX-License-Identifier: BSD-2-Clause
// These tests check into which light AOV "path" puts the light of a path, by cutting paths: a path
// that is longer than the light of an AOV needs changes nothing there.
#include <gtest/gtest.h>

#include "tests/support/test_scene.h"

namespace exphoton {
namespace {

// A room with a lamp, two matte planes and one plane mirror, which no path meets twice in a row.
Image RenderRoom(int maxDepth) {
  const std::string integrator =
      "\"path\" \"integer maxdepth\" [ " + std::to_string(maxDepth) + " ]";
  const std::string square =
      R"( Shape "trianglemesh" "integer indices" [ 0 1 2 0 2 3 ]
          "point P" [ -2 -2 0  2 -2 0  2 2 0  -2 2 0 ])";
  TestRenderOptions options;
  options.aovs = kLightAovs;
  return RenderSceneText(TestHeader(integrator, 8, 8, 64) + R"(WorldBegin
      AttributeBegin
        AreaLightSource "area" "color L" [ 9 9 9 ]
        Translate 0 1.5 3 Rotate 90 1 0 0 Shape "disk" "float radius" [ .7 ]
      AttributeEnd
      Material "matte" "color Kd" [ .8 .8 .8 ]
      AttributeBegin Translate 0 0 5)" +
                             square + R"( AttributeEnd
      AttributeBegin Translate 0 -1 3 Rotate -90 1 0 0)" +
                             square + R"( AttributeEnd
      Material "mirror" "color Kr" [ .9 .9 .9 ]
      AttributeBegin Translate 2 0 3 Rotate 90 0 1 0)" +
                             square + R"( AttributeEnd
      WorldEnd
)",
                         options)
      .image;
}

void ExpectSameChannel(const Image& a, const Image& b, const std::string& channel) {
  const int c = a.FindChannel(channel);
  ASSERT_GE(c, 0) << channel;
  for (int y = 0; y < a.Height(); ++y)
    for (int x = 0; x < a.Width(); ++x)
      EXPECT_EQ(a.At(x, y, c), b.At(x, y, c)) << channel << " at " << x << ", " << y;
}

TEST(PathAovs, EachHoldsTheLightOfItsBouncesAndNoLongerPaths) {
  const Image none = RenderRoom(0), one = RenderRoom(1), two = RenderRoom(2), six = RenderRoom(6);
  EXPECT_GT(MeanChannel(one, "direct.G"), .1);
  EXPECT_GT(MeanChannel(two, "caustic.G"), .001);
  EXPECT_GT(MeanChannel(six, "indirect.G"), 1.05 * MeanChannel(two, "indirect.G"));
  ExpectSameChannel(none, six, "emission.G");
  ExpectSameChannel(one, six, "direct.G");
  // A caustic is light by way of the mirror and one matte surface.
  ExpectSameChannel(two, six, "caustic.G");
}

}  // namespace
}  // namespace exphoton
