// SPDX-License-Identifier: BSD-2-Clause
// These tests count the camera rays of successive passes. The specular trees that look for
// reflected lamps are not in the counters of a render.
#include <gtest/gtest.h>

#include <atomic>
#include <vector>

#include "tests/support/test_scene.h"

namespace exphoton {
namespace {

class CountingCamera final : public Camera {
 public:
  explicit CountingCamera(const Camera& camera) : camera_(camera) {}
  RayDifferential GenerateRay(const CameraSample& sample, bool withDifferentials) const override {
    ++rays;
    return camera_.GenerateRay(sample, withDifferentials);
  }
  const Transform& CameraToWorld() const override { return camera_.CameraToWorld(); }
  Matrix4 WorldToNdc() const override { return camera_.WorldToNdc(); }

  mutable std::atomic<std::int64_t> rays{0};

 private:
  const Camera& camera_;
};

// A lamp behind the camera, which a mirror shows.
std::string LampInAMirror() {
  return TestHeader(
             "\"exphotonmap\" \"integer indirectphotons\" 0 \"integer causticphotons\" 0 "
             "\"bool finalgather\" \"false\"",
             12, 8, 2) +
         "WorldBegin\nAttributeBegin\nAreaLightSource \"area\"\nTranslate .2 .4 -1 Shape "
         "\"sphere\" \"float radius\" .3\nAttributeEnd\nMaterial \"mirror\"\nTranslate 0 0 1 Shape "
         "\"disk\" \"float radius\" 3\nWorldEnd\n";
}

// Returns the number of camera rays of each pass.
std::vector<std::int64_t> RaysOfPasses(const std::vector<std::uint64_t>& seeds) {
  const LoadedScene scene = LoadSceneText(LampInAMirror());
  const RenderSetup& setup = *scene.setup;
  const CountingCamera camera(*setup.camera);
  Film film(setup.film.Full(), setup.crop);
  ThreadPool threads(2);
  ProgressReporter progress(ProgressReporter::Mode::Quiet);
  Statistics statistics;
  const RenderJob job{*setup.scene, *setup.integrator, *setup.sampler, *setup.filter, camera,
                      film,         threads,           *scene.log,     progress,      statistics};
  const RenderOptions options;
  PassRenderer renderer(job, options);
  std::vector<std::int64_t> rays;
  for (const std::uint64_t seed : seeds) {
    const std::int64_t before = camera.rays;
    renderer.Run({1, seed, 0, 2}, *setup.sampler, &film);
    rays.push_back(camera.rays - before);
  }
  renderer.Finish();
  return rays;
}

TEST(StillEmitterPasses, LookForReflectionsInTheFirstPassOnly) {
  const std::vector<std::int64_t> rays = RaysOfPasses({7, 7, 8, 9});
  // Each pixel of the picture and of the margin of its filter has four trees, if it has a mirror.
  EXPECT_GT(rays[0], rays[1] + 3 * 12 * 8);
  for (const std::size_t pass : {2u, 3u}) EXPECT_EQ(rays[pass], rays[1]);
}

}  // namespace
}  // namespace exphoton
