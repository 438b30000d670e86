// SPDX-License-Identifier: BSD-2-Clause
// These tests check the tile loop with a synthetic integrator: independence of threads, tiles and
// crop, non-finite samples, and stopping.
#include "core/render/render.h"

#include <gtest/gtest.h>

#include <limits>

#include "core/base/error.h"
#include "core/render/splat_weights.h"
#include "tests/support/test_plugin.h"
#include "tests/support/test_scene.h"

namespace exphoton {
namespace {

// MadeUpIntegrator computes radiance from the ray, the sample arrays and the random stream, so that
// every difference shows.
class MadeUpIntegrator final : public SurfaceIntegrator {
 public:
  void RequestSamples(const Scene&, const Sampler& sampler, SampleLayout* layout) override {
    one_ = layout->Request1D(1);
    many_ = layout->Request2D(sampler.RoundCount(5));
  }
  Spectrum Li(const RayDifferential& ray, LiContext& context) const override {
    context.rays.Count(RayKind::Camera);
    RandomStream random = context.Stream(1);
    auto* const memory = context.arena.Make<Spectrum>(Real(.5));
    Point2 sum;
    for (Point2 p : context.samples.Array2D(many_)) sum = sum + p;
    if (bad) {
      const Real f = random.Uniform();
      if (f < Real(.01)) return Spectrum(std::numeric_limits<Real>::quiet_NaN());
      if (f < Real(.02)) return {1, kInfinity, 1};
      if (f < Real(.03)) return {1, Real(-.001), 1};
    }
    if (ray.d.x > 0) context.alpha = 0;
    *memory +=
        {context.samples.Array1D(one_)[0], random.Uniform() * (2 + ray.d.y), sum.x + ray.d.x};
    if (afterSample) afterSample();
    return *memory;
  }

  bool bad = false;
  std::function<void()> afterSample;

 private:
  int one_ = 0, many_ = 0;
};

struct Options {
  int threads = 1, tileSize = 16;
  TileOrder order = TileOrder::Scanline;
  PixelBounds crop{0, 0, 37, 29};
  std::uint64_t seed = 1;
  bool isStrict = false;
  const std::atomic<bool>* stop = nullptr;
};

struct Outcome {
  Image image;
  RenderResult result;
  Statistics statistics;
};

class RenderTest : public testing::Test {
 protected:
  RenderTest() : scene_(EmptyScene()) {
    filter_ = plugins_.MakeFilter(R"("mitchell")");
    camera_ = plugins_.MakeCamera(R"("perspective")", {}, 37, 29);
    sampler_ = plugins_.MakeSampler(R"("lowdiscrepancy" "integer pixelsamples" 4)");
  }
  static SceneParts EmptyScene() {
    SceneParts parts;
    parts.primitives = std::make_unique<PrimitiveSet>();
    return parts;
  }
  void Render(const Options& o, Outcome* outcome) {
    Film film({0, 0, 37, 29}, o.crop);
    ThreadPool threads(o.threads);
    ProgressReporter progress(ProgressReporter::Mode::Quiet);
    RenderOptions options;
    options.seed = o.seed;
    options.tileSize = o.tileSize;
    options.tileOrder = o.order;
    options.isStrict = o.isStrict;
    options.stop = o.stop;
    const RenderJob job{scene_, integrator_, *sampler_, *filter_, *camera_,
                        film,   threads,     log_,      progress, outcome->statistics};
    outcome->result = exphoton::Render(job, options);
    outcome->image = film.ToImage(true);
  }
  std::vector<float> Pixels(const Options& o) {
    Outcome outcome;
    Render(o, &outcome);
    return outcome.image.pixels;
  }

  Image RenderWith(SurfaceIntegrator& integrator, const Sampler& sampler, const PixelBounds& crop) {
    ThreadPool threads(1);
    ProgressReporter progress(ProgressReporter::Mode::Quiet);
    Statistics statistics;
    Film film({0, 0, 37, 29}, crop);
    exphoton::Render(RenderJob{scene_, integrator, sampler, *filter_, *camera_, film, threads, log_,
                               progress, statistics},
                     RenderOptions());
    return film.ToImage(true);
  }

