// SPDX-License-Identifier: BSD-2-Clause
// These tests order an accuracy for scenes in which paths from the camera miss much light. A wall
// sees a bright light only in a mirror behind the camera, because a screen is between them. Or a
// tiny lamp hangs in a cup, so that most of its light reaches the room over the cup's inside.
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/cli/program.h"

namespace exphoton {
namespace {

using Names = std::vector<std::string>;

const std::string kBrightPoint =
    "LightSource \"point\" \"point from\" [3.5 0 4] \"color I\" [63 63 63]\n";
// It has the same intensity.
const std::string kBrightBead =
    "AttributeBegin Translate 3.5 0 4 AreaLightSource \"area\" \"color L\" [5e6 5e6 5e6]\n"
    "Material \"matte\" \"color Kd\" [0 0 0] Shape \"sphere\" \"float radius\" .002 AttributeEnd\n";

std::string Quad(const std::string& corners) {
  return "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] \"point P\" [" + corners + "]\n";
}

class ChoiceTest : public ProgramTest {
 protected:
  ProgramResult Render(const std::string& light, const Names& more = {}) const {
    Write("room.pbrt",
          "Film \"image\" \"integer xresolution\" 32 \"integer yresolution\" 24\n"
          "Camera \"perspective\" \"float fov\" 40\nPixelFilter \"box\"\n"
          "SurfaceIntegrator \"exphotonmap\" \"integer indirectphotons\" 2000\n"
          "\"integer causticphotons\" 2000 \"integer maxphotonpaths\" 200000\nWorldBegin\n" +
              light +
              "AttributeBegin Translate -4 0 3 AreaLightSource \"area\" \"color L\" [1 1 1]\n"
              "Material \"matte\" \"color Kd\" [0 0 0] Shape \"sphere\" AttributeEnd\n"
              "Material \"matte\" \"color Kd\" [.7 .7 .7]\n" +
              Quad("-3 -3 6 3 -3 6 3 3 6 -3 3 6") + "Material \"matte\" \"color Kd\" [0 0 0]\n" +
              Quad("3 -3 1.9 3 3 1.9 3 3 6 3 -3 6") + "Material \"mirror\" \"color Kr\" [1 1 1]\n" +
              Quad("-9 -9 -2 9 -9 -2 9 9 -2 -9 9 -2") + "WorldEnd\n");
    Names words{"room.pbrt", "--accuracy", "10%", "-o", "room.exr", "--no-progress"};
    words.insert(words.end(), more.begin(), more.end());
    return Run(words);
  }
};

TEST_F(ChoiceTest, LeavesOutIntegratorsThatNeverFindSomeLight) {
  const ProgramResult result = Render(kBrightPoint);
  ASSERT_EQ(result.status, 0) << result.err;
  ExpectIn("accuracy 10%: integrator exphotonmap, ", result.err);
  ExpectIn("path: never finds caustics of a light without a size", result.err);
}

// A user may still want such an integrator.
TEST_F(ChoiceTest, SaysWhatTheErrorOfANamedIntegratorDoesNotContain) {
  const ProgramResult result =
      Render(kBrightPoint, {"--integrator", "path", "--stats-json", "room.json"});
  ASSERT_EQ(result.status, 0) << result.err;
  ExpectIn("warning: the error does not contain caustics of a light without a size", result.err);
  ExpectIn("\"notCovered\":\"caustics of a light without a size\"", Read("room.json"));
  ExpectIn("accuracy/notCovered", Run({"info", "room.exr"}).out);
  ExpectIn("unseen        caustics of a light without a size",
           Run({"explain", "room.pbrt", "--integrator", "path"}).out);
}

// No pilot of path meets the bead, so it looks cheap. Photons show more than half of the light.
TEST_F(ChoiceTest, LeavesOutIntegratorsThatLackMuchLightOfARoughPilot) {
  const ProgramResult result = Render(kBrightBead);
  ASSERT_EQ(result.status, 0) << result.err;
  ExpectIn("accuracy 10%: integrator exphotonmap, ", result.err);
  ExpectIn("less light than exphotonmap", result.err);
  ExpectIn("the error lies below", result.err);
}

// A named integrator stays, but its error is no promise for light that it does not meet.
TEST_F(ChoiceTest, SaysHowMuchLightANamedIntegratorLacks) {
  const ProgramResult result =
      Render(kBrightBead, {"--integrator", "path", "--stats-json", "room.json"});
  ASSERT_EQ(result.status, 0) << result.err;
  ExpectIn("accuracy 10%: integrator path, ", result.err);
  ExpectIn("warning: the error does not contain about ", result.err);
  ExpectIn(
      " % of the light that exphotonmap finds, because integrator \"path\" does not find this "
      "light",
      result.err);
  ExpectIn("% of the light that exphotonmap finds\"", Read("room.json"));
  ExpectIn("accuracy/notCovered", Run({"info", "room.exr"}).out);
}

TEST_F(ChoiceTest, IsMadeAgainWhereAPictureIsFarNoisierThanItsPilots) {
  Write("lamp.pbrt", RoomWithAHiddenLamp());
  std::string pictures[2];
  for (const char* threads : {"1", "2"}) {
    const ProgramResult result =
        Run({"lamp.pbrt", "--accuracy", "20%", "--seed", "1", "--nthreads", threads, "-o",
             "lamp.exr", "--reproducible", "--no-progress", "--stats-json", "lamp.json"});
    ASSERT_EQ(result.status, 0) << result.err;
    ExpectIn("accuracy 20%: integrator exphotonmap -> path", result.err);
    ExpectIn("the picture of path needs at least ", result.err);
    ExpectIn("accuracy 20%: integrator exphotonmap, ", result.err);
    ExpectIn(" s for 1 given-up attempt)", result.err);
    EXPECT_EQ(result.err.find("which is not the accuracy"), std::string::npos) << result.err;
    pictures[threads[0] - '1'] = Read("lamp.exr");
  }
  EXPECT_TRUE(pictures[0] == pictures[1]);
  // The pilots of both choices count: two of path, and at least three of photons.
  const nlohmann::json statistics = nlohmann::json::parse(Read("lamp.json"));
  EXPECT_GE(statistics["accuracy"]["pilots"]["renders"].get<int>(), 5);
  // So does the time of the picture of path.
  double givenUp = 0, allPhases = 0;
  for (const auto& phase : statistics["phases"]) {
    const double seconds = phase["cpuSeconds"].get<double>();
    allPhases += seconds;
    if (phase["name"] == "given up") givenUp = seconds;
  }
  EXPECT_GT(givenUp, 0);
  EXPECT_GT(allPhases, .9 * statistics["cpuSeconds"].get<double>());
}

// Returns a closed room with a tiny lamp in a cup.
std::string RoomWithACup() {
  return "LookAt 0 0 4.5 0 0 0 0 1 0 Camera \"perspective\" \"float fov\" 50\n"
         "Film \"image\" \"integer xresolution\" 32 \"integer yresolution\" 24\n"
         "PixelFilter \"box\" SurfaceIntegrator \"exphotonmap\"\nWorldBegin\n"
         "Material \"matte\" \"color Kd\" [.6 .6 .6]\n"
         "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3 4 6 5 4 7 6 0 5 1 0 4 5\n"
         "3 2 6 3 6 7 0 3 7 0 7 4 1 5 6 1 6 2] \"point P\" [-2 -1.5 -2 2 -1.5 -2 2 1.5 -2 -2 1.5 "
         "-2\n"
         "-2 -1.5 5 2 -1.5 5 2 1.5 5 -2 1.5 5]\n"
         "AttributeBegin Material \"matte\" \"color Kd\" [.8 .8 .8] Translate 0 .3 -1.8 Rotate -90 "
         "1 0 0\n"
         "Shape \"cylinder\" \"float radius\" .02 \"float zmin\" 0 \"float zmax\" .06\n"
         "Shape \"disk\" \"float radius\" .02 AttributeEnd\n"
         "AreaLightSource \"area\" \"color L\" [6000 6000 6000] Material \"matte\" \"color Kd\" [0 "
         "0 0]\n"
         "Translate 0 .324 -1.8 Shape \"sphere\" \"float radius\" .008\nWorldEnd\n";
}

// The pilot of path meets little light and little noise. The rough pilots are noisy.
TEST_F(ChoiceTest, LeavesOutIntegratorsThatMissTheLightOfACup) {
  Write("cup.pbrt", RoomWithACup());
  for (const char* seed : {"1", "2", "3"}) {
    const ProgramResult result =
        Run({"cup.pbrt", "--accuracy", "20%", "--seed", seed, "-o", "cup.exr", "--no-progress"});
    ASSERT_EQ(result.status, 0) << result.err;
    ExpectIn("accuracy 20%: integrator exphotonmap, ", result.err);
    ExpectIn("path: finds ", result.err);
    ExpectIn(" % less light than exphotonmap", result.err);
  }
}

TEST_F(ChoiceTest, QuotesNoPriceForLightThatIsNeverFound) {
  Render(kBrightPoint);
  const ProgramResult quote =
      Run({"quote", "room.pbrt", "--integrators", "path,photonmap", "--accuracies", "10%"});
  ASSERT_EQ(quote.status, 0) << quote.err;
  ExpectIn("open: never finds caustics of a light without a size", quote.out);
}

}  // namespace
}  // namespace exphoton
