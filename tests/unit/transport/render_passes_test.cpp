// SPDX-License-Identifier: BSD-2-Clause
// These tests render in passes with an integrator of known noise. One part of the noise belongs to
// each camera sample, and one part to each pass, as with photons.
#include "core/render/passes/render_halves.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <thread>
#include <utility>
#include <vector>

#include "core/render/certificate/corrections.h"
#include "tests/support/test_plugin.h"
#include "tests/support/test_scene.h"

namespace exphoton {
namespace {

constexpr PixelBounds kBounds{0, 0, 48, 36};

class NoisyIntegrator final : public SurfaceIntegrator {
 public:
  void Preprocess(const Scene&, PreprocessContext& context) override {
    passSeed_ = context.seed;
    seeds.insert(context.seed);
    begun.push_back(std::chrono::steady_clock::now());
    if (sleep > 0) std::this_thread::sleep_for(std::chrono::milliseconds(sleep));
  }
  Spectrum Li(const RayDifferential& ray, LiContext& context) const override {
    RandomStream random = context.Stream(1);
    if (keepsRays) rays.push_back({ray.d.x, ray.d.y});
    RandomStream blotch(HashKey({passSeed_, std::uint64_t(100 + int(blotches * ray.d.x)),
                                 std::uint64_t(100 + int(blotches * ray.d.y))}));
    const Spectrum light(1 + sampleNoise * (random.Uniform() - Real(.5)) +
                         passNoise * (blotch.Uniform() - Real(.5)));
    if (context.signedLight)
      *context.signedLight += Spectrum(passNoise * (blotch.Uniform() - Real(.5)) +
                                       sampleNoise * (random.Uniform() - Real(.5)) / 8);
    if (context.correction) {
      context.correction->sum += Spectrum(correction * (Real(.9) + random.Uniform() / 5));
      ++context.correction->count;
    }
    return light;
  }
  bool FillsSignedLight() const override { return fillsSignedLight; }

  Real sampleNoise = 1, passNoise = Real(.5);
  Real blotches = 100;  // per unit of direction; they have the noise of a pass
  Real correction = 0;  // mean of a sample
  int sleep = 0;        // milliseconds per preprocessing
  bool keepsRays = false, fillsSignedLight = false;
  mutable std::vector<std::pair<Real, Real>> rays;  // recorded with one thread only
  std::set<std::uint64_t> seeds;
  std::vector<std::chrono::steady_clock::time_point> begun;  // of each preprocessing

 private:
  std::uint64_t passSeed_ = 0;
};

class RenderPassesTest : public testing::Test {
 protected:
  RenderPassesTest() : scene_(Empty()) {
    filter_ = plugins_.MakeFilter(R"("box")");
    camera_ = plugins_.MakeCamera(R"("perspective")", {}, 48, 36);
    sampler_ = plugins_.MakeSampler(R"("lowdiscrepancy" "integer pixelsamples" 16)");
  }
  static SceneParts Empty() {
    SceneParts parts;
    parts.primitives = std::make_unique<PrimitiveSet>();
    return parts;
  }
  template <class Work>  // PassesResult(const RenderJob&, const RenderOptions&)
  PassesResult With(int threads, std::uint64_t seed, const Work& work) {
    Film film(kBounds, kBounds);
    ThreadPool pool(threads);
    ProgressReporter progress(ProgressReporter::Mode::Quiet);
    Statistics statistics;
    RenderOptions options;
    options.seed = seed;
    const PassesResult result = work(RenderJob{scene_, integrator_, *sampler_, *filter_, *camera_,
                                               film, pool, log_, progress, statistics},
                                     options);
    image_ = film.ToImage(true);
    return result;
  }
  PassesResult Run(const StoppingRule& rule, int threads = 1, std::uint64_t seed = 1) {
    return With(threads, seed, [&](const RenderJob& job, const RenderOptions& options) {
      return RenderInPasses(job, options, rule);
    });
  }

