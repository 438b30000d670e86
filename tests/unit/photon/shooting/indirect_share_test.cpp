// SPDX-License-Identifier: BSD-2-Clause
// These tests check the share of indirect light where the camera looks, and the number of indirect
// photons that follows from it.
#include "integrators/photon/shooting/emission/indirect_share.h"

#include <gtest/gtest.h>

#include <string>

#include "core/math/sampling/low_discrepancy.h"
#include "tests/support/photon_shots.h"
#include "tests/support/test_scene.h"

namespace exphoton {
namespace {

const Normal3 kUp(0, 0, 1);
constexpr std::uint32_t kPoints = 1024;

// Returns the upper bound where the mean square of the share is known.
double BoundOf(double meanSquare, double points = kPoints) {
  return std::sqrt(meanSquare + 4 / points);
}

// Photons of power 1 from above, one a path, spread evenly over a square of side 1.
SomePhotons Square(std::uint32_t count, Real x = 0, Real z = 0, const Vector3& from = {0, 0, 1}) {
  SomePhotons photons;
  photons.AddPaths(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    const Point2 u = ScrambledSobol2(i, count);
    const PhotonRecord photon(Photon{{x + u.x, u.y, z}, from, Spectrum(1)});
    photons.Add({&photon, 1});
  }
  return photons;
}

// Points in the middle of the square.
std::vector<VisiblePoint> Points(Real x = 0) {
  std::vector<VisiblePoint> points;
  for (std::uint32_t i = 0; i < kPoints; ++i) {
    const Point2 u = ScrambledSobol2(i, 77);
    points.push_back({{x + Real(.25) + u.x / 2, Real(.25) + u.y / 2, 0}, kUp});
  }
  return points;
}

class IndirectShareTest : public testing::Test {
 protected:
  double Of(const IndirectShare& share, const SomePhotons& indirect) {
    return share.UpperBound(indirect, threads_);
  }
  void Add(IndirectShare* share, const SomePhotons& photons) {
    share->AddLight(*roof_.setup->scene, photons, threads_);
  }

