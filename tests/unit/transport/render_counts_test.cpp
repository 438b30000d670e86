// SPDX-License-Identifier: BSD-2-Clause
// These tests check what a render counts, says and writes into AOVs, with an integrator whose
// values are chosen by hand: samples that are dropped or negative, cut paths, and the first
// surface.
#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "core/render/passes/render_halves.h"
#include "core/render/render.h"
#include "tests/support/test_plugin.h"
#include "tests/support/test_scene.h"

namespace exphoton {
namespace {

class GivenIntegrator final : public SurfaceIntegrator {
 public:
  Spectrum Li(const RayDifferential&, LiContext& context) const override { return li(context); }
  std::function<Spectrum(LiContext&)> li;
};

class RenderCounts : public testing::Test {
 protected:
  RenderCounts() : scene_(EmptyScene()) {
    filter_ = plugins_.MakeFilter(R"("box")");
    camera_ = plugins_.MakeCamera(R"("perspective")", {}, 3, 2);
    sampler_ = plugins_.MakeSampler(R"("random" "integer xsamples" 1 "integer ysamples" 1)");
  }
  static SceneParts EmptyScene() {
    SceneParts parts;
    parts.primitives = std::make_unique<PrimitiveSet>();
    auto aggregate = TestPlugins().MakeAccelerator(R"("bruteforce")", *parts.primitives);
    parts.aggregate = std::move(aggregate);
    return parts;
  }
  RenderJob Job() {
    return {scene_, integrator_, *sampler_, *filter_,  *camera_,
            film_,  threads_,    log_,      progress_, statistics_};
  }
  RenderResult Render(const RenderOptions& options = {}) {
    return exphoton::Render(Job(), options);
  }
  double Counter(const std::string& name) const {
    for (const auto& counter : statistics_.Counters())
      if (counter.name == name) return counter.value;
    return -1;
  }

