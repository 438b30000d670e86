// SPDX-License-Identifier: BSD-2-Clause
// These tests compare moving objects, cameras and lights with closed forms, and with the mean of
// pictures of stopped motion. Seeds are fixed. Tolerances are several times the noise that was
// measured with these seeds.
#include <gtest/gtest.h>

#include <array>
#include <sstream>

#include "core/math/motion.h"
#include "tests/support/equivalence.h"
#include "tests/support/test_scene.h"

namespace exphoton {
namespace {

const std::string kStart = "ActiveTransform StartTime ", kEnd = "ActiveTransform EndTime ",
                  kAll = "ActiveTransform All ", kBegin = "AttributeBegin ",
                  kDone = "AttributeEnd\n";

std::string Square(double x0, double x1, double y0, double y1, double z) {
  std::ostringstream text;
  text << "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] \"point P\" [" << x0 << " "
       << y0 << " " << z << " " << x0 << " " << y1 << " " << z << " " << x1 << " " << y1 << " " << z
       << " " << x1 << " " << y0 << " " << z << "]\n";
  return text.str();
}
const std::string kEmits = "AreaLightSource \"area\" ";
// The backdrop is black, so that no pixel is transparent.
const std::string kBackdrop =
    "Material \"matte\" \"color Kd\" [0 0 0]\n" + Square(-99, 99, -99, 99, 9);

struct MotionRun {
  std::uint64_t seed = 1;
  int size = 8;  // of the picture in pixels
};

TestRender Render(const std::string& integrator, const std::string& world, int samples = 64,
                  const std::string& effects = "auto", MotionRun run = {}) {
  TestRenderOptions options;
  options.load.effects = effects;
  options.seed = run.seed;
  return RenderSceneText(TestHeader(integrator, run.size, run.size, samples) + world, options);
}

// Returns "Transform [...]" with the numbers of the matrix, column by column.
std::string TransformText(const Transform& transform) {
  std::ostringstream text;
  text.precision(17);
  text << "Transform [";
  for (std::size_t j = 0; j < 4; ++j)
    for (std::size_t i = 0; i < 4; ++i) text << transform.Matrix().m[i][j] << " ";
  text << "] ";
  return text.str();
}

double LargestDifference(const Image& a, const Image& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i)
    largest = std::max(largest, std::abs(double(a.pixels[i]) - double(b.pixels[i])));
  return largest;
}

// Returns the fraction of [a, b] that [x, x + w] covers, as a mean over x from x0 to x1.
double MeanCoverage(double a, double b, double w, double x0, double x1) {
  double sum = 0;
  constexpr int kSteps = 20000;
  for (int i = 0; i < kSteps; ++i) {
    const double x = x0 + (x1 - x0) * (i + .5) / kSteps;
    sum += std::max(0., std::min(b, x + w) - std::max(a, x)) / (b - a);
  }
  return sum / kSteps;
}

TEST(Motion, OfASquareCoversPixelsForTheTimeItIsThere) {
  const std::string world = "WorldBegin\n" + kBackdrop + kEmits + kEnd + "Translate 1.5 0 0 " +
                            kAll + Square(-1, -.5, -2, 2, 1) + "WorldEnd\n";
  const Image image = Render("\"whitted\"", world, 1024).image;
  for (int x = 0; x < 8; ++x) {
    const double a = -1 + x * .25, truth = MeanCoverage(a, a + .25, .5, -1, .5);
    EXPECT_NEAR(MeanRadiance(image, {x, 0, x + 1, 8}), truth, .003) << x;
  }
}

// Returns the mean of exp(-depth / cos) over the rays of a camera with a field of view of 90
// degrees.
double MeanTransmittanceOfSlab(double depth) {
  constexpr int kSteps = 200;
  double sum = 0;
  for (int i = 0; i < kSteps; ++i)
    for (int j = 0; j < kSteps; ++j)
      sum += std::exp(-depth * std::hypot(2 * (i + .5) / kSteps - 1, 2 * (j + .5) / kSteps - 1, 1));
  return sum / (kSteps * kSteps);
}

// A lamp passes each point in a sixteenth of the time. If a sample saw one time only, the pixels
// would differ from each other by about their mean. `before` is text of the scene file that
// precedes the lamp. `mean` is the mean of the picture.
void ExpectLampInAllSamples(const std::string& before, double mean) {
  const std::string world = "WorldBegin\n" + before + kBackdrop + kEmits + kEnd +
                            "Translate 4 0 0 " + kAll + Square(-2.25, -2, -2, 2, 1) + "WorldEnd\n";
  for (const char* integrator : {"\"whitted\"", "\"path\"", "\"exphotonmap\""}) {
    const Image image = Render(integrator, world, 16).image;
    EXPECT_NEAR(MeanRadiance(image), mean, .03 * mean) << integrator;
    double squares = 0;
    for (int y = 0; y < 8; ++y)
      for (int x = 0; x < 8; ++x)
        squares += std::pow(MeanRadiance(image, {x, y, x + 1, y + 1}) / mean - 1, 2) / 64;
    EXPECT_LT(std::sqrt(squares), .2) << integrator;
  }
}

TEST(Motion, OfASmallLampIsSeenByAllSamples) { ExpectLampInAllSamples("", .0625); }

TEST(Motion, OfASmallLampIsSeenByAllSamplesThroughAMedium) {
  ExpectLampInAllSamples(
      "Volume \"homogeneous\" \"color sigma_a\" [1 1 1] \"color sigma_s\" [0 0 0] "
      "\"point p0\" [-9 -9 .2] \"point p1\" [9 9 .5]\n",
      .0625 * MeanTransmittanceOfSlab(.3));
}

// Returns the root of the mean squared difference of two pictures of 8 x 8 pixels.
double PixelNoise(const std::string& integrator, const std::string& world, int samples) {
  std::array<Image, 2> images;
  for (int i = 0; i < 2; ++i)
    images[std::size_t(i)] =
        Render(integrator, world, samples, "auto", {std::uint64_t(i + 1), 8}).image;
  double squares = 0;
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x)
      squares += std::pow(MeanRadiance(images[0], {x, y, x + 1, y + 1}) -
                              MeanRadiance(images[1], {x, y, x + 1, y + 1}),
                          2);
  return std::sqrt(squares / 64);
}