 private:
  ThreadPool threads_{1};
  LoadedScene roof_ =
      LoadSceneText("WorldBegin Translate .5 .5 .4 Shape \"disk\" \"float radius\" 3 WorldEnd\n");
};

TEST_F(IndirectShareTest, IsTheRatioOfIrradiances) {
  IndirectShare share(Points());
  EXPECT_EQ(Of(share, Square(1000)), 1);
  Add(&share, Square(1000));
  EXPECT_NEAR(Of(share, Square(1000)), BoundOf(.25), .02);
  SomePhotons more = Square(2000);  // of 1000 paths
  more.AddPaths(-1000);
  Add(&share, more);
  EXPECT_NEAR(Of(share, Square(1000)), BoundOf(.0625), .015);
  SomePhotons weak = Square(60000);  // the first 8192 are used
  weak.AddPaths(600000 - 60000);
  EXPECT_NEAR(Of(share, weak), BoundOf(.1 / 3.1 * (.1 / 3.1)), .001);
}

// Half of the points see indirect light alone. The others have it for half of their light.
TEST_F(IndirectShareTest, IsARootMeanSquareOverThePoints) {
  std::vector<VisiblePoint> points = Points();
  for (const VisiblePoint& point : Points(8)) points.push_back(point);
  IndirectShare share(points);
  Add(&share, Square(4000));
  SomePhotons indirect = Square(1000);
  indirect.Add(Square(1000, 8).Records());
  EXPECT_NEAR(Of(share, indirect), BoundOf((1 + .25) / 2, 2 * kPoints), .02);
}

// Direct photons on the roof, and those that arrive from behind, light no point on the floor.
TEST_F(IndirectShareTest, LeavesOutTheLightOfOtherRooms) {
  SomePhotons weak = Square(500);
  weak.AddPaths(5000000);
  IndirectShare share(Points());
  Add(&share, Square(8000, 0, Real(.41)));
  EXPECT_EQ(Of(share, weak), 1);
  Add(&share, Square(8000, 0, 0, {0, 0, -1}));
  EXPECT_EQ(Of(share, weak), 1);
}

// The other photons of the floor lie beyond the edge of the roof, and so does the farthest one.
TEST_F(IndirectShareTest, CountsLightIfOnePhotonIsSeen) {
  SomePhotons direct = Square(15, 0, Real(.41));  // hidden by the roof, and nearer
  direct.Add(Square(1, 4).Records());
  IndirectShare share(Points());
  Add(&share, direct);
  EXPECT_LT(Of(share, Square(500)), 1);
  SomePhotons hidden = Square(15, 4, Real(.41));  // over the edge of the roof, and farther
  hidden.Add(Square(1).Records());
  IndirectShare nearest(Points());
  Add(&nearest, hidden);
  EXPECT_LT(Of(nearest, Square(500)), 1);
}

// Four points of few are most of them.
TEST_F(IndirectShareTest, IsAllLightIfTheCameraSeesFewPoints) {
  std::vector<VisiblePoint> few = Points();
  few.resize(4);
  IndirectShare share(few);
  Add(&share, Square(5000));
  EXPECT_EQ(Of(share, Square(1000)), 1);
}

TEST(EnoughIndirectPhotons, FollowTheSquareOfTheShare) {
  EXPECT_EQ(EnoughIndirectPhotons(1, 100000), 100000);
  EXPECT_EQ(EnoughIndirectPhotons(.125, 100000), 100000);
  EXPECT_EQ(EnoughIndirectPhotons(.0625, 100000), 25000);
  EXPECT_EQ(EnoughIndirectPhotons(0, 100000), 1000);
  EXPECT_EQ(EnoughIndirectPhotons(0, 500), 500);
}

// Shoots into a scene with a camera that looks down at the origin.
PhotonPassResult ShootInView(const std::string& world, bool hasCamera = true,
                             const std::string& place = "0 -27 18", std::uint64_t seed = 1) {
  const LoadedScene loaded =
      LoadSceneText("LookAt " + place +
                    "  0 0 0  0 0 1 Camera \"perspective\" \"float fov\" 45\n"
                    "Film \"image\" \"integer xresolution\" 64 \"integer yresolution\" 48\n"
                    "WorldBegin\n" +
                    world + "WorldEnd\n");
  const RenderSetup& setup = *loaded.setup;
  ThreadPool threads(1);
  Log log(Log::Level::Normal, Log::Sink::Memory);
  ProgressReporter progress(ProgressReporter::Mode::Quiet);
  Statistics statistics;
  PreprocessContext context{threads, seed, log, progress, statistics, false, nullptr, {}};
  context.camera = hasCamera ? setup.camera.get() : nullptr;
  context.resolution = {64, 48};
  PhotonSettings settings;
  settings.photonRoulette = PhotonRoulette::Luminance;
  settings.guideEmission = true;
  settings.maxPhotonPaths = 1 << 21;
  PhotonTargets targets;
  targets[PhotonKind::Direct] = targets[PhotonKind::Indirect] = 20000;
  if (setup.scene->Features().Needs(Feature::Specular)) targets[PhotonKind::Caustic] = 20000;
  return PhotonTracer(*setup.scene, settings, seed).Shoot(targets, context);
}

const char* const kBallOnAPlain =
    "LightSource \"infinite\" Material \"matte\" Shape \"disk\" \"float radius\" 20\n"
    "Translate 0 0 .3 Shape \"sphere\" \"float radius\" .3\n";

// One path in thousands meets the ball, and its light is little where the camera looks.
TEST(IndirectPhotons, AreFewerWhereTheyCarryLittleLight) {
  const PhotonPassResult chosen = ShootInView(kBallOnAPlain);
  EXPECT_GE(chosen.enoughIndirect, 1000);
  EXPECT_LT(chosen.enoughIndirect, 2000);
  EXPECT_GE(std::int64_t(chosen[PhotonKind::Indirect].photons.Size()), chosen.enoughIndirect);
  const PhotonPassResult full = ShootInView(kBallOnAPlain, false);
  EXPECT_EQ(full.enoughIndirect, 0);
  EXPECT_GE(full[PhotonKind::Indirect].photons.Size(), 20000u);
  EXPECT_LT(2 * chosen.paths, full.paths);
}

// The caustic map resolves its light as if there were all indirect photons (eq. 7d).
TEST(IndirectPhotons, LeaveTheNumberOfCausticOnes) {
  const std::string world =
      "LightSource \"infinite\" Material \"matte\" Shape \"disk\" \"float radius\" 20\n"
      "Translate 0 0 .8 Shape \"sphere\" \"float radius\" .8\n"
      "Material \"glass\" Translate 4 0 0 Shape \"sphere\" \"float radius\" .15\n";
  const PhotonPassResult chosen = ShootInView(world), full = ShootInView(world, false);
  EXPECT_GT(chosen.enoughIndirect, 0);
  EXPECT_GT(full.enoughCaustics, 2000);
  EXPECT_LT(full.enoughCaustics, 20000);
  EXPECT_NEAR(double(chosen.enoughCaustics) / double(full.enoughCaustics), 1, .15);
}

// A house of 8 x 8 with an open door. Its dark room is a hundredth of the picture or less, so few
// points or none lie in it. None of the seeds may leave it without photons.
TEST(IndirectPhotons, DoNotDependOnASmallDarkRoomBeingHit) {
  const auto wall = [](const std::string& points) {
    return "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] \"point P\" [" + points +
           "]\n";
  };
  const std::string house =
      "LightSource \"infinite\" Material \"matte\" Shape \"disk\" \"float radius\" 200\n" +
      wall("-4 -4 0  -1 -4 0  -1 -4 3.5  -4 -4 3.5") + wall("1 -4 0  4 -4 0  4 -4 3.5  1 -4 3.5") +
      wall("-1 -4 2.2  1 -4 2.2  1 -4 3.5  -1 -4 3.5") + wall("-4 4 0  4 4 0  4 4 3.5  -4 4 3.5") +
      wall("-4 -4 0  -4 4 0  -4 4 3.5  -4 -4 3.5") + wall("4 -4 0  4 4 0  4 4 3.5  4 -4 3.5") +
      wall("-4 -4 3.5  4 -4 3.5  4 4 3.5  -4 4 3.5");
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    const PhotonPassResult result = ShootInView(house, true, "0 -100 25", seed);
    ASSERT_TRUE(result[PhotonKind::Indirect].isGuided);
    EXPECT_GE(result[PhotonKind::Indirect].photons.Size(), 4000u) << seed;
  }
}

// A room that a small opening in its roof lights, in a wide plain: one path in thousands enters.
TEST(IndirectPhotons, AreAllShotIntoARoom) {
  const PhotonPassResult room = ShootInView(
      "LightSource \"infinite\" Material \"matte\" Shape \"disk\" \"float radius\" 200\n"
      "Translate 0 0 .01 Shape \"sphere\" \"float radius\" 15 \"float zmax\" 14\n",
      true, "0 -9 6");
  EXPECT_TRUE(room[PhotonKind::Indirect].isGuided);
  EXPECT_EQ(room.enoughIndirect, 0);
  EXPECT_GE(room[PhotonKind::Indirect].photons.Size(), 20000u);
}

}  // namespace
}  // namespace exphoton