  TestPlugins plugins_;
  Log log_{Log::Level::Normal, Log::Sink::Memory};
  Scene scene_;
  NoisyIntegrator integrator_;
  std::unique_ptr<Filter> filter_;
  std::unique_ptr<Camera> camera_;
  std::unique_ptr<Sampler> sampler_;
  Image image_;
};

TEST_F(RenderPassesTest, ReachesTheTargetWithoutGoingMuchBeyond) {
  for (const double target : {.02, .003, .0005}) {
    std::vector<Image> images;
    StoppingRule rule;
    rule.targetError = target;
    rule.maxSamples = 1 << 14;  // ends a run whose noise does not fall
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      const PassesResult result = Run(rule, 2, seed);
      EXPECT_EQ(result.reason, StopReason::TargetError);
      EXPECT_LE(*result.noise, target);
      EXPECT_GT(*result.noise, target / 1.5);
      images.push_back(image_);
    }
    // The noise between seeds is measured from the finished pictures.
    double sum = 0;
    for (std::size_t i = 0; i < image_.pixels.size(); i += 4) {
      double mean = 0, square = 0;
      for (const Image& image : images) mean += double(image.pixels[i]) / 5;
      for (const Image& image : images)
        square += (double(image.pixels[i]) - mean) * (double(image.pixels[i]) - mean) / 4;
      sum += square / (1 + .01);
    }
    const double measured = 4 * sum / double(image_.pixels.size());
    EXPECT_LT(measured, 1.5 * target);
    EXPECT_GT(measured, target / 1.5);
  }
}

TEST_F(RenderPassesTest, ATargetAloneGivesTheSameBitsForAnyNumberOfThreads) {
  for (const char* sampler :
       {R"("lowdiscrepancy" "integer pixelsamples" 16)", R"("stratified")", R"("random")"}) {
    sampler_ = plugins_.MakeSampler(sampler);
    StoppingRule rule;
    rule.targetError = .002;
    rule.maxSamples = 1 << 14;  // ends a run whose noise does not fall
    const PassesResult one = Run(rule, 1);
    const std::vector<float> expected = image_.pixels;
    const PassesResult three = Run(rule, 3);
    EXPECT_EQ(image_.pixels, expected) << sampler;
    EXPECT_EQ(one.passes, three.passes);
    EXPECT_EQ(*one.noise, *three.noise);
    EXPECT_GT(one.passes, 4);
  }
}

TEST_F(RenderPassesTest, GroupsOfPassesSharePhotons) {
  StoppingRule rule;
  rule.targetError = .002;
  rule.maxSamples = 1 << 14;  // ends a run whose noise does not fall
  const PassesResult result = Run(rule);
  EXPECT_GE(integrator_.seeds.size(), 2u);
  EXPECT_LT(integrator_.seeds.size(), std::size_t(result.passes));
}

// Blotches are larger than pixels. The variance of a uniform number is 1/12, so the photons cause a
// noise of at most .1^2 / 12 of relMSE.
TEST_F(RenderPassesTest, KeepsPhotonsOfLittleNoiseAndCountsTheirNoise) {
  integrator_.fillsSignedLight = true;
  integrator_.blotches = 10;
  integrator_.passNoise = Real(.1);
  std::vector<std::vector<float>> images;
  StoppingRule rule;
  rule.targetError = .004;
  rule.maxSamples = 1 << 14;  // ends a run whose noise does not fall
  double estimated = 0, variances = 0;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    integrator_.seeds.clear();
    const PassesResult result = Run(rule, 1, seed);
    EXPECT_EQ(result.reason, StopReason::TargetError);
    EXPECT_EQ(integrator_.seeds.size(), 1u);
    estimated += *result.noise / 8;
    images.push_back(image_.pixels);
  }
  for (std::size_t i = 0; i < image_.pixels.size(); i += 4) {
    double mean = 0, squares = 0;
    for (const auto& image : images) mean += double(image[i]) / 8;
    for (const auto& image : images) squares += std::pow(double(image[i]) - mean, 2) / 7;
    variances += squares / (1.01 * 48 * 36);
  }
  EXPECT_NEAR(variances / estimated, 1, .1);
}

