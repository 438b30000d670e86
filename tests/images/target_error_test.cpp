// SPDX-License-Identifier: BSD-2-Clause
// This test renders the project's scenes with --target-error. The noise measured between five
// renders must match the target. Scenes of lights and mirrors need many passes for a useful
// measurement (docs/decisions/0007-stopping-rules.md), so caustics are path traced here.
#include <gtest/gtest.h>

#include <cmath>

#include "core/render/passes/render_passes.h"
#include "tests/images/reference.h"

namespace exphoton {
namespace {

struct Target {
  const char* scene;
  double error;
  std::vector<ParameterOverride> parameters;
};

PassesResult RenderTo(double target, std::uint64_t seed, LoadedScene& scene, Image* image) {
  RenderSetup& setup = *scene.setup;
  Film film(setup.film.Full(), setup.crop);
  ThreadPool threads(2);
  ProgressReporter progress(ProgressReporter::Mode::Quiet);
  Statistics statistics;
  RenderOptions options;
  options.seed = seed;
  StoppingRule rule;
  rule.targetError = target;
  const PassesResult result =
      RenderInPasses({*setup.scene, *setup.integrator, *setup.sampler, *setup.filter, *setup.camera,
                      film, threads, *scene.log, progress, statistics},
                     options, rule);
  *image = film.ToImage(setup.film.premultiplyAlpha);
  return result;
}

// Returns the mean over pixels and channels of the variance between pictures over (r^2 + .01),
// where r is the mean of the pictures.
double NoiseBetween(const std::vector<Image>& images) {
  const double count = double(images.size());
  double sum = 0, values = 0;
  for (int y = 0; y < images[0].Height(); ++y) {
    for (int x = 0; x < images[0].Width(); ++x) {
      for (int c = 0; c < 3; ++c) {
        double mean = 0, squares = 0;
        for (const Image& image : images) mean += double(image.At(x, y, c)) / count;
        for (const Image& image : images) {
          const double distance = double(image.At(x, y, c)) - mean;
          squares += distance * distance / (count - 1);
        }
        sum += squares / (mean * mean + .01);
        ++values;
      }
    }
  }
  return sum / values;
}

class TargetErrorTest : public testing::TestWithParam<Target> {};

TEST_P(TargetErrorTest, IsTheNoiseBetweenSeeds) {
  LoadOptions load;
  load.parameters = GetParam().parameters;
  load.pixelBounds = PixelBounds{8, 14, 56, 48};  // to save time
  LoadedScene scene = LoadSceneFile(GetParam().scene, load);
  std::vector<Image> images(5);
  double estimated = 0;
  for (std::size_t i = 0; i < images.size(); ++i) {
    const PassesResult result = RenderTo(GetParam().error, 1 + i, scene, &images[i]);
    EXPECT_EQ(result.reason, StopReason::TargetError);
    EXPECT_GT(result.passes, 2);
    estimated += result.noise.value_or(0) / double(images.size());
  }
  // The last pass can bring the noise below the target, so the estimate is compared as well.
  const double measured = NoiseBetween(images);
  EXPECT_GT(measured, GetParam().error / 2);
  EXPECT_GT(measured, estimated / 1.5);
  EXPECT_LT(measured, estimated * 1.5);
  EXPECT_LT(measured, GetParam().error * 1.5);
}

std::string NameOf(const testing::TestParamInfo<Target>& info) {
  const std::string name = info.param.scene;
  return name.substr(0, name.find('-')) + name.substr(name.find('/') + 1) + "To" +
         std::to_string(std::lround(1e6 * info.param.error));
}

// The noise is less than half of some targets, because samples come in groups: with the distant sun
// it is .0045 for .0095, so this target has the spot.
// With .005 the number of samples doubles from 4 to 8, and with .008 the second group is completed
// (docs/decisions/0083-size-of-later-groups.md).
Target RoomTo(double error, const char* scene = "skylight-room/exphotonmap") {
  return {scene, error, {{"SurfaceIntegrator", "indirectphotons", "30000"}}};
}

INSTANTIATE_TEST_SUITE_P(Scenes, TargetErrorTest,
                         testing::Values(RoomTo(.0095, "skylight-room/spot"), RoomTo(.004),
                                         RoomTo(.002)),
                         NameOf);
// ctest calls a test long if its name begins with this word.
INSTANTIATE_TEST_SUITE_P(LongScenes, TargetErrorTest,
                         testing::Values(Target{"cornell-caustic/path", .05, {}}), NameOf);

}  // namespace
}  // namespace exphoton