// A lamp that moves behind the camera is seen in a mirror, which a moving square hides for a part
// of the time. exphotonmap takes the mean over several times, whitted does not.
TEST(Motion, OfALampIsSeenInAMirrorByMoreSamples) {
  const std::string world = "WorldBegin\nMaterial \"mirror\" \"color Kr\" [1 1 1]\n" +
                            Square(-9, 9, -9, 9, 3) + kBackdrop + kBegin + kEnd +
                            "Translate 2 0 0 " + kAll + Square(-2, 0, -9, 9, 1) + kDone + kEmits +
                            kEnd + "Translate 0 8 0 " + kAll + "ReverseOrientation " +
                            Square(-9, 9, -4.5, -4, -2) + "WorldEnd\n";
  const std::string plain = "\"whitted\"",
                    averaged = "\"exphotonmap\" \"bool finalgather\" \"false\"";
  const double truth = MeanRadiance(Render(plain, world, 4096).image);
  EXPECT_GT(truth, .005);
  EXPECT_NEAR(MeanRadiance(Render(averaged, world, 1024).image), truth, .03 * truth);
  EXPECT_LT(PixelNoise(averaged, world, 16), .6 * PixelNoise(plain, world, 16));
}

TEST(Motion, OfTheShutterPartOfTheWayShowsThatPart) {
  const std::string world = "WorldBegin\n" + kBackdrop + kEmits + kEnd + "Translate 3 0 0 " + kAll +
                            Square(-1, -.5, -2, 2, 1) + "WorldEnd\n";
  const std::string camera =
      "TransformTimes 2 4\nCamera \"perspective\" \"float fov\" 90 \"float shutteropen\" 1 \"float "
      "shutterclose\" 3\n";
  const Image image = Render("\"whitted\"", camera + world, 1024).image;
  for (int x = 0; x < 8; ++x) {  // it rests for half of the time, then it moves by 1.5
    const double a = -1 + x * .25;
    const double truth =
        (MeanCoverage(a, a + .25, .5, -1, -1) + MeanCoverage(a, a + .25, .5, -1, .5)) / 2;
    EXPECT_NEAR(MeanRadiance(image, {x, 0, x + 1, 8}), truth, .004) << x;
  }
}

