// SPDX-License-Identifier: BSD-2-Clause
// Fog beside something that moves: a plate is far away as the exposure may begin, and in place as
// it may end. Behind the plate no light may be left, to the last bit; without it there must be
// some.
#include <gtest/gtest.h>

#include "tests/support/test_scene.h"

namespace exphoton {
namespace {

// Far beside at time 0, and at time 1 where `place` puts it.
std::string Plate(const std::string& place) {
  return "AttributeBegin Translate 1000 0 0 ActiveTransform EndTime Translate -1000 0 0 "
         "ActiveTransform All " +
         place + " Shape \"disk\" \"float radius\" 50 AttributeEnd\n";
}
const std::string kFog = "\"color sigma_s\" [.5 .5 .5] \"color sigma_a\" [0 0 0]\n";

// The picture of a camera whose shutter is open at this moment only.
double MeanAt(int time, const std::string& view, const std::string& integrator,
              const std::string& world) {
  const std::string moment = std::to_string(time);
  return MeanRadiance(
      RenderSceneText(view +
                      "Camera \"orthographic\" \"float screenwindow\" [-.2 .2 -.2 .2] \"float "
                      "shutteropen\" " +
                      moment + " \"float shutterclose\" " + moment +
                      "\nFilm \"image\" \"integer xresolution\" 4 \"integer yresolution\" 4\n"
                      "SurfaceIntegrator " +
                      integrator +
                      "\nVolumeIntegrator \"single\" \"float stepsize\" .2\nWorldBegin\n" + world +
                      "WorldEnd\n")
          .image);
}

// Sun from above, and a plate that covers the fog: what the camera sees of the fog is in its
// shadow.
TEST(MediaMotion, FogIsInTheShadowThatAMovingPlateThrowsAtTheTimeOfTheRay) {
  const std::string world =
      "LightSource \"distant\" \"point from\" [0 9 0] \"point to\" [0 0 0]\n"
      "Volume \"homogeneous\" \"point p0\" [-1 -1 1] \"point p1\" [1 1 4] " +
      kFog + Plate("Translate 0 2 0 Rotate 90 1 0 0");
  for (const char* integrator : {"\"whitted\"", "\"path\""}) {
    EXPECT_GT(MeanAt(0, "", integrator, world), .01) << integrator;
    EXPECT_EQ(MeanAt(1, "", integrator, world), 0) << integrator;
  }
}

// A lamp within fog, and a plate between the fog and the floor that the camera looks at from below
// the plate.
TEST(MediaMotion, PhotonsThatFogScattersAreStoppedByAPlateAtTheirTime) {
  const std::string world =
      "LightSource \"point\" \"color I\" [5 5 5] \"point from\" [0 0 1.5]\n"
      "Volume \"homogeneous\" \"point p0\" [-1 -1 1] \"point p1\" [1 1 2] " +
      kFog + "Shape \"disk\" \"float radius\" 5\n" + Plate("Translate 0 0 .5");
  const std::string view = "LookAt 0 0 .3  0 0 0  0 1 0\n";
  const std::string integrator =
      "\"exphotonmap\" \"integer indirectphotons\" 3000 \"bool finalgather\" \"false\" "
      "\"string show\" \"indirectphotons\" \"float maxdist\" .5 \"integer maxphotonpaths\" 50000";
  EXPECT_GT(MeanAt(0, view, integrator, world), .001);
  EXPECT_EQ(MeanAt(1, view, integrator, world), 0);
}

}  // namespace
}  // namespace exphoton