TEST_F(RenderPassesTest, ShootsAgainWherePhotonsCauseTheNoise) {
  integrator_.fillsSignedLight = true;
  integrator_.blotches = 10;
  StoppingRule rule;
  rule.targetError = .004;  // the noise of the photons is up to .02
  rule.maxSamples = 1 << 14;
  const PassesResult result = Run(rule);
  EXPECT_EQ(result.reason, StopReason::TargetError);
  EXPECT_GE(integrator_.seeds.size(), 4u);
  // The photons decide, so there is no reason to measure their noise and others as well.
  integrator_.fillsSignedLight = false;
  const std::vector<float> expected = image_.pixels;
  Run(rule);
  EXPECT_EQ(image_.pixels, expected);
}

// The squared bias is .56 of the accuracy's. More photons take less time than the samples that make
// up for it, but samples can reach the accuracy.
TEST_F(RenderPassesTest, StopsForALikelyBiasOnlyWhereItMayBeginAgain) {
  integrator_.passNoise = 0;
  integrator_.correction = Real(.03);
  for (const bool stops : {true, false}) {
    StoppingRule rule;
    rule.accuracy = StoppingRule::Accuracy{.04, 4};
    rule.accuracy->stopsForLikelyBias = stops;
    rule.maxSamples = 1 << 14;  // ends a run whose noise does not fall
    const PassesResult result = With(1, 1, [&](const RenderJob& job, RenderOptions options) {
      Corrections corrections(kBounds, 1);
      options.corrections = &corrections;
      return RenderInPasses(job, options, rule);
    });
    EXPECT_EQ(result.reason, stops ? StopReason::Bias : StopReason::Accuracy);
    EXPECT_EQ(result.samplesPerPixel == 8, stops) << result.samplesPerPixel;
    ASSERT_TRUE(result.upperError);
    EXPECT_EQ(*result.upperError > .04 * .04, stops);
  }
}

TEST_F(RenderPassesTest, UsesPhotonsThatAnotherRendererPrepared) {
  const auto render = [&](std::optional<std::uint64_t> prepared, std::uint64_t photonSeed) {
    With(1, 1, [&](const RenderJob& job, RenderOptions options) {
      options.preparedSeed = prepared;
      PassRenderer(job, options).Run({photonSeed, 9, 0, 4}, job.sampler, &job.film);
      return PassesResult();
    });
    return image_.pixels;
  };
  const auto first = render({}, 7);
  integrator_.seeds.clear();
  EXPECT_EQ(render(7, 7), first);
  EXPECT_TRUE(integrator_.seeds.empty());
  EXPECT_NE(render(7, 8), first);
  EXPECT_EQ(integrator_.seeds, std::set<std::uint64_t>{8});
}

TEST_F(RenderPassesTest, StopsAtTheLimitOfSamples) {
  StoppingRule rule;
  rule.targetError = 1e-9;
  rule.maxSamples = 20;
  const PassesResult result = Run(rule);
  EXPECT_EQ(result.reason, StopReason::Samples);
  EXPECT_EQ(result.samplesPerPixel, 20);
  EXPECT_TRUE(result.render.isComplete);
}

// Whatever is left for the last pass.
TEST_F(RenderPassesTest, TakesNoSampleBeyondTheLimit) {
  for (const std::int64_t limit : {7, 21, 37}) {
    StoppingRule rule;
    rule.targetError = 1e-9;
    rule.maxSamples = limit;
    EXPECT_EQ(Run(rule).samplesPerPixel, limit);
  }
}

// Each pass continues the sampler's sequence where the last pass of its group ended.
TEST_F(RenderPassesTest, TakesNoCameraSampleTwice) {
  StoppingRule rule;
  rule.targetError = 1e-9;
  rule.maxSamples = 64;
  integrator_.keepsRays = true;
  const PassesResult result = Run(rule);
  EXPECT_GT(result.passes, 4);
  auto& rays = integrator_.rays;
  ASSERT_EQ(rays.size(), 48u * 36 * 64);
  std::sort(rays.begin(), rays.end());
  const auto repeated = rays.end() - std::unique(rays.begin(), rays.end());
  EXPECT_LT(repeated, 100);  // equal by rounding
}