TEST(Motion, OfATurningSectorLightsEachAngleForItsShare) {
  // A quarter disk turns by 90 degrees about the view direction. It covers the angle b of the half
  // circle for 1 - |b - 90| / 90 of the time.
  const std::string world = "WorldBegin\n" + kBackdrop + kEmits + kEnd + "Rotate 90 0 0 1 " + kAll +
                            "Translate 0 0 1 Rotate 180 1 0 0 Rotate -90 0 0 1 Shape \"disk\" "
                            "\"float radius\" 4 \"float phimax\" 90\nWorldEnd\n";
  const Image image = Render("\"whitted\"", world, 1024, "auto", {1, 16}).image;
  EXPECT_NEAR(MeanRadiance(image), .25, .002);
  double most = 0;
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 16; ++x) most = std::max(most, MeanRadiance(image, {x, y, x + 1, y + 1}));
  EXPECT_GT(most, .9);
  EXPECT_LE(most, 1);
}

const std::string kSky = "LightSource \"infinite\" \"color L\" [1 1 1]\n";
const std::string kMatte = "Material \"matte\" \"color Kd\" [.5 .5 .5] ";

TEST(Motion, OfTheCameraIsTheOppositeOfTheScenes) {
  const std::string world = "Translate 0 0 3 Shape \"sphere\"\n" + kBegin +
                            "Translate 1.5 0 0 Shape \"sphere\" \"float radius\" .4\n" + kDone;
  for (const std::string& motion :
       {std::string("Translate .7 .2 .3 "), std::string("Rotate 30 1 2 5 ")}) {
    const std::string camera = kEnd + motion + kAll + "Camera \"perspective\" \"float fov\" 90\n";
    const Image moved = Render("\"directlighting\"",
                               camera + "WorldBegin\n" + kSky + kMatte + world + "WorldEnd\n", 256)
                            .image;
    const Image scene =
        Render("\"directlighting\"",
               "WorldBegin\n" + kSky + kMatte + kEnd + motion + kAll + world + "WorldEnd\n", 256)
            .image;
    EXPECT_LT(LargestDifference(moved, scene), .03) << motion;
    EXPECT_NEAR(MeanRadiance(moved), MeanRadiance(scene), .002) << motion;
  }
}

TEST(Motion, OfEveryCameraIsSeen) {
  const std::string world = "WorldBegin\n" + kEmits + Square(-.5, 0, -9, 9, 1) + "WorldEnd\n";
  for (const std::string name :
       {"\"perspective\" \"float fov\" 90", "\"orthographic\"", "\"environment\""}) {
    const std::string moving = kEnd + "Translate .5 0 0 " + kAll + "Camera " + name + "\n";
    const Image image = Render("\"whitted\"", moving + world).image;
    const Image still = Render("\"whitted\"", moving + world, 64, "motion=off").image;
    EXPECT_GT(LargestDifference(image, still), .2) << name;
  }
}

TEST(Motion, OfAnInstanceIsThatOfItsShape) {
  const std::string shape = "Shape \"sphere\" \"float radius\" .6\n";
  const std::string motion = kEnd + "Translate .5 0 0 Rotate 50 1 2 3 " + kAll + "Translate 0 0 2 ";
  const Image one =
      Render("\"directlighting\"", "WorldBegin\n" + kSky + kMatte + motion + shape + "WorldEnd\n")
          .image;
  const Image other =
      Render("\"directlighting\"", "WorldBegin\n" + kSky + kMatte + "ObjectBegin \"o\" " + shape +
                                       "ObjectEnd\n" + motion + "ObjectInstance \"o\"\nWorldEnd\n")
          .image;
  const Image part = Render("\"directlighting\"",
                            "WorldBegin\n" + kSky + kMatte + "ObjectBegin \"o\" " + motion + shape +
                                "ObjectEnd\nIdentity ObjectInstance \"o\"\nWorldEnd\n")
                         .image;
  EXPECT_EQ(one.pixels, other.pixels);
  EXPECT_EQ(one.pixels, part.pixels);
}

std::string BusyWorld() {
  return "WorldBegin\n" + kSky + kMatte + Square(-9, 9, -9, 9, 6) + kBegin + kEnd +
         "Translate 1 .5 0 Rotate 70 1 1 0 Scale 1 2 .5 " + kAll +
         "Translate -.5 0 3 Shape \"cylinder\" \"float radius\" .5\n" + kDone + kBegin + kEmits +
         "\"color L\" [3 3 3] " + kEnd + "Translate -1 0 1 " + kAll +
         "Translate .8 -.5 3 Shape \"sphere\" \"float radius\" .3\n" + kDone + "WorldEnd\n";
}

