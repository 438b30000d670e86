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
  for (std::uint32_t i = 0; i < 64; ++i) {
    const Point2 u = ScrambledSobol2(i, 77);
    points.push_back({{x + Real(.25) + u.x / 2, Real(.25) + u.y / 2, 0}, kUp});
  }
  return points;
}

class IndirectShareTest : public testing::Test {
 protected:
  double Of(const IndirectShare& share, const SomePhotons& indirect) {
    return share.Of(indirect, threads_);
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
  EXPECT_NEAR(Of(share, Square(1000)), .5, .02);
  SomePhotons more = Square(2000);  // of 1000 paths
  more.AddPaths(-1000);
  Add(&share, more);
  EXPECT_NEAR(Of(share, Square(1000)), .25, .015);
  SomePhotons weak = Square(60000);  // the first 8192 are used
  weak.AddPaths(6000000 - 60000);
  EXPECT_NEAR(Of(share, weak), .01 / 3.01, .0003);
}

// Half of the points see indirect light alone. The others have it for half of their light.
TEST_F(IndirectShareTest, IsARootMeanSquareOverThePoints) {
  std::vector<VisiblePoint> points = Points();
  for (const VisiblePoint& point : Points(8)) points.push_back(point);
  IndirectShare share(points);
  Add(&share, Square(4000));
  SomePhotons indirect = Square(1000);
  indirect.Add(Square(1000, 8).Records());
  EXPECT_NEAR(Of(share, indirect), std::sqrt((1 + .25) / 2), .02);
}

// Direct photons on the roof, and those that arrive from behind, light no point on the floor.
TEST_F(IndirectShareTest, LeavesOutTheLightOfOtherRooms) {
  IndirectShare share(Points());
  Add(&share, Square(8000, 0, Real(.41)));
  EXPECT_EQ(Of(share, Square(500)), 1);
  Add(&share, Square(8000, 0, 0, {0, 0, -1}));
  EXPECT_EQ(Of(share, Square(500)), 1);
}

TEST_F(IndirectShareTest, IsAllLightIfItIsNotKnown) {
  IndirectShare share(Points());
  Add(&share, Square(5000));
  EXPECT_LT(Of(share, Square(16)), 1);
  EXPECT_EQ(Of(share, Square(15)), 1);
  std::vector<VisiblePoint> few = Points();
  few.resize(15);
  IndirectShare ofFew(few);
  Add(&ofFew, Square(5000));
  EXPECT_EQ(Of(ofFew, Square(1000)), 1);
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
                             const std::string& place = "0 -27 18") {
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
  PreprocessContext context{threads, 1, log, progress, statistics, false, nullptr, {}};
  context.camera = hasCamera ? setup.camera.get() : nullptr;
  context.resolution = {64, 48};
  PhotonSettings settings;
  settings.photonRoulette = PhotonRoulette::Luminance;
  settings.guideEmission = true;
  settings.maxPhotonPaths = 1 << 21;
  PhotonTargets targets;
  targets[PhotonKind::Direct] = targets[PhotonKind::Indirect] = 20000;
  if (setup.scene->Features().Needs(Feature::Specular)) targets[PhotonKind::Caustic] = 20000;
  return PhotonTracer(*setup.scene, settings, 1).Shoot(targets, context);
}

const char* const kBallOnAPlain =
    "LightSource \"infinite\" Material \"matte\" Shape \"disk\" \"float radius\" 20\n"
    "Translate 0 0 .3 Shape \"sphere\" \"float radius\" .3\n";

// One path in thousands meets the ball, and its light is little where the camera looks.
TEST(IndirectPhotons, AreFewerWhereTheyCarryLittleLight) {
  const PhotonPassResult chosen = ShootInView(kBallOnAPlain);
  EXPECT_EQ(chosen.enoughIndirect, 1000);
  EXPECT_GE(chosen[PhotonKind::Indirect].photons.Size(), 1000u);
  EXPECT_LT(chosen[PhotonKind::Indirect].photons.Size(), 2000u);
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
