// SPDX-License-Identifier: BSD-2-Clause
// These tests render a room whose caustics take most of the time and bring hardly any light, and
// ask for an accuracy.
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "tests/cli/program.h"

namespace exphoton {
namespace {

class OmissionTest : public ProgramTest {
 protected:
  OmissionTest() {
    std::ifstream file(EXPHOTON_SOURCE_DIR "/tests/benchmark/omissions/dim-mirror.pbrt");
    Write("room.pbrt", {std::istreambuf_iterator<char>(file), {}});
  }
  // Returns the messages.
  std::string Render(const std::vector<std::string>& options) const {
    std::vector<std::string> words{"room.pbrt", "--integrator", "exphotonmap",    "-o",
                                   "room.exr",  "--stats-json", "statistics.json"};
    words.insert(words.end(), options.begin(), options.end());
    const ProgramResult result = Run(words);
    EXPECT_EQ(result.status, 0) << result.err;
    return result.err;
  }
  nlohmann::json Statistics() const { return nlohmann::json::parse(Read("statistics.json")); }
};

bool Has(const std::string& text, const char* part) { return text.find(part) != text.npos; }

TEST_F(OmissionTest, SaysWhatItLeavesOutAndAddsItToTheError) {
  const std::string err = Render({"--accuracy", "2.5%"});
  EXPECT_TRUE(Has(err, "caustics off: at most 0.")) << err;
  EXPECT_TRUE(Has(err, " % of the light, would take ")) << err;
  EXPECT_TRUE(Has(err, "of which effects left out are at most 0.")) << err;
  const auto json = Statistics();
  const auto& omitted = json.at("accuracy").at("omitted");
  ASSERT_EQ(omitted.size(), 1u);
  EXPECT_EQ(omitted[0].at("effect"), "caustics");
  const double bound = omitted[0].at("bound"), time = omitted[0].at("time");
  EXPECT_GT(bound, 0);
  EXPECT_LE(bound, .0025);  // a tenth of the accuracy
  EXPECT_GT(time, .5);
  // The pilot with all photons of the picture lacks the effect already, so the picture takes them.
  EXPECT_TRUE(json.at("accuracy").at("pilots").at("givesPhotons"));
  // Without the bound, noise and its interval alone would be the error.
  const double noise = json.at("noise"), error = json.at("accuracy").at("upperError");
  EXPECT_GE(error, std::sqrt(noise) + bound);
  EXPECT_FALSE(json.at("effects").at("caustics").at("on"));
  EXPECT_FALSE(json.at("counters").contains("photons/caustic stored"));
  const std::string info = Run({"info", "room.exr"}).out;
  EXPECT_TRUE(Has(info, "accuracy/omitted caustics off: at most")) << info;
  EXPECT_TRUE(Has(info, "accuracy/omittedBound")) << info;
}

// Only small renders have the effect.
TEST_F(OmissionTest, ThePilotWithAllPhotonsLacksTheEffect) {
  const auto causticPhotons = [&](const std::vector<std::string>& options) {
    Render(options);
    return Statistics().at("accuracy").at("pilots").at("causticPhotons").get<double>();
  };
  const double without = causticPhotons({"--accuracy", "2.5%"});
  EXPECT_LT(without, causticPhotons({"--accuracy", "2.5%", "--effects", "all"}));
}

TEST_F(OmissionTest, KeepsWhatTheUserNames) {
  for (const char* effects : {"all", "glossy=on,caustics=on"}) {
    const std::string err = Render({"--accuracy", "2.5%", "--effects", effects});
    EXPECT_FALSE(Has(err, "caustics off")) << err;
    EXPECT_TRUE(Statistics().at("accuracy").at("omitted").empty());
    EXPECT_TRUE(Statistics().at("effects").at("caustics").at("on"));
  }
}

// An effect with more light than a tenth of the accuracy needs no pairs of renders.
TEST_F(OmissionTest, TriesNoEffectThatBringsMuchLight) {
  const std::string accurate = Render({"--accuracy", "2.5%", "--verbose"});
  // A pilot shows about a fifth of the light, and its photons are noisy.
  bool isFifth = false;
  for (int percent = 17; percent <= 23; ++percent)
    isFifth = isFifth || Has(accurate, ("indirect stays on: " + std::to_string(percent) +
                                        " % of the light of a pilot")
                                           .c_str());
  EXPECT_TRUE(isFifth) << accurate;
  EXPECT_TRUE(Has(accurate, "caustics off")) << accurate;
  EXPECT_FALSE(Has(accurate, "specular stays on")) << accurate;
  EXPECT_TRUE(Statistics().at("effects").at("indirect").at("on"));
}

// Caustics take a small part of the time here, less than the pairs of renders would.
TEST_F(OmissionTest, TriesNothingThatCannotPay) {
  const ProgramResult result =
      Run({EXPHOTON_SOURCE_DIR "/scenes/glossy-room/exphotonmap.pbrt", "--resolution", "64x48",
           "--accuracy", "5%", "--verbose", "-o", "glossy.exr", "--stats-json", "glossy.json"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_FALSE(Has(result.err, " off: at most")) << result.err;
  EXPECT_FALSE(Has(result.err, " % of the light, takes ")) << result.err;
  const auto json = nlohmann::json::parse(Read("glossy.json"));
  EXPECT_LE(json.at("accuracy").at("pilots").at("renders"), 5);
}

TEST_F(OmissionTest, LeavesOutNothingWithKeep) {
  EXPECT_FALSE(Has(Render({"--accuracy", "2.5%", "--keep"}), "caustics off"));
  EXPECT_TRUE(Statistics().at("effects").at("caustics").at("on"));
}

TEST_F(OmissionTest, LeavesOutNothingWithoutAnAccuracy) {
  const std::string err = Render({"--spp", "2"});
  EXPECT_TRUE(Has(err, "effects: caustics, ")) << err;
  EXPECT_FALSE(Has(err, "caustics off")) << err;
  EXPECT_FALSE(Statistics().contains("accuracy"));
  EXPECT_GT(Statistics().at("counters").at("photons/caustic stored"), 0);
}

TEST_F(OmissionTest, DoesNotDependOnThreads) {
  std::string pictures[3];
  const char* const threads[] = {"1", "2", "7"};
  for (int i = 0; i < 3; ++i) {
    Render({"--accuracy", "2.5%", "--nthreads", threads[i], "--reproducible"});
    pictures[i] = Read("room.exr");
  }
  EXPECT_EQ(pictures[0], pictures[1]);
  EXPECT_EQ(pictures[0], pictures[2]);
}

}  // namespace
}  // namespace exphoton