TEST(Motion, LooksTheSameWithEveryAccelerator) {
  const auto picture = [](const std::string& accelerator) {
    return Render("\"path\"", "Accelerator \"" + accelerator + "\"\n" + BusyWorld(), 16).image;
  };
  const Image truth = picture("bruteforce");
  EXPECT_EQ(picture("bvh").pixels, truth.pixels);
  EXPECT_EQ(picture("kdtree").pixels, truth.pixels);
}

TEST(Motion, OffIsTheMomentThatTheShutterOpens) {
  for (const char* integrator : {"\"path\"",
                                 "\"exphotonmap\" \"integer indirectphotons\" 500 \"integer "
                                 "maxphotonpaths\" 20000 \"integer "
                                 "finalgathersamples\" 4"}) {
    const std::string brief =
                          "Camera \"perspective\" \"float fov\" 90 \"float shutteropen\" .3 "
                          "\"float shutterclose\" .3\n",
                      lasting =
                          "Camera \"perspective\" \"float fov\" 90 \"float shutteropen\" .3 "
                          "\"float shutterclose\" .8\n";
    const Image still = Render(integrator, brief + BusyWorld(), 4).image;
    EXPECT_EQ(Render(integrator, lasting + BusyWorld(), 4, "motion=off").image.pixels,
              still.pixels);
    const Image moving = Render(integrator, lasting + BusyWorld(), 4).image;
    EXPECT_EQ(Render(integrator, lasting + BusyWorld(), 4, "all").image.pixels, moving.pixels);
    EXPECT_NE(moving.pixels, still.pixels);
  }
}

// Returns the mean of pictures whose motion is stopped at the midpoints of kStills equal parts of
// the time. world(at) returns the scene with the transformation `at` for the moving object.
template <class World>
double MeanOfStills(const std::string& integrator, const AnimatedTransform& motion,
                    const World& world, int samples) {
  constexpr int kStills = 32;
  double sum = 0;
  for (int i = 0; i < kStills; ++i)
    sum += MeanRadiance(Render(integrator,
                               world(TransformText(motion.At((Real(i) + Real(.5)) / kStills))),
                               samples, "auto", {std::uint64_t(i) + 1})
                            .image);
  return sum / kStills;
}

// The lamp moves behind the camera. In view, it would hide the surface that it lights, but only at
// the times of its positions.
AnimatedTransform LampMotion() {
  const Transform start = Transform::Translate({-1, 0, -2}) * *Transform::Rotate(-60, {0, 1, 0});
  const Transform end = Transform::Translate({1, 1, -1}) * *Transform::Rotate(50, {1, 1, 0}) *
                        *Transform::Scale(2, Real(.5), 1);
  const char* problem = "";
  return *AnimatedTransform::Between(start, end, {0, 1}, &problem);
}
std::string MovingText(const AnimatedTransform& motion) {
  return kStart + TransformText(motion.Start()) + kEnd + TransformText(motion.End()) + kAll;
}

TEST(Motion, OfALampLightsAsItsPositionsDo) {
  const auto world = [](const std::string& at) {
    return "WorldBegin\n" + kMatte + Square(-3, 3, -3, 3, 4) + kBegin + kEmits +
           "\"color L\" [4 4 4] " + at + "Shape \"disk\" \"float radius\" .4\n" + kDone +
           "WorldEnd\n";
  };
  const AnimatedTransform motion = LampMotion();
  for (const std::string integrator :
       {"\"directlighting\"", "\"path\"", "\"whitted\"", "\"bidirectional\""}) {
    const double truth = MeanOfStills(integrator, motion, world, 64);
    const SeedEstimate moving = EstimateOverSeeds([&](std::uint64_t seed) {
      return MeanRadiance(Render(integrator, world(MovingText(motion)), 256, "auto", {seed}).image);
    });
    EXPECT_TRUE(IsWithin(.02, moving, truth)) << integrator;
  }
}