  TestPlugins plugins_;
  Log log_{Log::Level::Normal, Log::Sink::Memory};
  Scene scene_;
  GivenIntegrator integrator_;
  Film film_{{0, 0, 3, 2}, {0, 0, 3, 2}};
  ThreadPool threads_{1};
  ProgressReporter progress_{ProgressReporter::Mode::Quiet};
  Statistics statistics_;
  std::unique_ptr<Filter> filter_;
  std::unique_ptr<Camera> camera_;
  std::unique_ptr<Sampler> sampler_;
};

constexpr Real kNan = std::numeric_limits<Real>::quiet_NaN();

// The fourth sample is not finite, the fifth is negative in green.
TEST_F(RenderCounts, OfOddSamplesAreExactAndSaid) {
  int sample = 0;
  integrator_.li = [&](LiContext& context) {
    ++sample;
    if (context.aovs)
      context.aovs->direct = context.aovs->indirect = context.aovs->specular =
          context.aovs->caustic = context.aovs->emission = Spectrum(2);
    return sample == 4   ? Spectrum(1, kNan, Real(.5))
           : sample == 5 ? Spectrum(3, -1, 4)
                         : Spectrum(Real(sample));
  };
  AovFilm aovs({0, 0, 3, 2}, kLightAovs);
  std::atomic<bool> begun = false;
  RenderOptions options;
  options.seed = 42;
  options.aovs = &aovs;
  options.pixelsBegun = &begun;
  const RenderResult result = Render(options);
  EXPECT_TRUE(begun);
  EXPECT_TRUE(result.isComplete);
  EXPECT_EQ(result.nonFiniteSamples, 1);
  EXPECT_EQ(result.nonFiniteReports,
            (std::vector<std::string>{"radiance (1, nan, 0.5) at pixel 0,1, sample 0, seed 42"}));
  EXPECT_EQ(log_.Messages(),
            (std::vector<std::string>{
                "exphoton: warning: dropped a non-finite radiance (1, nan, 0.5) at pixel 0,1, "
                "sample 0, seed 42\n",
                "exphoton: warning: 1 non-finite camera samples were dropped and count as "
                "black\n"}));
  EXPECT_EQ(Counter("render/camera samples"), 6);
  EXPECT_EQ(Counter("render/non-finite samples"), 1);
  EXPECT_EQ(Counter("render/negative samples"), 1);
  Image image = film_.ToImage(true);
  aovs.AppendTo(film_, true, &image);
  const float expected[6][3] = {{1, 1, 1}, {2, 2, 2}, {3, 3, 3}, {0, 0, 0}, {3, 0, 4}, {6, 6, 6}};
  for (int i = 0; i < 6; ++i) {
    for (int c = 0; c < 3; ++c) {
      EXPECT_FLOAT_EQ(image.At(i % 3, i / 3, c), expected[i][c]) << i;
      for (const char* name : {"emission", "direct", "caustic", "indirect", "specular"}) {
        const int first = image.FindChannel(std::string(name) + ".R");
        ASSERT_GE(first, 0) << name;
        const float part = i == 3 || (i == 4 && c == 1) ? 0 : 2;
        EXPECT_FLOAT_EQ(image.At(i % 3, i / 3, first + c), part) << name << i << c;
      }
    }
    EXPECT_EQ(image.At(i % 3, i / 3, 3), 1);
  }
}

TEST_F(RenderCounts, OfAlphaLeaveOutWhatIsNotFinite) {
  int sample = 0;
  integrator_.li = [&](LiContext& context) {
    const Real alphas[] = {0, Real(.5), kNan, kInfinity, 1, 0};
    context.alpha = alphas[sample++];
    return Spectrum(1);
  };
  Render();
  const Image image = film_.ToImage(false);
  const float expected[] = {0, .5, 1, 1, 1, 0};
  for (int i = 0; i < 6; ++i) EXPECT_EQ(image.At(i % 3, i / 3, 3), expected[i]) << i;
}

// The share is of all light, or of the gather rays. It must exceed a thousandth even without its
// standard error, which is 1/sqrt(n) if n of the six samples miss the same light.
TEST_F(RenderCounts, OfCutPathsBecomeWarnings) {
  const auto messages = [&](std::vector<double> cutLight, double gather, int gatherRays) {
    Log log(Log::Level::Normal, Log::Sink::Memory);
    cutLight.resize(6);
    std::size_t sample = 0;
    integrator_.li = [&](LiContext& context) {
      EXPECT_TRUE(context.measuresCutLight);
      context.cutLight = cutLight[sample];
      if (sample++ == 0) {
        context.rays.cutGatherThroughput = gather;
        context.rays.counts[std::size_t(RayKind::Gather)] = std::uint64_t(gatherRays);
      }
      return Spectrum(1);
    };
    Statistics statistics;
    const RenderJob job{scene_, integrator_, *sampler_, *filter_,  *camera_,
                        film_,  threads_,    log,       progress_, statistics};
    exphoton::Render(job, {});
    return log.Messages();
  };
  const std::string hint = "\n    hint: raise \"maxdepth\"\n";
  const auto saidOf = [&](const std::string& share, const std::string& what) {
    return "exphoton: warning: the integrator: the depth limit \"maxdepth\" cut about " + share +
           " % of " + what + hint;
  };
  using Texts = std::vector<std::string>;
  const auto all = [](double light) { return std::vector<double>(6, light); };
  const std::string light = "the light", gathered = "the light of gather rays";
  EXPECT_EQ(messages({}, 0, 0), Texts{});
  EXPECT_EQ(messages(all(.0016), 0, 0), Texts{});
  EXPECT_EQ(messages(all(.0018), 0, 0), Texts{saidOf("0.18", light + " (standard error 0.073 %)")});
  EXPECT_EQ(messages(all(30), 0, 0), Texts{saidOf("97", light)});
  EXPECT_EQ(messages({1000}, 0, 0), Texts{});  // a single bright path
  EXPECT_EQ(messages({0, 3, 3}, 0, 0), Texts{saidOf("50", light + " (standard error 18 %)")});
  EXPECT_EQ(messages({}, .009, 10), Texts{});
  EXPECT_EQ(messages({}, 2, 10), Texts{saidOf("20", gathered)});
  EXPECT_EQ(messages({}, .5, 0), Texts{saidOf("50", gathered)});
}

TEST_F(RenderCounts, OfASeedOfAPassNameTheUsersSeedFirst) {
  integrator_.li = [](LiContext&) { return Spectrum(kInfinity); };
  RenderOptions options;
  options.seed = 7;
  Film half(film_.Full(), film_.Crop());
  const RenderJob job = Job();
  PassRenderer renderer(job, options);
  renderer.Run({5, 9, 3, 2}, *sampler_, &half);
  const RenderResult result = renderer.Finish();
  ASSERT_EQ(result.nonFiniteReports.size(), 8u);
  EXPECT_EQ(result.nonFiniteReports[0],
            "radiance (inf, inf, inf) at pixel 0,0, sample 3, seed 7 (of a pass: 9)");
  EXPECT_EQ(result.nonFiniteReports[3],
            "radiance (inf, inf, inf) at pixel 1,0, sample 4, seed 7 (of a pass: 9)");
  EXPECT_EQ(result.nonFiniteSamples, 12);
}

TEST(StopReasons, HaveTheirNames) {
  EXPECT_STREQ(StopReasonName(StopReason::Samples), "samples");
  EXPECT_STREQ(StopReasonName(StopReason::TargetError), "target-error");
  EXPECT_STREQ(StopReasonName(StopReason::TimeLimit), "time-limit");
  EXPECT_STREQ(StopReasonName(StopReason::Signal), "signal");
}

// A halved pattern, with one sample left over rounded up.
TEST_F(RenderCounts, OfTwoHalvesRoundUp) {
  integrator_.li = [](LiContext&) { return Spectrum(1); };
  sampler_ = sampler_->WithSamplesPerPixel(5);
  Film a(film_.Full(), film_.Crop()), b(film_.Full(), film_.Crop());
  const PassesResult result = RenderTwoHalves(Job(), {}, &a, &b);
  EXPECT_EQ(result.samplesPerPixel, 6);
  EXPECT_EQ(result.passes, 2);
  EXPECT_EQ(result.reason, StopReason::Samples);
  EXPECT_EQ(result.noise, 0.);
  EXPECT_TRUE(result.variances.empty());
  EXPECT_EQ(Counter("render/camera samples"), 36);
}

// A sphere of radius 1 at z = 5, seen from the origin along +z, before a wall at z = 9.
TEST(SurfaceAovs, AreThoseOfTheFirstSurface) {
  TestRenderOptions options;
  std::string unknown;
  options.aovs = *ParseAovs("albedo,N,P", &unknown);
  const TestRender render = RenderSceneText(
      TestHeader("\"directlighting\"", 9, 9, 1) +
          "WorldBegin LightSource \"point\" Material \"matte\" \"color Kd\" [.2 .4 .6]\n"
          "Translate 0 0 5 Shape \"sphere\" \"float radius\" 1\n"
          "WorldEnd",
      options);
  const auto at = [&](int x, int y, const char* name) {
    const int first = render.image.FindChannel(name);
    EXPECT_GE(first, 0) << name;
    return Vec3(render.image.At(x, y, first), render.image.At(x, y, first + 1),
                render.image.At(x, y, first + 2));
  };
  EXPECT_LT(Distance(at(4, 4, "albedo.R"), {Real(.2), Real(.4), Real(.6)}), Real(.01));
  const Point3 p = at(4, 4, "P.X");
  EXPECT_NEAR(double(Distance(p, {0, 0, 5})), 1, 1e-3);
  EXPECT_LT(p.z, Real(4.3));
  EXPECT_LT(Distance(at(4, 4, "N.X"), p - Point3(0, 0, 5)), Real(2e-3));
  for (const char* name : {"albedo.R", "N.X", "P.X"}) EXPECT_EQ(at(0, 0, name), Vec3()) << name;
}

}  // namespace
}  // namespace exphoton