  TestPlugins plugins_;
  Log log_{Log::Level::Normal, Log::Sink::Memory};
  Scene scene_;
  MadeUpIntegrator integrator_;
  std::unique_ptr<Filter> filter_;
  std::unique_ptr<Camera> camera_;
  std::unique_ptr<Sampler> sampler_;
};

TEST_F(RenderTest, ThePictureDoesNotDependOnThreadsOrTiles) {
  const std::vector<float> expected = Pixels({});
  for (int threads : {1, 2, 3, 8, 17}) {
    for (int tileSize : {1, 16, 64}) {
      for (TileOrder order : {TileOrder::Scanline, TileOrder::Reversed}) {
        EXPECT_EQ(Pixels({.threads = threads, .tileSize = tileSize, .order = order}), expected)
            << threads << " threads, tiles of " << tileSize;
      }
    }
  }
}

TEST_F(RenderTest, ACropIsAPieceOfThePicture) {
  for (const char* sampler : {R"("lowdiscrepancy")", R"("stratified")", R"("random")"}) {
    sampler_ = plugins_.MakeSampler(sampler);
    Outcome full;
    Render({}, &full);
    for (const PixelBounds& crop :
         {PixelBounds{0, 0, 18, 14}, PixelBounds{18, 0, 37, 14}, PixelBounds{0, 14, 18, 29},
          PixelBounds{18, 14, 37, 29}, PixelBounds{36, 28, 37, 29}}) {
      Outcome part;
      Render({.threads = 2, .crop = crop}, &part);
      for (int y = crop.y0; y < crop.y1; ++y)
        for (int x = crop.x0; x < crop.x1; ++x)
          for (int c = 0; c < 4; ++c)
            ASSERT_EQ(part.image.At(x - crop.x0, y - crop.y0, c), full.image.At(x, y, c));
    }
  }
}

TEST_F(RenderTest, AnotherSeedIsAnotherPicture) {
  EXPECT_NE(Pixels({.seed = 1}), Pixels({.seed = 2}));
}

TEST_F(RenderTest, NonFiniteSamplesAreDroppedCountedAndReported) {
  integrator_.bad = true;
  Outcome outcome;
  Render({}, &outcome);
  for (float v : outcome.image.pixels) ASSERT_TRUE(std::isfinite(v) && v >= 0);
  const std::int64_t count = outcome.result.nonFiniteSamples;
  EXPECT_GT(count, 30);  // about 86 of 4292
  EXPECT_LT(count, 170);
  ASSERT_EQ(outcome.result.nonFiniteReports.size(), 8u);
  EXPECT_NE(outcome.result.nonFiniteReports[0].find("pixel"), std::string::npos);
  EXPECT_NE(outcome.result.nonFiniteReports[0].find("seed 1"), std::string::npos);
  EXPECT_EQ(log_.WarningCount(), 9);
  Outcome threaded;
  Render({.threads = 8, .tileSize = 1, .order = TileOrder::Reversed}, &threaded);
  EXPECT_EQ(threaded.result.nonFiniteReports, outcome.result.nonFiniteReports);
  EXPECT_EQ(threaded.result.nonFiniteSamples, count);
  EXPECT_EQ(threaded.image.pixels, outcome.image.pixels);
}

TEST_F(RenderTest, UnderStrictANonFiniteSampleEndsTheRender) {
  integrator_.bad = true;
  Outcome outcome;
  try {
    Render({.threads = 3, .isStrict = true}, &outcome);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.Status(), ExitStatus::Internal);
    for (const char* word : {"pixel", "sample", "seed 1"})
      EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << word;
  }
}

TEST_F(RenderTest, StopsWithinAPixelAndKeepsWhatIsThere) {
  filter_ = plugins_.MakeFilter(R"("box")");
  sampler_ = sampler_->WithSamplesPerPixel(1 << 30);
  std::atomic<bool> stop = false;
  int samples = 0;
  integrator_.afterSample = [&] { stop = ++samples == 1000; };
  Outcome outcome;
  Render({.stop = &stop}, &outcome);
  EXPECT_FALSE(outcome.result.isComplete);
  EXPECT_EQ(samples, 1000);
  EXPECT_GT(outcome.image.At(0, 0, 0), 0);
  EXPECT_EQ(outcome.image.At(1, 0, 3), 0);
}

TEST_F(RenderTest, CountsRaysAndSamples) {
  Outcome outcome;
  Render({.threads = 4}, &outcome);
  EXPECT_TRUE(outcome.result.isComplete);
  EXPECT_EQ(outcome.statistics.Rays().counts[std::size_t(RayKind::Camera)],
            41u * 33 * 4);  // the filter reaches two pixels beyond the picture
  ASSERT_EQ(outcome.statistics.Phases().size(), 1u);
  EXPECT_EQ(outcome.statistics.Phases()[0].name, "render");
}

TEST_F(RenderTest, AOnePixelPictureIsFiniteUnderEveryFilter) {
  camera_ = plugins_.MakeCamera(R"("perspective")", {}, 1, 1);
  sampler_ = sampler_->WithSamplesPerPixel(1);
  for (const char* filter :
       {"\"box\"", "\"triangle\"", "\"gaussian\"", "\"mitchell\"", "\"sinc\""}) {
    filter_ = plugins_.MakeFilter(filter);
    for (std::uint64_t seed = 0; seed < 50; ++seed)
      for (float v : Pixels({.crop = {0, 0, 1, 1}, .seed = seed})) EXPECT_TRUE(std::isfinite(v));
  }
}

// Writes down how far the neighbouring rays begin.
class FootprintIntegrator final : public SurfaceIntegrator {
 public:
  Spectrum Li(const RayDifferential& ray, LiContext&) const override {
    return {Length(ray.xOrigin - ray.o), Length(ray.yOrigin - ray.o), 0};
  }
};

// Orthographic, the shorter side 2: a pixel is 2/29 wide, and N samples share it as a grid would.
TEST_F(RenderTest, FootprintsShrinkByTheRootOfTheSamples) {
  camera_ = plugins_.MakeCamera(R"("orthographic")", {}, 37, 29);
  FootprintIntegrator integrator;
  for (const int root : {1, 2, 4}) {
    const auto sampler = sampler_->WithSamplesPerPixel(root * root);
    const Image image = RenderWith(integrator, *sampler, {0, 0, 4, 4});
    EXPECT_NEAR(MeanChannel(image, "R") * root * 29 / 2, 1, 1e-5) << root;
    EXPECT_NEAR(MeanChannel(image, "G") * root * 29 / 2, 1, 1e-5) << root;
  }
}

// Returns 1 within about a quarter of a pixel of a pixel's centre along both axes, and 0 elsewhere.
class CentreIntegrator final : public SurfaceIntegrator {
 public:
  Spectrum Li(const RayDifferential& ray, LiContext&) const override {
    const auto isNear = [](Real place) {
      return std::abs(place - std::floor(place) - Real(.5)) < Real(.251);
    };
    const Real pixels = Real(29) / 2;  // in a unit of length
    const bool isInside =
        isNear(ray.o.x * pixels + Real(18.5)) && isNear(ray.o.y * pixels + Real(14.5));
    return Spectrum(isInside ? Real(1) : Real(0));
  }
};

TEST_F(RenderTest, ANarrowFilterWithNegativeLobesShowsWhatIsWithinItsSupport) {
  camera_ = plugins_.MakeCamera(R"("orthographic")", {}, 37, 29);
  CentreIntegrator integrator;
  for (const std::string name : {"mitchell", "sinc"}) {
    filter_ = plugins_.MakeFilter("\"" + name + R"(" "float xwidth" .25 "float ywidth" .25)");
    const Image image = RenderWith(integrator, *sampler_, {0, 0, 37, 29});
    for (int i = 0; i < 37 * 29; ++i)
      EXPECT_NEAR(image.At(i % 37, i / 37, 0), 1, 1e-5) << name << ' ' << i;
  }
}

TEST_F(RenderTest, FiltersWithNegativeLobesAreSplattedUnlessTheyAreNarrow) {
  const auto isSplatted = [&](const std::string& text) {
    return SplatWeights::Of(*plugins_.MakeFilter(text)) != nullptr;
  };
  EXPECT_TRUE(isSplatted("\"mitchell\""));
  EXPECT_TRUE(isSplatted(R"("mitchell" "float xwidth" 1.5 "float ywidth" 1.5)"));
  EXPECT_FALSE(isSplatted(R"("mitchell" "float xwidth" 1 "float ywidth" 1)"));
  EXPECT_TRUE(isSplatted("\"sinc\""));
  EXPECT_TRUE(isSplatted(R"("sinc" "float xwidth" 1.5 "float ywidth" 1.5)"));
  EXPECT_FALSE(isSplatted(R"("sinc" "float xwidth" 1 "float ywidth" 1)"));
  // The weights of importance samples would cancel.
  EXPECT_TRUE(isSplatted(R"("sinc" "float xwidth" 1 "float ywidth" 1 "float tau" 8)"));
}

// The checkerboard is filtered, so its colours depend on the footprint of a pixel.
constexpr char kCheckerboard[] = R"(
  Camera "perspective" Film "image" "integer xresolution" 16 "integer yresolution" 12
  SurfaceIntegrator "directlighting" WorldBegin
  LightSource "point" "point from" [0 1 0]
  Texture "board" "color" "checkerboard" "color tex1" [1 1 1]
    "color tex2" [0 0 0] "float uscale" 9 "float vscale" 9
  Material "matte" "texture Kd" "board" Translate 0 0 2 Shape "disk" "float radius" 3 WorldEnd)";

TEST(Footprint, OfAPixelIsThatOfItsSamplesUnlessAnotherIsAskedFor) {
  const auto pixels = [](int samples, int footprint) {
    TestRenderOptions options;
    options.load.samplesPerPixel = samples;
    options.footprintSamples = footprint;
    return RenderSceneText(kCheckerboard, options).image.pixels;
  };
  EXPECT_EQ(pixels(4, 4), pixels(4, 0));
  EXPECT_NE(pixels(4, 64), pixels(4, 0));
}

}  // namespace
}  // namespace exphoton