// A lamp is stretched as it moves. Its photons must carry the power that it emits.
TEST(Motion, OfALampShootsThePhotonsThatItsPositionsDo) {
  const auto world = [](const std::string& at) {
    return "WorldBegin\n" + kMatte + Square(-20, 20, -20, 20, 4) + kBegin + kEmits +
           "\"color L\" [4 4 4] " + at + "Shape \"disk\" \"float radius\" .4\n" + kDone +
           "WorldEnd\n";
  };
  const std::string photons =
      "\"photonmap\" \"string show\" \"directphotons\" \"integer directphotons\" 20000 \"integer "
      "nused\" 60";
  const AnimatedTransform motion = LampMotion();
  const double truth = MeanOfStills("\"directlighting\"", motion, world, 64);
  const SeedEstimate moving = EstimateOverSeeds([&](std::uint64_t seed) {
    return MeanRadiance(Render(photons, world(MovingText(motion)), 8, "auto", {seed}).image);
  });
  EXPECT_TRUE(IsWithin(.03, moving, truth));
}

TEST(Motion, OfABlockerLeavesThePhotonsOfTheMean) {
  const auto world = [](const std::string& at) {
    return "WorldBegin\nLightSource \"point\" \"point from\" [0 0 -2] \"color I\" [50 50 50]\n" +
           kMatte + Square(-6, 6, -6, 6, 4) + kBegin + at + Square(-.5, .5, -2, 2, -1) + kDone +
           "WorldEnd\n";
  };
  const char* problem = "";
  const AnimatedTransform motion = *AnimatedTransform::Between(
      Transform::Translate({-2, 0, 0}), Transform::Translate({1, 0, 0}), {0, 1}, &problem);
  const std::string photons =
      "\"photonmap\" \"string show\" \"directphotons\" \"integer directphotons\" 8000 \"integer "
      "nused\" 60";
  const double truth = MeanOfStills(photons, motion, world, 8);
  const SeedEstimate moving = EstimateOverSeeds([&](std::uint64_t seed) {
    return MeanRadiance(Render(photons, world(MovingText(motion)), 8, "auto", {seed}).image);
  });
  EXPECT_TRUE(IsWithin(.03, moving, truth));
}

// A wall that moves through parallel light is lit at all times. A query must find photons of all
// times from the wall's current position.
TEST(Motion, OfAReceiverKeepsItsPhotonsTogether) {
  const std::string light =
      "LightSource \"distant\" \"point from\" [0 0 -1] \"point to\" [0 0 0] \"color L\" [2 2 2]\n";
  const std::string photons =
      "\"photonmap\" \"string show\" \"directphotons\" \"integer directphotons\" 8000 \"integer "
      "nused\" 60";
  for (const std::string motion :
       {"Translate 0 0 3 ", "Translate 1 0 2 ", "Rotate 80 0 0 1 ", "Scale 1.5 1.5 1 "}) {
    const Image image = Render(photons,
                               "WorldBegin\n" + light + kMatte + kEnd + motion + kAll +
                                   Square(-9, 9, -9, 9, 3) + "WorldEnd\n",
                               8)
                            .image;
    EXPECT_NEAR(MeanRadiance(image), 2 * .5 / 3.14159265, .03 * 2 * .5 / 3.14159265) << motion;
  }
}

TEST(Motion, InAFurnaceChangesNothing) {
  const std::string material = "\"matte\" \"color Kd\" [.5 .5 .5]";
  std::string world = FurnaceWorld(1, material);  // normals point inwards
  world.insert(world.rfind("WorldEnd"),
               "ReverseOrientation " + kEnd + "Translate 1 .3 0 Rotate 90 0 1 0 " + kAll +
                   "Translate -.5 0 .5 Shape \"sphere\" \"float radius\" .2\n");
  for (const auto& [integrator, tolerance] :
       {std::pair<std::string, double>{"\"path\" \"integer maxdepth\" 40", .01},
        {"\"exphotonmap\" \"integer causticphotons\" 0 \"integer indirectphotons\" 10000 \"integer "
         "finalgathersamples\" 16",
         .02},
        {"\"photonmap\" \"integer causticphotons\" 0 \"integer indirectphotons\" 10000 \"bool "
         "finalgather\" \"false\"",
         .03}}) {
    const SeedEstimate mean = EstimateOverSeeds([&, name = integrator](std::uint64_t seed) {
      return MeanRadiance(Render(name, world, 16, "auto", {seed}).image);
    });
    EXPECT_TRUE(IsWithin(tolerance, mean, 2)) << integrator;
  }
}

}  // namespace
}  // namespace exphoton
