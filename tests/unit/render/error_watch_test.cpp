// SPDX-License-Identifier: BSD-2-Clause
// These tests render passes of a room that share their gathers, one by one, while ErrorWatch looks
// at their error.
#include "core/render/passes/accuracy/error_watch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <memory>
#include <optional>
#include <vector>

#include "core/math/sampling/random.h"
#include "core/render/certificate/corrections.h"
#include "core/render/passes/render_passes.h"
#include "core/render/sharing/sharing_bands.h"
#include "tests/support/test_scene.h"

namespace exphoton {
namespace {

constexpr int kWatchedColumns = 24, kWatchedRows = 16;
constexpr PixelBounds kWatchedBounds{0, 0, kWatchedColumns, kWatchedRows};
constexpr AovSet kWatchedAovs{Aov::Indirect, Aov::SharingBias};

// The wall has a slot before it that is as wide as a pixel. Sharing spreads light into it.
LoadedScene WatchedScene(bool shares, std::optional<PixelBounds> crop = {}) {
  const std::string integrator =
      R"("exphotonmap" "integer indirectphotons" 2000 "integer causticphotons" 0
         "integer finalgathersamples" 4 "bool sharedgather" )";
  LoadOptions load;
  load.pixelBounds = crop;
  return LoadSceneText(TestHeader(integrator + (shares ? R"("true")" : R"("false")"),
                                  kWatchedColumns, kWatchedRows, 4) +
                           R"(
      WorldBegin
      AttributeBegin AreaLightSource "area" "color L" [ 20 18 15 ]
        Translate 0 .9 2 Rotate 90 1 0 0 Shape "disk" "float radius" [ .3 ] AttributeEnd
      Shape "trianglemesh" "integer indices" [ 0 1 2 0 2 3 ]
        "point P" [ -1 -1 0  1 -1 0  1 -1 3  -1 -1 3 ]
      Shape "trianglemesh" "integer indices" [ 0 1 2 0 2 3 ]
        "point P" [ -9 -9 3  9 -9 3  9 9 3  -9 9 3 ]
      Shape "trianglemesh" "integer indices" [ 0 1 2 0 2 3  4 5 6 4 6 7 ]
        "point P" [ .02 -1 2.4  .02 1 2.4  .02 1 3  .02 -1 3
                    .16 -1 2.4  .16 1 2.4  .16 1 3  .16 -1 3 ]
      Translate 0 -.5 2.5 Shape "sphere" "float radius" .5
      WorldEnd)",
                       load);
}

// Passes with the same photons, which continue one sequence of camera samples.
class WatchedPasses {
 public:
  struct Settings {
    bool shares = true;       // gathers between pixels
    bool hasAccuracy = true;  // otherwise passes share alone
    double memory = 0x1p28;   // RenderOptions::sharingMemory
  };
  explicit WatchedPasses(const Settings& settings)
      : scene_(WatchedScene(settings.shares)),
        parts_(job_, OptionsOf(settings.memory), {}),
        renderer_(job_, parts_.Options()),
        watch_({job_, &parts_, &sum_, &renderer_}, AccuracyOf(settings), GroupSamples::OneSequence),
        sequence_(scene_.setup->sampler->WithSamplesPerPixel(4)) {}

  // Renders the next pass as a group of its own. Returns whether it shares with earlier ones. Fits
  // are made at once, or only where ErrorWatch itself needs them.
  enum class Fits { AtOnce, Later };
  bool Add(std::int64_t samples, Fits fits = Fits::AtOnce) {
    RenderPass pass;
    pass.preprocessSeed = 5;
    pass.sampleSeed = 7;
    pass.firstSample = sum_.SamplesPerPixel();
    pass.sampleCount = samples;
    pass.gathers = watch_.BeginPass(samples);
    const bool isJoint = pass.gathers != nullptr;
    const int group = sum_.Passes();
    passes.emplace_back(kWatchedBounds, kWatchedBounds);
    EXPECT_TRUE(renderer_.Run(pass, *sequence_, &passes.back()));
    sum_.Add(passes.back(), samples, group);
    watch_.Add(passes.back(), samples, group);
    if (fits == Fits::AtOnce) watch_.Complete();
    parts_.TakeAovs(true);
    return isJoint;
  }
  void Look() { watch_.Look({}); }
  bool HasStoppedSharing() const {
    PassesResult result;
    watch_.Describe(&result);
    return !result.changes.empty();
  }
  Image Picture() const {
    Image image = film.ToImage(false);
    aovs_.AppendTo(film, false, &image);
    return image;
  }

  Film film{kWatchedBounds, kWatchedBounds};
  std::deque<Film> passes;  // without joint fits

 private:
  static std::optional<StoppingRule::Accuracy> AccuracyOf(const Settings& settings) {
    if (!settings.hasAccuracy) return std::nullopt;
    return StoppingRule::Accuracy{.02, 4, .125, 0, 0, true};
  }
  RenderOptions OptionsOf(double memory) {
    RenderOptions options;
    options.sharingMemory = memory;
    options.aovs = &aovs_;
    options.corrections = &corrections_;
    return options;
  }

  LoadedScene scene_;
  AovFilm aovs_{kWatchedBounds, kWatchedAovs};
  ThreadPool threads_{1};
  ProgressReporter progress_{ProgressReporter::Mode::Quiet};
  mutable Statistics statistics_;
  Corrections corrections_{kWatchedBounds, .25};
  RenderJob job_{*scene_.setup->scene,
                 *scene_.setup->integrator,
                 *scene_.setup->sampler,
                 *scene_.setup->filter,
                 *scene_.setup->camera,
                 film,
                 threads_,
                 *scene_.log,
                 progress_,
                 statistics_};
  PassParts parts_;
  PassRenderer renderer_;
  PassSum sum_{&film, {}};
  ErrorWatch watch_;
  std::unique_ptr<Sampler> sequence_;
};

