// SPDX-License-Identifier: BSD-2-Clause
// These tests run `exphoton check-plugin` on every material, light and sampler of the program, on
// the example of docs/development/writing-a-plugin.md, and on plugins that are wrong on purpose,
// where it must name the check that fails.
#include <gtest/gtest.h>

#include <algorithm>

#include "core/plugins/registry.h"
#include "tests/support/process.h"

namespace exphoton {
namespace {

ProcessResult Check(const std::vector<std::string>& arguments) {
  const TestFolder folder;
  std::vector<std::string> words{EXPHOTON_BINARY_DIR "/bin/exphoton", "check-plugin"};
  words.insert(words.end(), arguments.begin(), arguments.end());
  return RunProcess({.words = words, .folder = folder.Path(), .timeLimit = 300});
}

// Returns the names of the checks that failed.
std::vector<std::string> FailuresOf(const ProcessResult& result) {
  std::vector<std::string> names;
  for (std::size_t at = 0; (at = result.out.find("FAILED  ", at)) != std::string::npos; ++at) {
    const std::string name = result.out.substr(at + 8, 18);
    names.push_back(name.substr(0, name.find_last_not_of(' ') + 1));
  }
  return names;
}

std::vector<std::string> Available(PluginKind kind) {
  const PluginRegistry registry({std::string(EXPHOTON_BINARY_DIR) + "/plugins"}, nullptr);
  return registry.Available(kind);
}

// The defaults of version 1 add up to more than 1 in these.
bool GainsEnergyByDefault(const std::string& name) {
  return name == "plastic" || name == "shinymetal" || name == "translucent" || name == "uber";
}

std::string ParametersFor(const std::string& name) {
  if (name == "shinymetal") return R"("color Ks" [.5 .4 .3] "color Kr" [.4 .5 .6])";
  if (GainsEnergyByDefault(name)) return R"("color Kd" [.5 .4 .3] "color Ks" [.4 .5 .6])";
  if (name == "measured")
    return "\"string filename\" \"" EXPHOTON_SOURCE_DIR "/tests/random/glossy.brdf\"";
  if (name == "mix") return R"("string namedmaterial1" "matte" "string namedmaterial2" "mirror")";
  return "";
}

void ExpectPassed(const std::string& name, const std::string& parameters) {
  const ProcessResult result = parameters.empty() ? Check({name}) : Check({name, parameters});
  EXPECT_EQ(result.status, 0) << name << " " << parameters << "\n" << result.out << result.err;
  EXPECT_TRUE(FailuresOf(result).empty());
  EXPECT_NE(result.out.find("checks passed"), std::string::npos) << result.out;
}

TEST(CheckPlugin, PassesEveryMaterialButThoseThatGainEnergy) {
  const std::vector<std::string> names = Available(PluginKind::Material);
  EXPECT_GE(names.size(), 17u);
  for (const std::string& name : names)
    if (name != "brushedmetal") ExpectPassed(name, ParametersFor(name));
  for (const std::string& name : names) {
    if (name != "brushedmetal" && !GainsEnergyByDefault(name)) continue;
    const ProcessResult result = Check({name});
    EXPECT_EQ(result.status, 1);
    EXPECT_EQ(FailuresOf(result), std::vector<std::string>{"energy"}) << result.out;
    EXPECT_NE(result.out.find("note    energy: where colours add up"), std::string::npos);
  }
}

TEST(CheckPlugin, PassesMaterialsWithOtherParameters) {
  ExpectPassed("plastic", R"("color Kd" [.5 .5 .5] "color Ks" [.4 .4 .4] "float roughness" .02)");
  ExpectPassed("plastic", R"("color Kd" [.5 .5 .5] "string fresnel" "physical")");
  ExpectPassed("matte", R"("float sigma" 40)");
  ExpectPassed(
      "uber",
      R"("color Kd" [.2 .2 .2] "color Ks" [.2 .2 .2] "color Kt" [.5 .5 .5] "float index" 1.3)");
  ExpectPassed("glass", R"("float index" 1.8 "color Kr" [.5 1 1] "color Kt" [1 .4 .9])");
  ExpectPassed("substrate", R"("float uroughness" .01 "float vroughness" .2)");
  ExpectPassed("translucent",
               R"("color Kd" [.5 .5 .5] "color Ks" [.4 .4 .4] "color transmit" [.3 .3 .3])");
}

TEST(CheckPlugin, PassesEveryLight) {
  for (const std::string& name : Available(PluginKind::Light))
    if (name != "infinitesample") ExpectPassed(name, "");
  for (const std::string& name : Available(PluginKind::AreaLight)) ExpectPassed(name, "");
  // Four by two texels of unlike colours.
  const std::string path = testing::TempDir() + "exphoton-check.hdr";
  WriteFile(path, std::string("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 4\n") +
                      "\x80\x40\x20\x81\x40\x80\x10\x82\x20\x20\x90\x81\x90\x90\x90\x80" +
                      "\x50\x40\x20\x82\x40\x90\x10\x80\x20\x30\x90\x82\x90\x30\x90\x81");
  const std::string map = "\"string mapname\" \"" + path + "\"";
  for (const char* name : {"infinite", "goniometric", "projection"}) ExpectPassed(name, map);
  ExpectPassed("spot", R"("float coneangle" 70 "float conedeltaangle" 70)");
}

TEST(CheckPlugin, PassesEverySampler) {
  for (const std::string& name : Available(PluginKind::Sampler)) ExpectPassed(name, "");
  ExpectPassed("random", R"("integer xsamples" 1 "integer ysamples" 1)");
  ExpectPassed("lowdiscrepancy", R"("integer pixelsamples" 64)");
}

TEST(CheckPlugin, RefusesWhatItCannotCheck) {
  ProcessResult result = Check({"sphere"});
  EXPECT_EQ(result.status, 1);
  EXPECT_NE(
      result.err.find("\"sphere\" is a shape; only materials, lights and samplers are checked"),
      std::string::npos)
      << result.err;
  result = Check({"mate"});
  EXPECT_EQ(result.status, 1);
  EXPECT_NE(result.err.find("did you mean \"matte\"?"), std::string::npos) << result.err;
  result = Check({"matte", "\"color Kq\" [1 1 1]", "\"float sigma\" 1000"});
  EXPECT_EQ(result.status, 2);
  EXPECT_NE(result.err.find("sigma"), std::string::npos) << result.err;
}

#ifndef EXPHOTON_STATIC_PLUGINS

TEST(CheckPlugin, PassesTheExampleMaterialOfTheDocumentation) {
  const ProcessResult result =
      Check({"--plugin-dir", EXPHOTON_BINARY_DIR "/example_plugins", "velvet"});
  EXPECT_EQ(result.status, 0) << result.out << result.err;
}

TEST(CheckPlugin, NamesTheCheckThatAWrongPluginFails) {
  struct Case {
    const char *name, *check;
  };
  for (const Case& wrong :
       {Case{"greedy", "energy"}, Case{"misstated", "density"}, Case{"unweighted", "sample values"},
        Case{"oneway", "reciprocity"}, Case{"dim", "power"}, Case{"lopsided", "emission density"},
        Case{"misguided", "direct density"}, Case{"stuck", "repetition"}, Case{"moody", "order"},
        Case{"slanted", "order"}, Case{"beyond", "range"}, Case{"bunched", "uniformity"}}) {
    const ProcessResult result =
        Check({"--plugin-dir", EXPHOTON_BINARY_DIR "/wrong_plugins", wrong.name});
    EXPECT_EQ(result.status, 1) << wrong.name << "\n" << result.out << result.err;
    const std::vector<std::string> failures = FailuresOf(result);
    EXPECT_NE(std::find(failures.begin(), failures.end(), wrong.check), failures.end())
        << wrong.name << "\n"
        << result.out << result.err;
  }
}

#endif

}  // namespace
}  // namespace exphoton
