// SPDX-License-Identifier: BSD-2-Clause
// Fog outside a closed room is behind every surface, so it must not change a bit of any picture. It
// would where a ray is absorbed beyond its end. The same fog within the room must change all of
// them.
#include <gtest/gtest.h>

#include <string>

#include "tests/support/test_scene.h"

namespace exphoton {
namespace {

std::string Room(const std::string& fog) {
  return "WorldBegin\n" + fog + R"(
AttributeBegin AreaLightSource "area" "color L" [5 4 3] "integer nsamples" 1
Translate 0 1.5 1 Shape "sphere" "float radius" .3 AttributeEnd
AttributeBegin AreaLightSource "area" "color L" [1 2 3] "integer nsamples" 1
Translate 1 1.5 2 Shape "sphere" "float radius" .2 AttributeEnd
LightSource "point" "color I" [3 3 3] "point from" [1 -1 0]
AttributeBegin Material "mirror" Translate -1 0 1.5 Shape "sphere" "float radius" .4 AttributeEnd
AttributeBegin Material "glass" Translate 1 0 1.5 Shape "sphere" "float radius" .4 AttributeEnd
AttributeBegin Material "plastic" "color Ks" [.4 .4 .4] "float roughness" .05 Translate 0 -.5 2
Shape "sphere" "float radius" .5 AttributeEnd
Material "matte" "color Kd" [.6 .5 .4] ReverseOrientation Shape "sphere" "float radius" 3
WorldEnd
)";
}

std::string Fog(const std::string& from, const std::string& to) {
  return "Volume \"homogeneous\" \"color sigma_a\" [.9 .8 .7] \"point p0\" [" + from +
         "] \"point p1\" [" + to + "]";
}

class FogOutside : public testing::TestWithParam<const char*> {
 protected:
  static Image Render(const std::string& fog) {
    return RenderSceneText(TestHeader(GetParam(), 6, 6, 4) + Room(fog)).image;
  }
};

TEST_P(FogOutside, OfAClosedRoomChangesNothing) {
  const Image clear = Render("");
  // Four slabs around the room, which is a sphere of radius 3.
  std::string around;
  for (const char* side : {"-9 3.1 -9|9 9 9", "-9 -9 -9|9 -3.1 9", "-9 -9 3.1|9 9 9",
                           "3.1 -9 -9|9 9 9", "-9 -9 -9|-3.1 9 9", "-9 -9 -9|9 9 -3.1"}) {
    const std::string text = side;
    around += Fog(text.substr(0, text.find('|')), text.substr(text.find('|') + 1)) + "\n";
  }
  const Image outside = Render(around), inside = Render(Fog("-3 1 -3", "3 3 3"));
  int changed = 0;
  for (int y = 0; y < 6; ++y)
    for (int x = 0; x < 6; ++x)
      for (int c = 0; c < 4; ++c) {
        ASSERT_EQ(clear.At(x, y, c), outside.At(x, y, c)) << x << ", " << y;
        changed += clear.At(x, y, c) != inside.At(x, y, c);
      }
  EXPECT_GT(changed, 6 * 6);
  EXPECT_LT(MeanRadiance(inside), MeanRadiance(clear));
}

INSTANTIATE_TEST_SUITE_P(
    Integrators, FogOutside,
    testing::Values(
        "\"path\"", "\"whitted\"", "\"directlighting\"",
        "\"directlighting\" \"string strategy\" \"one\"",
        "\"directlighting\" \"string strategy\" \"near\"",
        "\"photonmap\" \"integer indirectphotons\" 500 \"integer causticphotons\" 200 "
        "\"integer directphotons\" 500 \"integer finalgathersamples\" 8",
        "\"exphotonmap\" \"integer indirectphotons\" 500 \"integer causticphotons\" 200 "
        "\"integer directphotons\" 500 \"integer finalgathersamples\" 8"));

}  // namespace
}  // namespace exphoton
