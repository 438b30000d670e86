// SPDX-License-Identifier: BSD-2-Clause
// These tests order an accuracy (--accuracy) from the command line.
#include <algorithm>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "tests/cli/program.h"

namespace exphoton {
namespace {

using Names = std::vector<std::string>;

class AccuracyTest : public ProgramTest {
 protected:
  AccuracyTest() { WriteRoom("room.pbrt", "exphotonmap", 2000); }

  void WriteRoom(const std::string& name, const std::string& integrator, int photons) const {
    Write(name,
          "Film \"image\" \"integer xresolution\" 24 \"integer yresolution\" 16\n"
          "Camera \"perspective\"\nPixelFilter \"box\"\nSurfaceIntegrator \"" +
              integrator + "\" \"integer indirectphotons\" " + std::to_string(photons) +
              "\nWorldBegin\nMaterial \"matte\" \"color Kd\" [.3 .3 .3]\nAttributeBegin "
              "AreaLightSource \"area\" \"color L\" [5 5 5]\n"
              "Translate 0 3 4 Shape \"sphere\" AttributeEnd\n"
              "Translate 0 0 4 Shape \"sphere\"\n"
              "ReverseOrientation Shape \"sphere\" \"float radius\" 6\nWorldEnd\n");
  }
  ProgramResult Render(const std::string& accuracy, const Names& more = {},
                       const std::string& scene = "room.pbrt") const {
    Names words{scene, "--accuracy", accuracy, "-o", "room.exr", "--no-progress"};
    words.insert(words.end(), more.begin(), more.end());
    return Run(words);
  }
  nlohmann::json RenderAndRead(const std::string& accuracy, Names more = {}) const {
    more.insert(more.end(), {"--stats-json", "room.json"});
    const ProgramResult result = Render(accuracy, more);
    EXPECT_EQ(result.status, 0) << result.err;
    return nlohmann::json::parse(Read("room.json"));
  }
};

int NumberAfter(const std::string& text, const std::string& words) {
  const std::size_t at = text.find(words);
  return at == std::string::npos ? 0 : std::atoi(text.c_str() + at + words.size());
}

// Pilots of few pixels and samples ask for far too few samples. The limit is 64 times as many, and
// 1024 at least.
TEST_F(AccuracyTest, MayTakeFarMoreSamplesThanThePilotsSuggest) {
  for (const char* seed : {"1", "2", "3", "4"}) {
    const ProgramResult result =
        Render("5%", {"--integrator", "path", "--resolution", "4x3", "--seed", seed});
    ASSERT_EQ(result.status, 0) << result.err;
    const int suggested = NumberAfter(result.err, "samples a pixel 4 -> about ");
    const int taken = NumberAfter(result.err, "(at a level of 95 %): ");
    EXPECT_GT(suggested, 0) << result.err;
    EXPECT_GT(taken, 256) << result.err;  // the former limit
    EXPECT_LE(taken, 64 * std::max(suggested, 16)) << result.err;
    EXPECT_EQ(result.err.find("which is not the accuracy"), std::string::npos) << result.err;
  }
}

// Without indirect light, guidedpath would render what path renders.
TEST_F(AccuracyTest, TriesNoGuidingWhereThereIsNoIndirectLight) {
  Write("mirrors.pbrt",
        "Film \"image\" \"integer xresolution\" 24 \"integer yresolution\" 16\n"
        "Camera \"perspective\"\nPixelFilter \"box\"\nWorldBegin\n"
        "AttributeBegin AreaLightSource \"area\" \"color L\" [5 5 5]\n"
        "Material \"matte\" \"color Kd\" [0 0 0] Translate 0 3 4 Shape \"sphere\" AttributeEnd\n"
        "Material \"mirror\" Translate 0 0 4 Shape \"sphere\"\nWorldEnd\n");
  const ProgramResult result = Render("10%", {}, "mirrors.pbrt");
  ASSERT_EQ(result.status, 0) << result.err;
  const std::string reason = "guidedpath: no pilot, because there is no indirect light to guide";
  ExpectIn(reason, result.err);
  // The integrator of the file computes no indirect light, but the room has it.
  WriteRoom("room.pbrt", "directlighting", 2000);
  const ProgramResult room = Render("20%");
  ASSERT_EQ(room.status, 0) << room.err;
  EXPECT_EQ(room.err.find(reason), std::string::npos) << room.err;
}

TEST_F(AccuracyTest, RendersUntilTheErrorIsSmall) {
  const ProgramResult result = Render("20%", {"--stats-json", "room.json"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.err.find("accuracy 20%: integrator exphotonmap"), std::string::npos)
      << result.err;
  EXPECT_NE(result.err.find("expected CPU time"), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("the error lies below"), std::string::npos) << result.err;
  const auto json = nlohmann::json::parse(Read("room.json"));
  EXPECT_EQ(json.at("stoppedBy"), "accuracy");
  EXPECT_EQ(json.at("accuracy").at("wanted"), .2);
  EXPECT_LE(json.at("accuracy").at("upperError"), .2);
  EXPECT_LE(std::sqrt(json.at("noise").get<double>()), json.at("accuracy").at("upperError"));
  const std::string info = Run({"info", "room.exr"}).out;
  for (const char* name : {"accuracy/wanted", "accuracy/upperError", "accuracy/chosen"})
    EXPECT_NE(info.find(name), std::string::npos) << info;
}

// In a smaller picture the few pixels at the edge of the lamp would decide.
TEST_F(AccuracyTest, MoreAccuracyTakesMoreSamples) {
  const Names path{"--integrator", "path", "--resolution", "48x32"};
  const int coarse = RenderAndRead("8%", path).at("samplesPerPixel");
  const int fine = RenderAndRead("1%", path).at("samplesPerPixel");
  EXPECT_GT(fine, 8 * coarse);  // 64 by the square of the ratio, 16 with the best sequences
}

// The noise of pilots can be far too high, so the first look comes long before the expected end.
TEST_F(AccuracyTest, LooksEarlyWherePhotonsCostNothing) {
  const std::string err = Render("1%", {"--integrator", "path", "--verbose"}).err;
  const int expected = NumberAfter(err, "about "), first = NumberAfter(err, "note: after ");
  EXPECT_GE(first, 2) << err;
  EXPECT_LE(6 * first, expected) << err;
}

TEST_F(AccuracyTest, DoesNotDependOnThreads) {
  std::string pictures[3];
  const char* const threads[] = {"1", "2", "7"};
  for (int i = 0; i < 3; ++i) {
    const ProgramResult result =
        Render("15%", {"--nthreads", threads[i], "--reproducible", "--seed", "3"});
    ASSERT_EQ(result.status, 0) << result.err;
    pictures[i] = Read("room.exr");
  }
  EXPECT_EQ(pictures[0], pictures[1]);
  EXPECT_EQ(pictures[0], pictures[2]);
}

TEST_F(AccuracyTest, UsesTheNamedIntegratorAndCertifiesPhotons) {
  for (const char* name : {"path", "guidedpath", "photonmap", "exphotonmap"}) {
    const auto json = RenderAndRead("30%", {"--integrator", name});
    EXPECT_EQ(json.at("integrator"), name);
    EXPECT_EQ(json.contains("certificate"), std::string(name).ends_with("photonmap")) << name;
  }
}

// Each camera sample sees the sphere. Rays that estimate the bias are counted too.
TEST_F(AccuracyTest, UsesFewerGatherRaysThanTheScene) {
  const Names options{"--integrator", "exphotonmap", "--set",
                      "SurfaceIntegrator.finalgathersamples=100"};
  const auto json = RenderAndRead("30%", options);
  const double samples = 24 * 16 * json.at("samplesPerPixel").get<double>();
  EXPECT_LT(json.at("rays").at("gather").get<double>(), 50 * samples);
  EXPECT_NE(Render("30%", options).err.find("gather rays 100 -> 16"), std::string::npos);
}

// Few rays would make the bias of shared gathers uncertain.
TEST_F(AccuracyTest, UsesMoreGatherRaysThanTwo) {
  const Names options{"--integrator", "exphotonmap", "--set",
                      "SurfaceIntegrator.finalgathersamples=2"};
  EXPECT_NE(Render("30%", options).err.find("gather rays 2 -> 16"), std::string::npos);
}

// A pilot of a small picture would take as long as a part of the picture. Those of a quote have all
// pixels.
TEST_F(AccuracyTest, PilotsOfPhotonMapsHaveAQuarterOfThePixels) {
  const auto priceOf = [](const std::string& text) {
    const std::size_t pilot = text.find("note: pilot of exphotonmap");
    const std::string before = "of samples ";
    const std::size_t at = text.find(before, text.find("; price", pilot));
    return at == std::string::npos ? 0 : std::atof(text.c_str() + at + before.size());
  };
  const std::string size = "64x48", rays = "SurfaceIntegrator.finalgathersamples=16";
  const std::string few =
      Render("30%", {"--integrator", "exphotonmap", "--resolution", size, "--verbose"}).err;
  const std::string all = Run({"quote", "room.pbrt", "--integrators", "exphotonmap", "--resolution",
                               size, "--set", rays, "--pilot-time", "1s", "--verbose"})
                              .err;
  EXPECT_GT(priceOf(few), 0) << few;
  EXPECT_NEAR(priceOf(all) / priceOf(few), 4, 1) << few << all;
}

// Shared gathers have less noise in a larger picture, whose pilots have the same pixels. The
// sampler takes any number of samples.
TEST_F(AccuracyTest, LargePicturesNeedFewerSamples) {
  Write("room.pbrt", "Sampler \"halton\"\n" + Read("room.pbrt"));
  const auto samples = [&](const char* size) {
    const std::string quote =
        Run({"quote", "room.pbrt", "--integrators", "exphotonmap", "--accuracies", "1%",
             "--resolution", size, "--pilot-time", ".001s", "--quiet"})
            .out;
    return NumberAfter(quote, "--spp ");
  };
  EXPECT_GT(samples("576x384"), 0);
  EXPECT_LT(samples("576x384"), samples("144x96"));
}

TEST_F(AccuracyTest, ShowsItsPilotsOnRequest) {
  const ProgramResult result = Render("30%", {"--verbose"});
  EXPECT_NE(result.err.find("pilot of path, 2 samples a pixel: noise "), std::string::npos);
  EXPECT_NE(result.err.find("pilot of exphotonmap"), std::string::npos) << result.err;
}

// The first pilot is rough. The second one makes one set of maps for all later ones.
TEST_F(AccuracyTest, PilotsShareTheirPhotons) {
  const std::string err = Render("1%", {"--integrator", "exphotonmap", "--verbose"}).err;
  std::vector<double> prices;
  const std::string before = "price of maps ";
  for (std::size_t at = err.find(before); at != std::string::npos; at = err.find(before, at + 1)) {
    const std::string line = err.substr(err.rfind('\n', at) + 1, at - err.rfind('\n', at));
    const std::size_t bias = line.find(", bias ");
    const bool isOfSharing = bias != std::string::npos && line.find("of sharing", bias) == bias + 7;
    if (bias != std::string::npos && !isOfSharing) break;
    prices.push_back(std::stod(err.substr(at + before.size())));
  }
  ASSERT_GE(prices.size(), 3u) << err;
  EXPECT_GT(prices[0], 0);
  EXPECT_GT(prices[1], 4 * prices[0]) << err;
  for (std::size_t i = 2; i < prices.size(); ++i) EXPECT_EQ(prices[i], 0) << err;
}

// The last pilot has the photons of the first group of passes, so the picture shoots photons for
// the other groups only.
TEST_F(AccuracyTest, ThePictureTakesThePhotonsOfThePilot) {
  const auto json = RenderAndRead("30%", {"--integrator", "exphotonmap"});
  ASSERT_EQ(json.at("passes"), 2);
  const ProgramResult plain = Run({"room.pbrt", "-o", "plain.exr", "--stats-json", "plain.json"});
  ASSERT_EQ(plain.status, 0) << plain.err;
  const double one = nlohmann::json::parse(Read("plain.json"))
                         .at("counters")
                         .at("photons/indirect stored")
                         .get<double>();
  const auto& pilots = json.at("accuracy").at("pilots");
  EXPECT_EQ(pilots.at("givesPhotons"), true);
  EXPECT_GE(pilots.at("renders"), 2);
  // A tenth of the photons for the rough pilot, and a quarter for the picture.
  EXPECT_NEAR(pilots.at("indirectPhotons").get<double>(), .35 * one, .03 * one);
  EXPECT_GT(pilots.at("rays").at("photon"), 0);
  // Both passes have these photons.
  EXPECT_FALSE(json.at("counters").contains("photons/indirect stored"));
  EXPECT_EQ(json.at("rays").at("photon"), 0);
}

// The world is made once, for the first pilot.
TEST_F(AccuracyTest, ThePictureTakesTheSceneOfThePilots) {
  const std::string room = Read("room.pbrt");
  Write("room.pbrt",
        room.substr(0, room.rfind("WorldEnd")) + "Shape \"sphere\" \"float radus\" 1\nWorldEnd\n");
  const ProgramResult result = Render("20%", {"--stats-json", "room.json"});
  ASSERT_EQ(result.status, 0) << result.err;
  const std::size_t first = result.err.find("radus");
  ASSERT_NE(first, std::string::npos) << result.err;
  EXPECT_LT(first, result.err.find("accuracy 20%")) << result.err;
  const std::string later = result.err.substr(result.err.find("accuracy 20%"));
  EXPECT_EQ(later.find("radus"), std::string::npos) << later;
  for (const auto& phase : nlohmann::json::parse(Read("room.json")).at("phases"))
    EXPECT_NE(phase.at("name"), "accelerator");
}

// The scene of the pilots lacks its fog, so the file is read again for the picture.
TEST_F(AccuracyTest, WarnsOfWhatTheUserSwitchesOff) {
  const std::string room = Read("room.pbrt");
  const std::size_t world = room.find("WorldBegin");
  Write("room.pbrt", "VolumeIntegrator \"emission\"\n" + room.substr(0, world) +
                         "WorldBegin\nVolume \"homogeneous\" \"color Le\" [.1 .1 .1]\n"
                         "Shape \"sphere\" \"float radus\" 1\n" +
                         room.substr(world + 10));
  const ProgramResult result = Render("30%", {"--effects", "media=off"});
  ASSERT_EQ(result.status, 0) << result.err;
  const auto count = [&](const std::string& text) {
    int hits = 0;
    for (std::size_t at = result.err.find(text); at != std::string::npos;
         at = result.err.find(text, at + 1))
      ++hits;
    return hits;
  };
  EXPECT_EQ(count("leaves out light that the scene needs"), 1) << result.err;
  EXPECT_EQ(count("unknown parameter \"radus\""), 1) << result.err;
  EXPECT_EQ(count("has nothing to do"), 0) << result.err;
}

// Rough pilots show whether an integrator may be the cheapest one.
TEST_F(AccuracyTest, IntegratorsGetRoughPilotsFirst) {
  const std::string err = Render("30%", {"--verbose"}).err;
  EXPECT_NE(err.find("rough pilot of exphotonmap"), std::string::npos) << err;
  EXPECT_NE(err.find("rough pilot of guidedpath"), std::string::npos) << err;
}

// In this room, path costs more than fifty times as much as exphotonmap.
TEST_F(AccuracyTest, GuidingGetsNoPilotWherePathIsFarDearer) {
  const std::string scene = EXPHOTON_SOURCE_DIR "/scenes/skylight-room/exphotonmap.pbrt";
  const ProgramResult result = Render("5%", {"--resolution", "32x24", "--verbose"}, scene);
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.err.find("rough pilot of exphotonmap"), std::string::npos) << result.err;
  EXPECT_EQ(result.err.find("pilot of guidedpath"), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("; guidedpath: no pilot, because path costs far more"),
            std::string::npos)
      << result.err;
}

TEST_F(AccuracyTest, PilotsStopShootingPhotonsThatCostMoreThanPath) {
  WriteRoom("dear.pbrt", "exphotonmap", 20000000);
  const ProgramResult result = Render("40%", {"--stats-json", "dear.json"}, "dear.pbrt");
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.err.find("exphotonmap: its photons cost more"), std::string::npos) << result.err;
  const auto json = nlohmann::json::parse(Read("dear.json"));
  EXPECT_EQ(json.at("integrator"), "path");
  EXPECT_LT(json.at("accuracy").at("pilots").at("indirectPhotons"), 1500000);
}

// The bias of 2000 photons is guessed to be 7.9 %, and 11 % with half of them.
TEST_F(AccuracyTest, TakesFewerPhotonsWhereTheyAreMany) {
  WriteRoom("many.pbrt", "exphotonmap", 200000);
  const Names one{"--integrator", "exphotonmap"};
  const ProgramResult few = Render("20%", one, "many.pbrt");
  EXPECT_NE(few.err.find("indirect photons 200000 -> 50000"), std::string::npos) << few.err;
  EXPECT_EQ(Render("15%", one).err.find("indirect photons"), std::string::npos);
  EXPECT_NE(Render("20%", one).err.find("indirect photons 2000 -> 1000"), std::string::npos);
  EXPECT_NE(Render("10%", one).err.find("indirect photons 2000 -> 4000"), std::string::npos);
}

// 20 photons blur all light, so their bias is far above 2 %.
TEST_F(AccuracyTest, TakesMorePhotonsAgainstBias) {
  WriteRoom("few.pbrt", "exphotonmap", 20);
  const Names one{"--integrator", "exphotonmap"};
  const ProgramResult more = Render("4%", one, "few.pbrt");
  ASSERT_EQ(more.status, 0) << more.err;
  EXPECT_NE(more.err.find("photons"), std::string::npos) << more.err;
  EXPECT_NE(more.err.find("the error lies below"), std::string::npos) << more.err;
  EXPECT_EQ(more.err.find("which is not the accuracy"), std::string::npos) << more.err;
}

TEST_F(AccuracyTest, KeepLeavesTheSceneAsItIs) {
  const ProgramResult kept = Render("30%", {"--keep"});
  ASSERT_EQ(kept.status, 0) << kept.err;
  EXPECT_NE(kept.err.find("--keep costs"), std::string::npos) << kept.err;
  EXPECT_EQ(kept.err.find("-> 16"), std::string::npos) << kept.err;
  WriteRoom("whitted.pbrt", "whitted", 1);
  const ProgramResult other = Render("30%", {"--keep"}, "whitted.pbrt");
  EXPECT_EQ(other.status, 1);
  EXPECT_NE(other.err.find("--integrator takes path"), std::string::npos) << other.err;
  EXPECT_EQ(Render("30%", {}, "whitted.pbrt").status, 0);
}

// Sharing blurs a dark strip in this room. At 4 % its bias and the interval of it are most of the
// error, so the picture needs fewer samples without sharing.
TEST_F(AccuracyTest, StopsSharingWhereItsBiasIsDear) {
  const std::string scene = EXPHOTON_SOURCE_DIR "/scenes/skylight-room/exphotonmap.pbrt";
  const auto render = [&](const Names& more) {
    Names options{
        "--resolution", "32x24",       "--seed",        "1",
        "--integrator", "exphotonmap", "--set",         "SurfaceIntegrator.finalgathersamples=16",
        "--stats-json", "room.json",   "--reproducible"};
    options.insert(options.end(), more.begin(), more.end());
    const ProgramResult result = Render("4%", options, scene);
    EXPECT_EQ(result.status, 0) << result.err;
    return result.err;
  };
  const std::string words = "gathers shared -> not shared", notice = render({"--nthreads", "1"});
  EXPECT_NE(notice.find(words + " after "), std::string::npos) << notice;
  const auto json = nlohmann::json::parse(Read("room.json"));
  EXPECT_EQ(json.at("stoppedBy"), "accuracy");
  EXPECT_NE(json.at("accuracy").at("chosen").get<std::string>().find(words), std::string::npos);
  EXPECT_FALSE(json.at("counters").contains("render/sharing bias"));
  const std::string picture = Read("room.exr");
  render({"--nthreads", "3"});
  EXPECT_EQ(Read("room.exr"), picture);
  const std::string kept = render({"--keep"});
  EXPECT_EQ(kept.find(words), std::string::npos) << kept;
}

TEST_F(AccuracyTest, SaysWhatIsWrong) {
  const auto refused = [&](const std::string& accuracy, const Names& more, const char* text) {
    const ProgramResult result = Render(accuracy, more);
    EXPECT_EQ(result.status, 1) << result.err;
    EXPECT_NE(result.err.find(text), std::string::npos) << result.err;
    EXPECT_FALSE(Exists("room.exr"));
  };
  refused("0.02", {}, "percentages");
  refused("2", {}, "percentages");
  refused("0%", {}, "percentages");
  refused("101%", {}, "percentages");
  refused("1e-9%", {}, "percentages from 0.001 to 100");
  refused("2%", {"--spp", "4"}, "--spp");
  refused("2%", {"--target-error", ".01"}, "--target-error");
  refused("2%", {"--two-halves"}, "--two-halves");
  refused("2%", {"--certify"}, "--certify");
  refused("2%", {"--progressive"}, "--progressive");
  refused("2%", {"--photons", "x.expm"}, "--photons");
  refused("2%", {"--shard", "1/2"}, "--shard");
  refused("2%", {"--integrator", "whitted"}, "cannot be estimated");
  EXPECT_EQ(Run({"room.pbrt", "--keep"}).status, 1);
  Write("two.pbrt", Read("room.pbrt") + Read("room.pbrt"));
  EXPECT_NE(Run({"two.pbrt", "--accuracy", "30%"}).err.find("holds 2 scenes"), std::string::npos);
}

// On a busy machine only one group may fit.
TEST_F(AccuracyTest, ATimeLimitComesFirst) {
  const ProgramResult result =
      Render("0.02%", {"--integrator", "path", "--time-limit", "3s", "--stats-json", "room.json"});
  ASSERT_EQ(result.status, 0) << result.err;
  const bool hasGroups = result.err.find("1 pass") == std::string::npos;
  const char* const text = hasGroups ? "which is not the accuracy of 0.02 %: the time limit"
                                     : "cannot show whether the accuracy of 0.02 % is reached";
  EXPECT_NE(result.err.find(text), std::string::npos) << result.err;
  EXPECT_EQ(nlohmann::json::parse(Read("room.json")).at("stoppedBy"), "time-limit");
}

}  // namespace
}  // namespace exphoton