std::vector<double> SumsOfFilm(const Film& film) {
  std::vector<double> sums;
  for (std::size_t i = 0; i < film.PixelCount(); ++i) {
    const Film::Sums pixel = film.SumsOf(i);
    for (const double value : {pixel.r, pixel.g, pixel.b, pixel.weight}) sums.push_back(value);
  }
  return sums;
}

double MostDifference(const Image& a, const Image& b) {
  double most = a.pixels.size() == b.pixels.size() ? 0 : INFINITY;
  for (std::size_t i = 0; i < a.pixels.size() && i < b.pixels.size(); ++i)
    most = std::max(most, std::abs(double(a.pixels[i]) - double(b.pixels[i])));
  return most;
}

// Renders two passes more than share together. Returns how many do.
int ExpectThatLaterPassesShareAlone(double memory) {
  WatchedPasses together({true, true, memory}), fitted({true, true, memory}),
      alone({true, false, memory});
  Film expected(kWatchedBounds, kWatchedBounds), apart = expected;
  int joint = 0;
  for (int later = 0; later < 2 && joint < 20;) {
    const bool isJoint = together.Add(1, WatchedPasses::Fits::Later);
    EXPECT_EQ(fitted.Add(1), isJoint);
    EXPECT_FALSE(alone.Add(1));
    EXPECT_FALSE(isJoint && later > 0);
    apart.Add(alone.passes.back());
    if (isJoint) {
      ++joint;
      expected = fitted.film;
      continue;
    }
    // The earlier passes keep their last fits.
    ++later;
    expected.Add(alone.passes.back());
    EXPECT_LT(MostDifference(together.film.ToImage(false), expected.ToImage(false)), 1e-5);
  }
  EXPECT_GT(MostDifference(apart.ToImage(false), expected.ToImage(false)), 1e-3);
  return joint;
}

TEST(ErrorWatch, LetsEightPassesShareTogetherAndLaterOnesAlone) {
  EXPECT_EQ(ExpectThatLaterPassesShareAlone(0x1p28), 8);
}

TEST(ErrorWatch, LetsPassesShareAloneThatDoNotFitIntoMemory) {
  const double pass = kWatchedColumns * kWatchedRows * GatherFragments::BytesPerPixel(1);
  const int joint = ExpectThatLaterPassesShareAlone(5 * pass / kBandsOfPasses);
  EXPECT_GT(joint, 1);
  EXPECT_LT(joint, 5);
}

TEST(ErrorWatch, RemovesJointFitsFromPictureAndAovsWhereItStopsToShare) {
  WatchedPasses shared({}), own({false, true});
  double difference = 0;
  for (int pass = 0; pass < 6 && !shared.HasStoppedSharing(); ++pass) {
    EXPECT_TRUE(shared.Add(16));
    own.Add(16);
    difference = MostDifference(shared.Picture(), own.Picture());
    if (pass > 0) shared.Look();
  }
  ASSERT_TRUE(shared.HasStoppedSharing());
  EXPECT_GT(difference, .02);
  EXPECT_LT(MostDifference(shared.Picture(), own.Picture()), 1e-5);
  EXPECT_FALSE(shared.Add(16));
  own.Add(16);
  EXPECT_EQ(SumsOfFilm(shared.passes.back()), SumsOfFilm(own.passes.back()));
  EXPECT_LT(MostDifference(shared.Picture(), own.Picture()), 1e-5);
}

// Renders two passes. The first look comes after them. Returns the number of passes.
int RenderWatchedAccuracy(const PixelBounds& crop, Film* film) {
  const LoadedScene scene = WatchedScene(true, crop);
  RenderSetup& setup = *scene.setup;
  ThreadPool pool(1);
  ProgressReporter progress(ProgressReporter::Mode::Quiet);
  Statistics statistics;
  Corrections corrections(crop, .25);
  RenderOptions options;
  options.seed = 7;
  options.corrections = &corrections;
  StoppingRule rule;
  rule.maxSamples = 4;
  rule.accuracy = StoppingRule::Accuracy{.01, 2};
  const RenderJob job{
      *setup.scene, *setup.integrator, *setup.sampler, *setup.filter, *setup.camera, *film,
      pool,         *scene.log,        progress,       statistics};
  const PassesResult result = RenderInPasses(job, options, rule);
  EXPECT_EQ(result.samplesPerPixel, 4);
  return result.passes;
}

// Both choose windows from the gathers of two passes, and so from the same pixels around the crop.
TEST(ErrorWatch, GivesACropTheBitsOfTheFullPicture) {
  constexpr PixelBounds kCrop{9, 5, 14, 12};
  Film full(kWatchedBounds, kWatchedBounds), crop(kWatchedBounds, kCrop);
  EXPECT_EQ(RenderWatchedAccuracy(kWatchedBounds, &full), 2);
  EXPECT_EQ(RenderWatchedAccuracy(kCrop, &crop), 2);
  for (int y = kCrop.y0; y < kCrop.y1; ++y)
    for (int x = kCrop.x0; x < kCrop.x1; ++x)
      EXPECT_EQ(full.MeanOf({x, y}), crop.MeanOf({x, y})) << x << ' ' << y;
}

}  // namespace
}  // namespace exphoton