TEST_F(RenderPassesTest, StopsInTimeAndCountsPreprocessing) {
  integrator_.sleep = 20;
  StoppingRule rule;
  rule.timeLimit = .5;
  rule.start = std::chrono::steady_clock::now();
  const PassesResult result = Run(rule);
  EXPECT_EQ(result.reason, StopReason::TimeLimit);
  EXPECT_LE(result.passes, 25);  // each has 20 ms of preprocessing
  EXPECT_GE(result.passes, 1);
  // On a busy machine, the limit can pass between the last look at the clock and the preprocessing.
  const auto late = std::ranges::count_if(integrator_.begun, [&](const auto& time) {
    return time - rule.start > std::chrono::milliseconds(500);
  });
  EXPECT_LE(late, 1);
}

// At .9 s or later there is no time for a fourth preprocessing of .3 s.
TEST_F(RenderPassesTest, BeginsNoPassWhosePreprocessingIsTooLong) {
  integrator_.sleep = 300;
  StoppingRule rule;
  rule.timeLimit = 1;
  rule.start = std::chrono::steady_clock::now();
  Run(rule);
  EXPECT_LE(integrator_.seeds.size(), 3u);
}

TEST_F(RenderPassesTest, RendersOnePassWhereThereIsNoTimeAtAll) {
  StoppingRule rule;
  rule.timeLimit = 1e-6;
  rule.start = std::chrono::steady_clock::now();
  const PassesResult result = Run(rule);
  EXPECT_EQ(result.passes, 1);
  EXPECT_EQ(result.samplesPerPixel, 1);
  EXPECT_FALSE(result.noise);
  EXPECT_GT(image_.At(47, 35, 0), 0);
}

TEST_F(RenderPassesTest, TwoHalvesAreIndependentAndMeetInThePicture) {
  integrator_.passNoise = 0;
  Film first(kBounds, kBounds), second(kBounds, kBounds);
  const PassesResult result = With(2, 1, [&](const RenderJob& job, const RenderOptions& options) {
    return RenderTwoHalves(job, options, &first, &second);
  });
  EXPECT_EQ(result.passes, 2);
  EXPECT_EQ(result.samplesPerPixel, 16);
  EXPECT_EQ(integrator_.seeds.size(), 2u);
  const Image a = first.ToImage(true), b = second.ToImage(true);
  EXPECT_NE(a.pixels, b.pixels);
  for (std::size_t i = 0; i < a.pixels.size(); ++i)
    ASSERT_NEAR(image_.pixels[i], (a.pixels[i] + b.pixels[i]) / 2, 1e-5);
  // A sample has the variance 1/12, and 1728 pixels give it to 6 % or better.
  EXPECT_NEAR(*result.noise * 1.01 * 12 * 16, 1, .2);
}

// A medium of depth 2 that emits .5 a unit of length and absorbs nothing.
TEST(RenderInPassesOfMedia, KeepTheLightThatMediaEmit) {
  const LoadedScene loaded = LoadSceneText(
      TestHeader("\"path\"", 4, 4, 1) +
      "VolumeIntegrator \"emission\" \"float stepsize\" .1\nWorldBegin\n"
      "Volume \"homogeneous\" \"point p0\" [-90 -90 2] \"point p1\" [90 90 4]\n"
      "  \"color sigma_a\" [0 0 0] \"color sigma_s\" [0 0 0] \"color Le\" [.5 .5 .5]\n"
      "WorldEnd\n");
  RenderSetup& setup = *loaded.setup;
  Film film(setup.film.Full(), setup.crop);
  ThreadPool threads(1);
  ProgressReporter progress(ProgressReporter::Mode::Quiet);
  Statistics statistics;
  StoppingRule rule;
  rule.targetError = 1e-9;
  rule.maxSamples = 4;
  RenderInPasses({*setup.scene, *setup.integrator, *setup.sampler, *setup.filter, *setup.camera,
                  film, threads, *loaded.log, progress, statistics, setup.volumeIntegrator.get()},
                 {}, rule);
  // A ray through (x, y) of the image plane has the length 2 sqrt(1 + x^2 + y^2) in the medium; the
  // mean of the root over the square from -1 to 1 is 1.2808. 64 samples know it to .02.
  EXPECT_NEAR(MeanRadiance(film.ToImage(true)), 1.2808, .06);
}

}  // namespace
}  // namespace exphoton
