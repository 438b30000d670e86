// SPDX-License-Identifier: BSD-2-Clause
// These tests check the changes that the command line makes to a scene: --set, --integrator,
// --quick, --spp and --effects.
#include "core/parser/overrides.h"

#include <gtest/gtest.h>

#include "core/parser/effect_choice.h"
#include "core/plugins/registry.h"
#include "tests/parser/parse_support.h"

namespace exphoton {
namespace {

const std::string kScene = InWorld("");
const std::string kEmptyWorld = "Accelerator \"bruteforce\" WorldBegin WorldEnd";

TEST(Overrides, SetAParameterAsIfTheFileSaidIt) {
  LoadOptions options;
  options.parameters = {{"Film", "xresolution", "32"}, {"Sampler", "pixelsamples", "16"}};
  const BuiltScene built = BuildText(kScene, options);
  ASSERT_EQ(built.error, "");
  EXPECT_EQ(built.setups[0]->film.xResolution, 32);
  EXPECT_EQ(built.setups[0]->sampler->SamplesPerPixel(), 16);
}

TEST(Overrides, AreErrorsOfTheCommandLine) {
  const auto errorOf = [](const ParameterOverride& override) {
    LoadOptions options;
    options.parameters = {override};
    const BuiltScene built = BuildText(kScene, options);
    EXPECT_EQ(built.status, 1) << built.error;
    return built.error;
  };
  EXPECT_EQ(errorOf({"Film", "xresolutoin", "3"}),
            "<command line>:1:24: error: --set: unknown parameter \"xresolutoin\" of film "
            "\"image\"\n    --set Film.xresolutoin=3\n                           ^\n"
            "    hint: did you mean \"xresolution\"?\n");
  EXPECT_EQ(errorOf({"Film", "xresolution", "wide"}),
            "<command line>:1:24: error: parameter \"xresolution\" takes numbers, not \"wide\"\n"
            "    --set Film.xresolution=wide\n                           ^\n");
  EXPECT_NE(errorOf({"Shape", "radius", "3"})
                .find("--set: \"Shape\" cannot be set; available: Accelerator, Camera, Film, "
                      "PixelFilter, Sampler, SurfaceIntegrator"),
            std::string::npos);
  EXPECT_NE(errorOf({"Film", "xresolution", "0"}), "");  // out of range
}

TEST(Overrides, OfParametersThatNoLongerExistNameTheReplacement) {
  LoadOptions options;
  options.parameters = {{"SurfaceIntegrator", "shortgather", "gather"}};
  const BuiltScene built = BuildText("SurfaceIntegrator \"exphotonmap\"\n" + kScene, options);
  EXPECT_EQ(built.status, int(ExitStatus::CommandLine)) << built.error;
  EXPECT_EQ(built.error.find("<command line>:1:37: error: parameter \"shortgather\" of integrator "
                             "\"exphotonmap\" no longer exists: gather rays shorter than "),
            0u)
      << built.error;
  EXPECT_NE(built.error.find("    hint: delete it; "), std::string::npos) << built.error;
}

TEST(Overrides, SwapTheIntegratorAndOnlyNoticeItsOldParameters) {
  LoadOptions options;
  options.integrator = "path";
  options.isStrict = true;
  const BuiltScene built = BuildText(
      "SurfaceIntegrator \"directlighting\" \"string strategy\" \"all\"\n" + kScene, options);
  ASSERT_EQ(built.error, "");
  EXPECT_EQ(built.setups[0]->integratorName, "path");
  EXPECT_NE(built.Messages().find("note: parameter \"strategy\" does not apply to integrator "
                                  "\"path\"; another plugin of this kind has it"),
            std::string::npos)
      << built.Messages();
}

// Returns the declaration of an integrator's parameter. The registry must outlive the result.
const ParamDecl* Declared(PluginRegistry& registry, const std::string& integrator,
                          const std::string& parameter) {
  const auto* all = registry.Declarations(PluginKind::Integrator, integrator);
  if (!all) return nullptr;
  for (const ParamDecl& decl : *all)
    if (decl.name == parameter) return &decl;
  return nullptr;
}

// A changed description of a parameter may change this list.
TEST(Overrides, KnowWhichParametersMeanTheSame) {
  Log log(Log::Level::Quiet, Log::Sink::Memory);
  PluginRegistry registry(PluginRegistry::DefaultFolders({}), &log);
  const auto meansTheSame = [&](const char* parameter, const char* a, const char* b) {
    const ParamDecl* const first = Declared(registry, a, parameter);
    const ParamDecl* const second = Declared(registry, b, parameter);
    EXPECT_TRUE(first && second) << parameter << a << b;
    return first && second && MeansTheSame(*first, *second);
  };
  for (const char* name : {"maxdepth", "nused", "maxdist", "rrthreshold", "finalgathersamples"})
    EXPECT_TRUE(meansTheSame(name, "exphotonmap", "photonmap")) << name;
  for (const char* name : {"whitted", "directlighting", "photonmap"})
    EXPECT_TRUE(meansTheSame("maxdepth", "exphotonmap", name)) << name;
  EXPECT_TRUE(meansTheSame("maxdepth", "path", "bidirectional"));
  EXPECT_TRUE(meansTheSame("maxdepth", "path", "guidedpath"));
  for (const char* name : {"whitted", "directlighting", "photonmap", "exphotonmap", "igi"})
    EXPECT_FALSE(meansTheSame("maxdepth", "path", name)) << name;
  EXPECT_FALSE(meansTheSame("maxdist", "exphotonmap", "ambientocclusion"));
  EXPECT_FALSE(meansTheSame("mindist", "igi", "ambientocclusion"));
  EXPECT_FALSE(meansTheSame("rrthreshold", "igi", "exphotonmap"));
  EXPECT_FALSE(meansTheSame("nsamples", "irradiancecache", "ambientocclusion"));
}

TEST(Overrides, OfAnUnknownIntegratorAreErrorsOfTheCommandLine) {
  LoadOptions options;
  options.integrator = "pth";
  const BuiltScene built = BuildText(kScene, options);
  EXPECT_EQ(built.status, 1);
  EXPECT_NE(built.error.find("there is no integrator \"pth\""), std::string::npos) << built.error;
}

TEST(Overrides, QuickQuartersTheResolutionAndTakesOneSample) {
  LoadOptions options;
  options.isQuick = true;
  const BuiltScene built = BuildText(
      "Film \"image\" \"integer xresolution\" 41 \"integer yresolution\" 2\n" + kEmptyWorld,
      options);
  ASSERT_EQ(built.error, "");
  EXPECT_EQ(built.setups[0]->film.xResolution, 10);
  EXPECT_EQ(built.setups[0]->film.yResolution, 1);
  EXPECT_EQ(built.setups[0]->sampler->SamplesPerPixel(), 1);
  options.samplesPerPixel = 16;
  const BuiltScene sixteen = BuildText(kEmptyWorld, options);
  ASSERT_EQ(sixteen.error, "");
  EXPECT_EQ(sixteen.setups[0]->sampler->SamplesPerPixel(), 16);
}

TEST(Overrides, QuickDividesGivenAndDefaultCounts) {
  ParamDecl photons, used, gather, other;
  photons.name = "indirectphotons", photons.defaultText = "100000", photons.min = 0;
  used.name = "nused", used.defaultText = "50", used.min = 2;
  gather.name = "finalgathersamples", gather.defaultText = "32", gather.min = 1;
  photons.quickDivisor = used.quickDivisor = 10, gather.quickDivisor = 4;
  other.name = "maxdepth", other.defaultText = "5";
  ParamSet params;
  ParsedParam given;
  given.type = "integer", given.name = "nused", given.numbers = {15};
  params.Add(given);
  ScaleForQuick({photons, used, gather, other}, &params);
  EXPECT_EQ(params.Find("indirectphotons")->numbers[0], 10000);
  EXPECT_EQ(params.Find("nused")->numbers[0], 2);
  EXPECT_EQ(params.Find("finalgathersamples")->numbers[0], 8);
  EXPECT_EQ(params.Find("maxdepth"), nullptr);
}

TEST(Overrides, QuickLeavesNoPhotonsNone) {
  ParamDecl photons;
  photons.name = "causticphotons", photons.defaultText = "20000", photons.min = 0;
  photons.quickDivisor = 10;
  ParamSet params;
  ParsedParam given;
  given.type = "integer", given.name = "causticphotons", given.numbers = {0};
  params.Add(given);
  ScaleForQuick({photons}, &params);
  EXPECT_EQ(params.Find("causticphotons")->numbers[0], 0);
  given.numbers = {9};
  params.Add(given);
  ScaleForQuick({photons}, &params);
  EXPECT_EQ(params.Find("causticphotons")->numbers[0], 1);  // few are not none
}

TEST(Overrides, CropByPixelsWithinThePicture) {
  LoadOptions options;
  options.pixelBounds = PixelBounds{2, 1, 100, 3};
  EXPECT_EQ(BuildText(kScene, options).setups.at(0)->crop, (PixelBounds{2, 1, 4, 3}));
  options.pixelBounds = PixelBounds{4, 0, 5, 1};
  const BuiltScene outside = BuildText(kScene, options);
  EXPECT_EQ(outside.status, 1);
  EXPECT_EQ(outside.error,
            "exphoton: error: the requested pixels lie outside the picture of 4 x 4\n");
}

TEST(EffectChoice, AllSwitchesEverythingOn) {
  RequiredFeatures plan;
  plan.Set(Feature::Caustics, false, "no specular surface");
  Log log(Log::Level::Normal, Log::Sink::Memory);
  EXPECT_TRUE(ChooseEffects(plan, "all", log).Needs(Feature::Caustics));
  EXPECT_FALSE(ChooseEffects(plan, "auto", log).Needs(Feature::Caustics));
  EXPECT_EQ(log.WarningCount(), 0);
}

TEST(EffectChoice, AllKeepsTheNotesAboutTheScene) {
  RequiredFeatures plan;
  plan.notes = {"a lamp is far away"};
  Log log(Log::Level::Normal, Log::Sink::Memory);
  EXPECT_EQ(ChooseEffects(plan, "all", log).notes, plan.notes);
  EXPECT_EQ(ChooseEffects(plan, "caustics=off", log).notes, plan.notes);
}

TEST(EffectChoice, WarnsWhereSomethingNeededIsSwitchedOff) {
  Log log(Log::Level::Normal, Log::Sink::Memory);
  RequiredFeatures plan;
  plan.Set(Feature::Lens, false, "pinhole camera");
  const RequiredFeatures chosen = ChooseEffects(plan, "caustics=off,lens=off,media=on", log);
  EXPECT_FALSE(chosen.Needs(Feature::Caustics));
  EXPECT_TRUE(chosen.Needs(Feature::Media));
  EXPECT_EQ(log.WarningCount(), 1);
  EXPECT_EQ(log.Messages()[0],
            "exphoton: warning: --effects caustics=off leaves out light that the scene needs\n");
}

TEST(EffectChoice, SaysWhatThePictureLoses) {
  Log log(Log::Level::Normal, Log::Sink::Memory);
  ChooseEffects(RequiredFeatures(), "motion=off,lens=off", log);
  ASSERT_EQ(log.WarningCount(), 2);
  EXPECT_EQ(
      log.Messages()[0],
      "exphoton: warning: --effects motion=off shows the moment at which the shutter opens\n");
  EXPECT_EQ(log.Messages()[1],
            "exphoton: warning: --effects lens=off shows the scene through a pinhole\n");
}

TEST(EffectChoice, RefusesWhatItDoesNotKnow) {
  Log log(Log::Level::Normal, Log::Sink::Memory);
  for (const char* text : {"", "none", "caustic=off", "caustics", "caustics=no", "caustics=off,"}) {
    try {
      ChooseEffects(RequiredFeatures(), text, log);
      ADD_FAILURE() << text;
    } catch (const Error& error) {
      EXPECT_EQ(error.Status(), ExitStatus::CommandLine);
    }
  }
}

}  // namespace
}  // namespace exphoton
