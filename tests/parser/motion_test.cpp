// SPDX-License-Identifier: BSD-2-Clause
// These tests check ActiveTransform and TransformTimes: which objects move, between which places
// and at which times, and which objects cannot move.
#include <gtest/gtest.h>

#include "tests/parser/parse_support.h"

namespace exphoton {
namespace {

constexpr Interval kAlways{-kInfinity, kInfinity};

// Returns "line:column: text" of the error. The text of the world begins on line 2.
std::string ErrorIn(const std::string& world) {
  const std::string error = BuildText("Accelerator \"bruteforce\" WorldBegin\n" + world).error;
  const std::size_t begin = error.find("scene.pbrt:");
  if (begin == std::string::npos) return error;
  return error.substr(begin + 11, error.find('\n') - begin - 11);
}

// Track holds the points (0, 0, 0) and (1, 0, 0) of a moving instance's space at times
// 0, 1/2 and 1.
struct Track {
  Point3 p[3], x[3];
};
Track TrackOf(const BuiltScene& built, std::uint32_t instance = 0) {
  Track track;
  if (!built.error.empty() || built.setups.empty()) {
    ADD_FAILURE() << built.error;
    return track;
  }
  Hit hit;
  hit.primitive = 0;
  hit.instance = instance;
  const Motion* motion = built.setups[0]->scene->Primitives().MotionOf(hit);
  if (!motion) {
    ADD_FAILURE() << "nothing moves";
    return track;
  }
  for (int i = 0; i < 3; ++i) {
    track.p[i] = motion->At(Real(i) / 2).ApplyPoint({0, 0, 0});
    track.x[i] = motion->At(Real(i) / 2).ApplyPoint({1, 0, 0});
  }
  return track;
}

bool Moves(const BuiltScene& built) {
  EXPECT_EQ(built.error, "");
  return built.setups.at(0)->scene->Primitives().MovesWithin(kAlways);
}

const std::string kEnd = "ActiveTransform EndTime ", kStart = "ActiveTransform StartTime ",
                  kAll = "ActiveTransform All ";

TEST(ActiveTransform, MovesAShapeFromStartToEnd) {
  const Track track =
      TrackOf(BuildText(InWorld(kStart + "Translate 1 0 0 " + kEnd + "Translate 3 2 0 " + kAll +
                                "Translate 0 0 5 Shape \"sphere\"")));
  EXPECT_EQ(track.p[0], Point3(1, 0, 5));
  EXPECT_EQ(track.p[1], Point3(2, 1, 5));
  EXPECT_EQ(track.p[2], Point3(3, 2, 5));
}

TEST(ActiveTransform, OfTheSameAtBothEndsMovesNothing) {
  EXPECT_FALSE(Moves(
      BuildText(InWorld(kStart + "Translate 1 0 0 " + kEnd + "Translate 1 0 0 Shape \"sphere\""))));
  EXPECT_FALSE(Moves(BuildText(InWorld(kEnd + "Translate 1 0 0 " + "Identity Shape \"sphere\""))));
  EXPECT_TRUE(Moves(BuildText(InWorld(kEnd + "Translate 1 0 0 Shape \"sphere\""))));
}

TEST(ActiveTransform, EndsWithItsBlock) {
  for (const std::string block : {"Attribute", "Transform"}) {
    const BuiltScene built = BuildText(InWorld(block + "Begin " + kEnd + "Translate 1 0 0 " +
                                               block + "End Translate 2 0 0 Shape \"sphere\""));
    EXPECT_FALSE(Moves(built)) << block;
  }
}

TEST(ActiveTransform, DoesNotReachIntoTheWorld) {
  const BuiltScene built = BuildText(kEnd + InWorld("Translate 1 0 0 Shape \"sphere\""));
  EXPECT_FALSE(Moves(built));
  EXPECT_FALSE(built.setups[0]->camera->MovesWithin(kAlways));
}

TEST(ActiveTransform, LeavesReverseOrientationAndMaterialsAlone) {
  const BuiltScene built = BuildText(
      InWorld(kEnd + "ReverseOrientation Material \"matte\" Translate 1 0 0 Shape \"sphere\""));
  EXPECT_TRUE(Moves(built));
}

TEST(CoordinateSystem, RemembersBothTimes) {
  const Track track =
      TrackOf(BuildText(InWorld(kEnd + "Translate 1 0 0 CoordinateSystem \"there\" " + kAll +
                                "Identity CoordSysTransform \"there\" Shape \"sphere\"")));
  EXPECT_EQ(track.p[0], Point3(0, 0, 0));
  EXPECT_EQ(track.p[2], Point3(1, 0, 0));
  // CoordSysTransform restores the matrices of both times, whichever time is active.
  const Track again =
      TrackOf(BuildText(InWorld(kEnd + "Translate 1 0 0 CoordinateSystem \"there\" Identity " +
                                kStart + "CoordSysTransform \"there\" Shape \"sphere\"")));
  EXPECT_EQ(again.p[2], Point3(1, 0, 0));
}

TEST(Camera, MovesBetweenTheInversesOfItsMatrices) {
  const BuiltScene built =
      BuildText(kStart + "LookAt 0 0 0 0 0 1 0 1 0 " + kEnd + "LookAt 2 0 0 2 0 1 0 1 0 " + kAll +
                "Camera \"perspective\" \"float shutterclose\" 1 " + InWorld(""));
  ASSERT_EQ(built.error, "");
  const Camera& camera = *built.setups[0]->camera;
  EXPECT_TRUE(camera.MovesWithin(camera.Shutter()));
  for (const Real time : {Real(0), Real(.25), Real(.75)}) {
    const Ray ray = camera.GenerateRay({{2, 2}, {}, time}, false);
    EXPECT_NEAR(double(ray.o.x), 2 * double(time), 1e-6);
    EXPECT_EQ(ray.time, time);
  }
}

TEST(Camera, LeavesItsCoordinateSystemAtBothTimes) {
  const Track track =
      TrackOf(BuildText(kEnd + "Translate -3 0 0 " + kAll + "Camera \"perspective\" " +
                        InWorld("CoordSysTransform \"camera\" Shape \"sphere\"")));
  EXPECT_EQ(track.p[0], Point3(0, 0, 0));
  EXPECT_EQ(track.p[2], Point3(3, 0, 0));
}

TEST(TransformTimes, SayWhenThingsMoveWhereverTheyStand) {
  for (const bool isLate : {false, true}) {
    const std::string times = "TransformTimes 2 4 ", camera = "Camera \"perspective\" ";
    const BuiltScene built = BuildText((isLate ? camera + times : times + camera) +
                                       InWorld(kEnd + "Translate 1 0 0 Shape \"sphere\""));
    ASSERT_EQ(built.error, "");
    const PrimitiveSet& set = built.setups[0]->scene->Primitives();
    EXPECT_FALSE(set.MovesWithin({0, 2}));
    EXPECT_TRUE(set.MovesWithin({3, 4}));
  }
}

TEST(ObjectInstance, MovesAndItsPartsMoveWithinIt) {
  const std::string object = "ObjectBegin \"o\" Shape \"sphere\" AttributeBegin " + kEnd +
                             "Translate 1 0 0 Shape \"sphere\" AttributeEnd ObjectEnd ";
  const BuiltScene rests = BuildText(InWorld(object + "Translate 0 5 0 ObjectInstance \"o\""));
  ASSERT_EQ(rests.error, "");
  ASSERT_EQ(rests.setups[0]->scene->Primitives().Count(), 2u);
  const Track part = TrackOf(rests, 1);
  EXPECT_EQ(part.p[0], Point3(0, 5, 0));
  EXPECT_EQ(part.p[2], Point3(1, 5, 0));

  const BuiltScene moves =
      BuildText(InWorld(object + kEnd + "Translate 0 5 0 " + kAll + "ObjectInstance \"o\""));
  const Track whole = TrackOf(moves, 0), inner = TrackOf(moves, 1);
  EXPECT_EQ(whole.p[1], Point3(0, Real(2.5), 0));
  EXPECT_EQ(inner.p[1], Point3(Real(.5), Real(2.5), 0));
  EXPECT_EQ(inner.p[2], Point3(1, 5, 0));
}

TEST(ObjectInstance, OfMovingPartsOnlyIsSeen) {
  const BuiltScene built = BuildText(InWorld("ObjectBegin \"o\" " + kEnd +
                                             "Translate 1 0 0 Shape \"sphere\" ObjectEnd "
                                             "ObjectInstance \"o\""));
  ASSERT_EQ(built.error, "");
  EXPECT_EQ(built.setups[0]->scene->Primitives().Count(), 1u);
}

TEST(Motion, IsRefusedWithItsPlaceWhereThereIsNone) {
  EXPECT_EQ(
      ErrorIn(kEnd + "Scale -1 1 1\n Shape \"sphere\"\nWorldEnd"),
      "3:2: error: sphere cannot move this way: it is mirrored at one end and not at the other, "
      "and would be flat in between");
  EXPECT_EQ(ErrorIn(kEnd + "Transform [1 0 0 0 0 1 0 0 0 0 1 1 0 0 0 1]\nShape "
                           "\"sphere\"\nWorldEnd"),
            "2:25: error: Transform: the matrix is projective: number 12 is not 0");
  EXPECT_EQ(
      ErrorIn("ObjectBegin \"o\" Shape \"sphere\" ObjectEnd " + kEnd +
              "Scale 1 1 -1\nObjectInstance \"o\"\nWorldEnd"),
      "3:1: error: \"o\" cannot move this way: it is mirrored at one end and not at the other, "
      "and would be flat in between");
  EXPECT_EQ(ErrorIn(kEnd + "Scale 0 1 1"), "2:25: error: Scale: a factor is 0");
}

TEST(Motion, OfTheCameraIsRefusedWithItsPlace) {
  const BuiltScene built =
      BuildText(kEnd + "Scale -1 1 1\n" + kAll + "Camera \"perspective\" " + InWorld(""));
  EXPECT_NE(built.error.find("scene.pbrt:2:21: error: the camera cannot move this way"),
            std::string::npos)
      << built.error;
}

TEST(Motion, IsNotForLightsAndVolumes) {
  const std::string moving = kEnd + "Translate 1 0 0\n";
  EXPECT_EQ(ErrorIn(moving + "LightSource \"point\""),
            "3:1: error: a light source cannot move; shapes, area lights on them, instances and "
            "the camera can");
  EXPECT_EQ(ErrorIn(moving + "Volume \"homogeneous\""),
            "3:1: error: a volume cannot move; shapes, area lights on them, instances and the "
            "camera can");
}

TEST(Motion, OfTexturesIsNoneWithAWarning) {
  const BuiltScene built =
      BuildText(InWorld(kEnd + "Translate 1 0 0 Texture \"t\" \"float\" \"constant\""));
  EXPECT_EQ(built.error, "");
  EXPECT_NE(built.Messages().find("a texture does not move"), std::string::npos);
}

TEST(Motion, WarnsOfTurnsThatAreNotMeantSo) {
  const auto said = [](const std::string& turn) {
    return BuildText(InWorld(kEnd + turn + " Shape \"sphere\"")).Messages();
  };
  EXPECT_EQ(said("Rotate 90 0 0 1").find("turn"), std::string::npos);
  EXPECT_NE(said("Rotate 180 0 0 1").find("rotates by half a turn"), std::string::npos);
  EXPECT_NE(said("Rotate 360000 0 0 1").find("by more than half a turn"), std::string::npos);
}

TEST(TransformTimes, MustBeInOrderAndBeforeTheWorld) {
  for (const char* times : {"1 0", "1 1", "0 1e309"})
    EXPECT_NE(BuildText("TransformTimes " + std::string(times) + " " + InWorld(""))
                  .error.find("scene.pbrt:1:"),
              std::string::npos)
        << times;
  EXPECT_EQ(ErrorIn("TransformTimes 0 1"), "2:1: error: TransformTimes must be before WorldBegin");
}

TEST(Shutter, MustNotCloseBeforeItOpens) {
  EXPECT_NE(BuildText("Camera \"perspective\" \"float shutteropen\" 2 \"float shutterclose\" 1 " +
                      InWorld(""))
                .error.find("must not be before 'shutteropen'"),
            std::string::npos);
}

TEST(AreaLight, MovesWithItsShape) {
  const BuiltScene built =
      BuildText(InWorld(kEnd + "Translate 4 0 0 AreaLightSource \"area\" Shape \"sphere\""));
  ASSERT_EQ(built.error, "");
  const Light& light = *built.setups[0]->scene->Lights().at(0);
  SurfacePoint ref;
  for (const Real time : {Real(0), Real(.5), Real(1)}) {
    ref.p = {4 * time, 10, 0};
    ref.time = time;
    const auto sample = light.SampleDirect(ref, {Real(.5), Real(.5)}, Real(.5));
    ASSERT_TRUE(sample);
    EXPECT_LT(sample->wi.y, Real(-.99));  // straight down to the light's position at this time
    EXPECT_EQ(sample->shadowRay.time, time);
  }
}

}  // namespace
}  // namespace exphoton
