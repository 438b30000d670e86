// SPDX-License-Identifier: BSD-2-Clause
// The rays of path tracing: how many of each kind --stats counts, and which the depth limit leaves
// out. Scenes of one surface under a sky, in which the numbers follow from the paths there are.
#include <gtest/gtest.h>

#include "tests/support/test_scene.h"

namespace exphoton {
namespace {

constexpr int kSide = 8, kSamples = 4;
constexpr std::uint64_t kCameraRays = std::uint64_t(kSide) * kSide * kSamples;

// A plane that fills the picture, under a sky.
TestRender PlaneOf(const std::string& material, const std::string& path = "\"path\"") {
  return RenderSceneText(TestHeader(path, kSide, kSide, kSamples) +
                         "WorldBegin LightSource \"infinite\"\nMaterial " + material +
                         "\nTranslate 0 0 1 Shape \"disk\" \"float radius\" 100\nWorldEnd\n");
}
std::uint64_t CountOf(const RayCounters& rays, RayKind kind) {
  return rays.counts[std::size_t(kind)];
}

TEST(RayKinds, OfPathsOverAMirrorAreSpecular) {
  const RayCounters rays = PlaneOf("\"mirror\"").rays;
  EXPECT_EQ(CountOf(rays, RayKind::Camera), kCameraRays);
  EXPECT_EQ(CountOf(rays, RayKind::Specular), kCameraRays);
  EXPECT_EQ(CountOf(rays, RayKind::Bsdf), 0u);
}

TEST(RayKinds, OfPathsOverADiffusePlaneAreOfItsMaterial) {
  const RayCounters rays = PlaneOf("\"matte\"").rays;
  EXPECT_EQ(CountOf(rays, RayKind::Camera), kCameraRays);
  EXPECT_EQ(CountOf(rays, RayKind::Specular), 0u);
  EXPECT_EQ(CountOf(rays, RayKind::Bsdf), kCameraRays);
}

TEST(PathDepth, OfZeroShowsNothingInAMirrorAndOfOneWhatIsThere) {
  const std::string mirror = "\"mirror\" \"color Kr\" [1 1 1]";
  EXPECT_EQ(MeanRadiance(PlaneOf(mirror, "\"path\" \"integer maxdepth\" 0").image), 0);
  EXPECT_NEAR(MeanRadiance(PlaneOf(mirror, "\"path\" \"integer maxdepth\" 1").image), 1, 1e-5);
}

}  // namespace
}  // namespace exphoton
