// SPDX-License-Identifier: BSD-2-Clause
// These tests render with an accuracy whose passes share their gathers together before a look.
#include "core/render/passes/render_passes.h"

#include <gtest/gtest.h>

#include "core/base/progress.h"
#include "tests/support/test_scene.h"

namespace exphoton {
namespace {

// Returns the mean radius of the windows of shared gathers; 0: none were shared.
double SharingRadiusAfter(std::int64_t samples) {
  LoadedScene scene = LoadSceneText(
      TestHeader(R"("exphotonmap" "integer indirectphotons" 2000 "integer directphotons" 2000
                    "integer finalgathersamples" 4 "bool sharedgather" "true")",
                 16, 12, 4) +
      FurnaceWorld(1, R"("matte" "color Kd" [ .5 .5 .5 ])"));
  const RenderSetup& setup = *scene.setup;
  Film film(setup.film.Full(), setup.crop);
  Corrections corrections(setup.crop, .1);
  ThreadPool threads(1);
  ProgressReporter progress(ProgressReporter::Mode::Quiet);
  Statistics statistics;
  RenderOptions options;
  options.corrections = &corrections;
  StoppingRule rule;
  rule.maxSamples = samples;
  rule.accuracy = StoppingRule::Accuracy{.error = 1e-4, .firstSamples = 2};
  const RenderJob job{*setup.scene, *setup.integrator, *setup.sampler, *setup.filter, *setup.camera,
                      film,         threads,           *scene.log,     progress,      statistics};
  EXPECT_EQ(RenderInPasses(job, options, rule).samplesPerPixel, samples);
  for (const Statistics::Counter& counter : statistics.Counters())
    if (counter.name == "render/sharing radius") return counter.value;
  return 0;
}

// No look follows the first pass, but the picture may end there.
TEST(FitsBeforeLooks, SharesTheGathersOfASinglePass) { EXPECT_GT(SharingRadiusAfter(2), 0); }

TEST(FitsBeforeLooks, SharesTheGathersOfSeveralPasses) { EXPECT_GT(SharingRadiusAfter(6), 0); }

}  // namespace
}  // namespace exphoton
