// SPDX-License-Identifier: BSD-2-Clause
// These tests render pilots of a glowing sphere, seen from its inside.
#include "core/app/dial/pilots/pilot_series.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "core/app/dial/candidate.h"
#include "core/base/log.h"
#include "tests/support/test_scene.h"

namespace exphoton::cli {
namespace {

class PilotTest : public testing::Test {
 protected:
  std::unique_ptr<PilotRenderer> Renderer(bool isShared, const LoadOptions& load = {}) {
    const std::string integrator =
        R"("exphotonmap" "integer indirectphotons" 5000 "integer directphotons" 5000
           "integer finalgathersamples" 4 "bool sharedgather" )";
    streams_["room.pbrt"] =
        TestHeader(integrator + (isShared ? R"("true")" : R"("false")"), 40, 40, 4) + world_;
    RenderCommand command;
    command.scenes = {"room.pbrt"};
    command.threadCount = 1;
    command.load = load;
    command.load.pluginFolders = {std::string(EXPHOTON_BINARY_DIR) + "/plugins"};
    return std::make_unique<PilotRenderer>(
        command, "room.pbrt", PilotRenderer::Surroundings{"--accuracy", &streams_, &log_});
  }

  FileSource::Streams streams_;
  Log log_;
  std::string world_ = FurnaceWorld(1, R"("matte" "color Kd" [ .5 .5 .5 ])");
};

TEST_F(PilotTest, KnowsTheBiasOfSharingWhereGathersAreShared) {
  PilotRequest request;
  request.integrator = "exphotonmap";
  EXPECT_GT(Renderer(true)->Render(request).sharing.standardError, 0);
  EXPECT_EQ(Renderer(false)->Render(request).sharing.standardError, 0);
}

// A rough pilot has a tenth of the photons, and estimates use a tenth of 50.
TEST_F(PilotTest, GuessesTheBiasOfTheScenesPhotons) {
  PilotRequest request;
  request.integrator = "exphotonmap";
  for (const bool isRough : {false, true}) {
    request.isRough = isRough;
    const double guess = Renderer(true)->Render(request).guessedBias;
    EXPECT_NEAR(guess, .5 * std::sqrt(50 / 5000.), .002) << isRough;
  }
}

// At 2 %, a guess of 5 % asks for four times the photons, unless these are caustic photons too.
TEST_F(PilotTest, GuessesAskForNoCausticPhotons) {
  world_ = R"(WorldBegin
LightSource "point" "point from" [0 .8 0]
Material "matte"
Shape "sphere" "float radius" [1]
Material "mirror"
Shape "sphere" "float radius" [.3]
WorldEnd
)";
  const auto photonsWith = [&](const char* causticPhotons, bool isTimed) {
    LoadOptions load;
    load.parameters.push_back({"SurfaceIntegrator", "causticphotons", causticPhotons});
    const auto renderer = Renderer(true, load);
    Wish wish;
    wish.error = .02;
    wish.isTimed = isTimed;
    Explorer explorer(renderer.get(), "exphotonmap", 0, wish);
    explorer.Begin();
    EXPECT_EQ(explorer.Result().reason, "");
    return explorer.Result().price.photons;
  };
  EXPECT_GT(photonsWith("0", false), 1);
  EXPECT_LE(photonsWith("0", true), 1);
  EXPECT_LE(photonsWith("1000", false), 1);
}

// A rough pilot has a quarter of the resolution. The window contains no corner of its pixels.
TEST_F(PilotTest, OfASmallWindowHasAPixel) {
  LoadOptions pixel, window;
  pixel.pixelBounds = PixelBounds{39, 5, 40, 6};
  window.cropWindow = {Real(.475), Real(.5), Real(.475), Real(.5)};
  PilotRequest request;
  request.integrator = "exphotonmap";
  for (const LoadOptions& load : {pixel, window})
    for (const bool isRough : {false, true}) {
      request.isRough = isRough;
      EXPECT_EQ(Renderer(false, load)->Render(request).pixels, 1) << isRough;
    }
}

TEST_F(PilotTest, SharesWithinEachHalf) {
  const auto renderer = Renderer(true);
  PilotSeries series(renderer.get(), "exphotonmap", 0, PilotSeries::Unit::CountedCost);
  series.Render();
  EXPECT_EQ(series.Model().sharing.samples, 1);
  EXPECT_GT(series.Model().sharing.error, 0);
  series.Render();
  EXPECT_EQ(series.Model().sharing.samples, 2);
}

// A picture that begins again with more photons shoots them itself.
TEST_F(PilotTest, GivesItsPhotonsToAnAttemptWithTheSameSettings) {
  const auto renderer = Renderer(false);
  PilotRequest request;
  request.integrator = "exphotonmap";
  renderer->Render(request);
  const LoadedScene first = LoadSceneText(streams_["room.pbrt"]);
  DialChoice choice;
  EXPECT_TRUE(renderer->Give(choice, first.setup.get()));
  EXPECT_TRUE(renderer->Work().givesPhotons);
  const LoadedScene second = LoadSceneText(streams_["room.pbrt"]);
  choice.settings.photons = 4;
  EXPECT_FALSE(renderer->Give(choice, second.setup.get()));
  EXPECT_FALSE(renderer->Work().givesPhotons);
}

