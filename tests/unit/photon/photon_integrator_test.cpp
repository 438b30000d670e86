// SPDX-License-Identifier: BSD-2-Clause
// PhotonIntegrator: requesting samples does not undo what Preprocess made.
#include "integrators/photon/photon_integrator.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "core/base/log.h"
#include "core/base/parallel.h"
#include "core/base/progress.h"
#include "tests/support/test_scene.h"

namespace exphoton {
namespace {

// A lamp behind a wall lights one side of a box, so that gather rays are guided to it.
const char* const kBox =
    "SurfaceIntegrator \"exphotonmap\"\nWorldBegin\nLightSource \"spot\" \"point from\" [0 0 0] "
    "\"point to\" [1 0 0]\n"
    "Shape \"sphere\" \"float radius\" 3\nWorldEnd\n";

// Radiance along a few rays, after the calls in either order.
std::vector<Spectrum> Radiances(bool requestsLast) {
  const LoadedScene loaded = LoadSceneText(kBox);
  const Scene& scene = *loaded.setup->scene;
  PhotonSettings settings;
  settings.radiancePhotons = true;
  settings.gatherSampling = GatherSampling::Photons;
  settings.indirectPhotons = 2000;
  PhotonIntegrator integrator(settings);

  ThreadPool threads(1);
  Log log(Log::Level::Normal, Log::Sink::Memory);
  ProgressReporter progress(ProgressReporter::Mode::Quiet);
  Statistics statistics;
  PreprocessContext preprocess{threads, 1, log, progress, statistics, false, nullptr, {}};
  if (requestsLast) integrator.Preprocess(scene, preprocess);
  SampleLayout layout;
  integrator.RequestSamples(scene, *loaded.setup->sampler, &layout);
  if (!requestsLast) integrator.Preprocess(scene, preprocess);

  std::vector<Spectrum> found;
  Arena arena;
  RayCounters rays;
  ThreadState threadState;  // holds the guide cache, whose cells are as wide as Preprocess chose
  for (int i = 0; i < 8; ++i) {
    CameraSamples samples(layout);
    loaded.setup->sampler->Generate({1, {i, 0}, 0}, &samples);
    LiContext context{scene, samples, arena, rays, std::uint64_t(i)};
    context.threadState = &threadState;
    const Vector3 d = Normalize(Vector3(-1, Real(i) / 8, Real(.3)));
    found.push_back(integrator.Li(RayDifferential(Ray(Point3(), d)), context));
  }
  return found;
}

TEST(PhotonIntegrator, GuidesGatherRaysAlsoWhereSamplesAreRequestedAfterPreprocess) {
  const std::vector<Spectrum> before = Radiances(false), after = Radiances(true);
  double sum = 0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    EXPECT_EQ(before[i], after[i]) << i;
    sum += double(before[i].Y());
  }
  EXPECT_GT(sum, 0);
}

TEST(PhotonIntegrator, CertifiesNoBlurOfADirectMapThatTheCameraSees) {
  const LoadedScene loaded = LoadSceneText(kBox);
  PhotonSettings settings;
  const std::string blur =
      "the blur of the direct map where light changes within the search radius";
  const auto count = [&] {
    const auto limits = PhotonIntegrator(settings).Certification(*loaded.setup->scene);
    return std::ranges::count(limits->notCovered, blur);
  };
  EXPECT_EQ(count(), 0);
  settings.directWithPhotons = true;
  EXPECT_EQ(count(), 1);
}

}  // namespace
}  // namespace exphoton