TEST_F(PilotTest, EstimatesTheBiasForAQuoteInItsLastPilotOnly) {
  const auto renderer = Renderer(true);
  PilotSeries series(renderer.get(), "exphotonmap", 0, PilotSeries::Unit::CpuSeconds);
  series.Render();
  EXPECT_EQ(series.Model().sharing.error, 0);
  series.RenderBias(1);
  EXPECT_GT(series.Model().sharing.error, 0);
}

// Returns the candidate of a rough pilot, and the one that the search for omissions receives.
std::array<Candidate, 2> RoughAndLikely(PilotRenderer* pilots, double bound) {
  Candidate likely;
  Wish wish;
  wish.error = .002;
  wish.findOmissions = [&](Candidate* candidate) {
    likely = *candidate;
    return std::vector<OmittedEffect>{{"caustics", bound, .5}};
  };
  Explorer explorer(pilots, "exphotonmap", 0, wish);
  explorer.Begin();
  const Candidate rough = explorer.Result();
  EXPECT_TRUE(rough.isRough);
  EXPECT_TRUE(explorer.FindOmissions(rough.price.seconds));
  EXPECT_EQ(explorer.Result().price.seconds, rough.price.seconds);
  EXPECT_EQ(explorer.Result().omitted.size(), 1u);
  return {rough, likely};
}

// The noise of a rough pilot may be 20 times too high, and its root is the likely factor. The
// number of samples is proportional to the noise here.
TEST_F(PilotTest, PairsForOmissionsCountWithTheLikelyPrice) {
  const auto renderer = Renderer(true);
  const auto [rough, likely] = RoughAndLikely(renderer.get(), .0001);
  EXPECT_TRUE(likely.reason.empty()) << likely.reason;
  EXPECT_LT(likely.price.seconds, rough.price.seconds);
  // Other photons would have another noise.
  EXPECT_EQ(likely.price.photons, rough.price.photons);
  EXPECT_NEAR(rough.price.samples / likely.price.samples, std::sqrt(20), .05);
}

// All photons of the rough pilot, a tenth of the scene's, would take many more paths.
TEST_F(PilotTest, ARoughPilotIsCutOffWhereItsPhotonsCostTooMuch) {
  LoadOptions load;
  load.parameters.push_back({"SurfaceIntegrator", "indirectphotons", "20000000"});
  const auto renderer = Renderer(false, load);
  Wish wish;
  wish.error = .1;
  Explorer explorer(renderer.get(), "exphotonmap", 0, wish);
  explorer.Begin(1000);
  EXPECT_GT(explorer.Result().leastPrice, 1000);
  EXPECT_EQ(explorer.Result().reason, "its photons cost more");
  EXPECT_LT(renderer->Work().indirect, .5 * .1 * 20000000);
}

TEST_F(PilotTest, ARoughPilotWithFewPathsIsNotCutOff) {
  Wish wish;
  wish.error = .1;
  const auto priceWith = [&](double most) {
    const auto renderer = Renderer(false);
    Explorer explorer(renderer.get(), "exphotonmap", 0, wish);
    explorer.Begin(most);
    EXPECT_EQ(explorer.Result().reason, "");
    EXPECT_EQ(explorer.Result().leastPrice, 0);
    return explorer.Result().price.seconds;
  };
  EXPECT_EQ(priceWith(1), priceWith(kNoPrice));
}

// Seconds of quotes are those of other renders, which make their maps again.
TEST_F(PilotTest, MapsThatThePictureTakesAreNotSpent) {
  const auto renderer = Renderer(false);
  PilotSeries counted(renderer.get(), "exphotonmap", 0, PilotSeries::Unit::CountedCost);
  counted.Render();
  EXPECT_GT(counted.OwnedMaps(), 0);
  EXPECT_EQ(counted.OwnedMaps(), counted.Last().cost.maps);
  EXPECT_NEAR(counted.Spent(), counted.Last().cost.samples, .01);
  PilotSeries quoted(renderer.get(), "exphotonmap", 0, PilotSeries::Unit::CpuSeconds);
  quoted.Render();
  EXPECT_EQ(quoted.OwnedMaps(), 0);
}

// What a picture showed about an integrator counts for this integrator alone.
TEST_F(PilotTest, APictureThatWasGivenUpRaisesThePrice) {
  const auto priceAfter = [&](const std::string& givenUp) {
    const auto renderer = Renderer(false);
    Wish wish;
    wish.error = .1;
    wish.givenUp.push_back({givenUp, 5000});
    Explorer explorer(renderer.get(), "path", 0, wish);
    explorer.Begin();
    return explorer.Result();
  };
  const Candidate noisy = priceAfter("path"), other = priceAfter("guidedpath");
  EXPECT_EQ(noisy.price.samples, 5000);
  EXPECT_LT(other.price.samples, 500);
  EXPECT_NEAR(noisy.price.seconds, 5000 * noisy.priceOfSample, .01 * noisy.price.seconds);
}

// The maps cost a large part of what pilots may cost here.
TEST_F(PilotTest, RivalsGetMorePilots) {
  LoadOptions load;
  load.parameters.push_back({"SurfaceIntegrator", "indirectphotons", "100000"});
  Wish wish;
  wish.error = .02;
  const auto rendersOf = [&](bool hasRivals) {
    const auto renderer = Renderer(false, load);
    Explorer explorer(renderer.get(), "exphotonmap", 0, wish);
    explorer.Begin();
    explorer.Settle(kNoPrice);
    explorer.Refine(kNoPrice, hasRivals);
    return renderer->Work().renders;
  };
  EXPECT_GT(rendersOf(true), rendersOf(false));
}

}  // namespace
}  // namespace exphoton::cli
