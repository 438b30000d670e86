// SPDX-License-Identifier: BSD-2-Clause
// These tests check that each option of `exphoton render` arrives in its field of RenderCommand,
// the defaults of all fields, and the values that options take and refuse.
#include "core/app/options/options.h"

#include <gtest/gtest.h>

#include "core/app/options/values.h"
#include "core/base/error.h"

namespace exphoton::cli {
namespace {

using Words = std::vector<std::string>;

RenderCommand Parse(const Words& words) { return ParseRenderCommand(words, RenderMode::Render); }

// Returns the message of the error of the command line, or "" if there is none.
template <class Work>
std::string ErrorOf(Work&& work) {
  try {
    work();
  } catch (const Error& error) {
    EXPECT_EQ(error.Status(), ExitStatus::CommandLine);
    return error.what();
  }
  return "";
}
std::string ErrorOfOptions(const Words& words) {
  return ErrorOf([&] { Parse(words); });
}

TEST(RenderOptionDefaults, AreThoseOfTheManual) {
  const RenderCommand command = Parse({});
  EXPECT_EQ(command.scenes, Words{"-"});
  EXPECT_EQ(command.mode, RenderMode::Render);
  EXPECT_EQ(command.outfile + command.previewFile + command.statsFile, "");
  EXPECT_TRUE(command.aovs.IsEmpty());
  EXPECT_FALSE(command.timeLimit || command.targetError || command.HasStoppingRule());
  EXPECT_FALSE(command.asTwoHalves || command.printsStatistics || command.isReproducible);
  EXPECT_TRUE(command.asHalf);
  EXPECT_TRUE(command.showsProgress);
  EXPECT_EQ(command.threadCount, 0);
  EXPECT_EQ(command.seed, 0u);
  EXPECT_EQ(command.footprintSamples, 0);
  EXPECT_EQ(command.logLevel, Log::Level::Normal);
  EXPECT_FALSE(command.limits.memoryBytes || command.limits.seconds);
  const LoadOptions& load = command.load;
  EXPECT_FALSE(load.allowsScenePlugins || load.isStrict || load.isQuick);
  EXPECT_EQ(load.dialect, std::nullopt);
  EXPECT_FALSE(load.integrator || load.cropWindow || load.pixelBounds || load.samplesPerPixel);
  EXPECT_TRUE(load.parameters.empty());
  EXPECT_EQ(load.effects, "auto");
  EXPECT_EQ(load.threads, 1);
}

TEST(RenderOptionDefaults, LeaveTheModeToTheCommand) {
  EXPECT_EQ(ParseRenderCommand({}, RenderMode::Explain).mode, RenderMode::Explain);
  EXPECT_EQ(ParseRenderCommand({}, RenderMode::Check).mode, RenderMode::Check);
}

TEST(RenderOption, OfTheSceneArrivesInItsField) {
  EXPECT_EQ(Parse({"a.pbrt", "-", "b.pbrt"}).scenes, (Words{"a.pbrt", "-", "b.pbrt"}));
  EXPECT_EQ(Parse({"--integrator", "path"}).load.integrator, "path");
  EXPECT_EQ(Parse({"--spp", "17"}).load.samplesPerPixel, 17);
  EXPECT_EQ(Parse({"--spp", "1073741824"}).load.samplesPerPixel, 1 << 30);
  EXPECT_EQ(Parse({"--cropwindow", ".25,.5,0,1"}).load.cropWindow,
            (std::vector<Real>{Real(.25), Real(.5), 0, 1}));
  EXPECT_EQ(Parse({"--pixelbounds", "1,5,2,9"}).load.pixelBounds, (PixelBounds{1, 2, 5, 9}));
  EXPECT_EQ(Parse({"--pixel", "3,7"}).load.pixelBounds, (PixelBounds{3, 7, 4, 8}));
  EXPECT_TRUE(Parse({"--quick"}).load.isQuick);
  EXPECT_EQ(Parse({"--effects", "caustics=off"}).load.effects, "caustics=off");
  EXPECT_EQ(Parse({"--dialect", "v2"}).load.dialect, Dialect::V2);
  EXPECT_EQ(Parse({"--dialect", "v1"}).load.dialect, Dialect::V1);
  EXPECT_TRUE(Parse({"--strict"}).load.isStrict);
  EXPECT_TRUE(Parse({"--allow-scene-plugins"}).load.allowsScenePlugins);
  EXPECT_EQ(Parse({"--plugin-dir", "/usr", "--plugin-dir", "/"}).load.pluginFolders[0], "/usr");
  const auto sets = Parse({"--set", "Film.xresolution=9", "--set", "Sampler.a.b=c=d"});
  ASSERT_EQ(sets.load.parameters.size(), 2u);
  EXPECT_EQ(sets.load.parameters[0].directive, "Film");
  EXPECT_EQ(sets.load.parameters[0].parameter, "xresolution");
  EXPECT_EQ(sets.load.parameters[0].value, "9");
  EXPECT_EQ(sets.load.parameters[1].parameter, "a.b");
  EXPECT_EQ(sets.load.parameters[1].value, "c=d");
  const Limits limits = Parse({"--limits", "memory=2G,time=3m,includes=5,texturenodes=6"}).limits;
  EXPECT_EQ(limits.memoryBytes, 2147483648.);
  EXPECT_EQ(limits.seconds, 180.);
  EXPECT_EQ(limits.scene.includes, 5);
  EXPECT_EQ(limits.scene.textureNodes, 6);
  const RenderCommand both = Parse({"--limits", "includes=5,texturenodes=6"});
  EXPECT_EQ(both.load.limits.includes, 5);
  EXPECT_EQ(both.load.limits.textureNodes, 6);
}

TEST(RenderOption, OfTheRunArrivesInItsField) {
  EXPECT_EQ(Parse({"-o", "x.exr"}).outfile, "x.exr");
  EXPECT_EQ(Parse({"--outfile", "x.exr"}).outfile, "x.exr");
  EXPECT_EQ(Parse({"--nthreads", "4096"}).threadCount, 4096);
  EXPECT_EQ(Parse({"--ncores", "3"}).threadCount, 3);
  EXPECT_EQ(Parse({"--seed", "18446744073709551615"}).seed, ~std::uint64_t(0));
  EXPECT_EQ(Parse({"--footprint-spp", "12"}).footprintSamples, 12);
  EXPECT_TRUE(Parse({"--half"}).asHalf);
  EXPECT_FALSE(Parse({"--float"}).asHalf);
  EXPECT_EQ(Parse({"--time-limit", "2m"}).timeLimit, 120.);
  EXPECT_TRUE(Parse({"--time-limit", "2m"}).HasStoppingRule());
  EXPECT_EQ(Parse({"--target-error", ".125"}).targetError, .125);
  EXPECT_TRUE(Parse({"--target-error", ".125"}).HasStoppingRule());
  EXPECT_TRUE(Parse({"--two-halves"}).asTwoHalves);
  EXPECT_EQ(Parse({"--aov", "albedo,N"}).aovs.Names(), "albedo, N");
  EXPECT_EQ(Parse({"--preview", "x.png"}).previewFile, "x.png");
  EXPECT_TRUE(Parse({"--reproducible"}).isReproducible);
  EXPECT_EQ(Parse({"--check"}).mode, RenderMode::Check);
  EXPECT_EQ(Parse({"--explain"}).mode, RenderMode::Explain);
  EXPECT_TRUE(Parse({"--stats"}).printsStatistics);
  EXPECT_EQ(Parse({"--stats-json", "s.json"}).statsFile, "s.json");
  EXPECT_EQ(Parse({"--quiet"}).logLevel, Log::Level::Quiet);
  EXPECT_FALSE(Parse({"--quiet"}).showsProgress);
  EXPECT_EQ(Parse({"--verbose"}).logLevel, Log::Level::Verbose);
  EXPECT_TRUE(Parse({"--verbose"}).showsProgress);
  EXPECT_FALSE(Parse({"--no-progress"}).showsProgress);
  EXPECT_EQ(Parse({"--no-progress"}).logLevel, Log::Level::Normal);
}

TEST(RenderOption, ExcludesOthers) {
  EXPECT_EQ(ErrorOfOptions({"--half", "--float"}), "--half and --float exclude each other");
  EXPECT_EQ(ErrorOfOptions({"--quiet", "--verbose"}), "--quiet and --verbose exclude each other");
  EXPECT_EQ(ErrorOfOptions({"--check", "--explain"}), "--check and --explain exclude each other");
  const std::string regions = "--cropwindow, --pixelbounds and --pixel exclude each other";
  EXPECT_EQ(ErrorOfOptions({"--pixel", "1,1", "--pixelbounds", "0,2,0,2"}), regions);
  EXPECT_EQ(ErrorOfOptions({"--pixel", "1,1", "--cropwindow", "0,1,0,1"}), regions);
  EXPECT_EQ(ErrorOfOptions({"--pixelbounds", "0,2,0,2", "--cropwindow", "0,1,0,1"}), regions);
  const std::string halves = "--two-halves and --time-limit or --target-error exclude each other";
  EXPECT_EQ(ErrorOfOptions({"--two-halves", "--time-limit", "9"}), halves);
  EXPECT_EQ(ErrorOfOptions({"--two-halves", "--target-error", "9"}), halves);
  EXPECT_EQ(ErrorOfOptions({"-o", "x", "a", "b"}),
            "--outfile names one picture, but there are several scenes");
  EXPECT_EQ(ErrorOfOptions({"-", "-"}), "standard input (-) is named twice");
  EXPECT_EQ(ErrorOfOptions({"-o", "x", "a"}) + ErrorOfOptions({"-", "b"}), "");
}

TEST(RenderOption, RefusesValuesOutOfRange) {
  for (const Words& words :
       {Words{"--spp", "0"}, Words{"--spp", "1073741825"}, Words{"--nthreads", "-1"},
        Words{"--nthreads", "4097"}, Words{"--footprint-spp", "0"},
        Words{"--footprint-spp", "1073741825"}, Words{"--dialect", "v3"},
        Words{"--effects", "caustics=maybe"}, Words{"--limits", "memory=2"},
        Words{"--aov", "Colour"}, Words{"--unknown"}})
    EXPECT_NE(ErrorOfOptions(words), "") << words[0] << ' ' << words.back();
  for (const char* seed : {"-1", "1e3", "x", "18446744073709551616", "99999999999999999999"})
    EXPECT_EQ(
        ErrorOfOptions({"--seed", seed}),
        "--seed: " + std::string(seed) + " is not a whole number from 0 to 18446744073709551615");
  for (const char* error : {"0", "-1", "1e9", "nan"})
    EXPECT_TRUE(ErrorOfOptions({"--target-error", error})
                    .starts_with("--target-error takes a number above 0 and below 1e9, not "))
        << error;
  for (const char* size : {"99999999x2", "2x1000000", "0x2"})
    EXPECT_EQ(
        ErrorOfOptions({"--resolution", size}),
        "--resolution takes widths and heights from 1 to 999999, not \"" + std::string(size) + '"');
  EXPECT_EQ(ErrorOfOptions({"--spp", "1e3"}), "--spp: \"1e3\" is not a whole number");
  EXPECT_EQ(ErrorOfOptions({"--nthreads", "1.5"}), "--nthreads: \"1.5\" is not a whole number");
  for (const char* option : {"--target-error", "--frame-time", "--certify-share"})
    EXPECT_EQ(ErrorOfOptions({option, "5%"}), std::string(option) + ": 5% is not a number");
  EXPECT_EQ(ErrorOfOptions({"--spp", "1", "--spp", "2"}), "--spp is given more than once");
  EXPECT_EQ(Parse({"--nthreads", "0"}).threadCount, 0);
  EXPECT_EQ(Parse({"--spp", "1"}).load.samplesPerPixel, 1);
}

TEST(RenderOption, RefusesEmptyValues) {
  for (const char* option :
       {"--outfile", "--preview", "--stats-json", "--state", "--photons", "--aov", "--limits",
        "--display", "--plugin-dir", "--integrator", "--resolution", "--shard", "--set"})
    EXPECT_EQ(ErrorOfOptions({option, ""}), std::string(option) + ": the value is empty");
  EXPECT_EQ(ErrorOfOptions({"-o", ""}), "--outfile: the value is empty");
}

TEST(RenderOption, RefusesAnEffectThatIsGivenTwice) {
  EXPECT_TRUE(ErrorOfOptions({"--effects", "caustics=off,lens=on,caustics=on"})
                  .starts_with("--effects: \"caustics\" is given more than once"));
  EXPECT_EQ(ErrorOfOptions({"--effects", "all,caustics=off,lens=on"}), "");
}

TEST(Durations, AreInSecondsMinutesOrHours) {
  EXPECT_EQ(ParseDuration("--t", "90"), 90);
  EXPECT_EQ(ParseDuration("--t", "90s"), 90);
  EXPECT_EQ(ParseDuration("--t", "1.5m"), 90);
  EXPECT_EQ(ParseDuration("--t", "2h"), 7200);
  for (const char* text : {"", "0", "-1", "1d", "s", "1 s", "1e9", "300000h", "nan", "inf"})
    EXPECT_EQ(ErrorOf([&] { ParseDuration("--t", text); }),
              "--t takes a time such as 90, 90s, 2m or 1h, not \"" + std::string(text) + '"');
}

TEST(Limits, ReadSizesTimesAndCounts) {
  EXPECT_EQ(ParseLimits("memory=1M").memoryBytes, 1048576.);
  EXPECT_EQ(ParseLimits("memory=1.5G").memoryBytes, 1.5 * 1024 * 1024 * 1024);
  EXPECT_EQ(ParseLimits("memory=2T").memoryBytes, 2. * 1024 * 1024 * 1024 * 1024);
  EXPECT_EQ(ParseLimits("time=1h").seconds, 3600.);
  EXPECT_EQ(ParseLimits("includes=1").scene.includes, 1);
  EXPECT_EQ(ParseLimits("texturenodes=1").scene.textureNodes, 1);
  EXPECT_EQ(ParseLimits("").scene.includes, SceneLimits().includes);
  for (const char* text :
       {"memory", "memory=", "memory=1", "memory=.9M", "memory=1048576T", "memory=1k", "time=0",
        "includes=0", "includes=1.5", "texturenodes=-1", "texturenodes=1x", "other=1", "1"})
    EXPECT_NE(ErrorOf([&] { ParseLimits(text); }), "") << text;
  EXPECT_EQ(ErrorOf([&] { ParseLimits("memory=1k"); }),
            "--limits memory takes a size such as 500M or 2G, not \"1k\"");
  EXPECT_EQ(ErrorOf([&] { ParseLimits("includes=0"); }),
            "--limits includes takes a whole number above 0, not \"0\"");
  EXPECT_EQ(ErrorOf([&] { ParseLimits("other=1"); }),
            "--limits takes memory=SIZE, time=TIME, includes=N and texturenodes=N, for example "
            "memory=2G,time=60s, not \"other=1\"");
}

TEST(Regions, AreReadWithTheirOrder) {
  EXPECT_EQ(ParsePixelBounds("10,20,0,5"), (PixelBounds{10, 0, 20, 5}));
  EXPECT_EQ(ParsePixelBounds("+1, +2, 3, 4"), (PixelBounds{1, 3, 2, 4}));
  EXPECT_EQ(ParsePixel("0,0"), (PixelBounds{0, 0, 1, 1}));
  EXPECT_EQ(ParsePixel("1073741823,5").x1, 1 << 30);
  for (const char* text : {"1,1,0,5", "0,5,2,2", "5,1,0,5"})
    EXPECT_EQ(ErrorOf([&] { ParsePixelBounds(text); }),
              "--pixelbounds " + std::string(text) + " is empty or reversed");
  for (const char* text : {"", "1,2,3", "1,2,3,4,5", "1,2,3,4,", "1,2,3,x", "1,,2,3", "1.5,2,3,4"})
    EXPECT_EQ(ErrorOf([&] { ParsePixelBounds(text); }),
              "--pixelbounds takes x0,x1,y0,y1 in pixels, not \"" + std::string(text) + '"');
  for (const char* text : {"-1,0", "0,-1", "1073741824,0", "0,1073741824"})
    EXPECT_EQ(ErrorOf([&] { ParsePixel(text); }),
              "--pixel " + std::string(text) + " lies outside every picture");
  EXPECT_EQ(ErrorOf([&] { ParsePixel("1"); }), "--pixel takes x,y, not \"1\"");
  EXPECT_EQ(ErrorOf([&] { ParsePixel("1", "--at"); }), "--at takes x,y, not \"1\"");
  EXPECT_EQ(ErrorOf([&] { ParseCropWindow("0,1,0"); }),
            "--cropwindow takes x0,x1,y0,y1, not \"0,1,0\"");
  EXPECT_TRUE(ErrorOf([&] { ParseCropWindow("0,2,0,1"); }).starts_with("--cropwindow 0,2,0,1 "));
}

TEST(SetOption, RefusesWhatHasNoDirectiveOrParameter) {
  for (const char* text : {"", "a", "a.b", ".b=1", "a.=1", "a=1", "a=1.5", "=1"})
    EXPECT_EQ(ErrorOf([&] { ParseOverride(text); }),
              "--set takes Directive.parameter=value, not \"" + std::string(text) + '"');
  EXPECT_EQ(ParseOverride("a.b=").value, "");
}

TEST(AovOption, NamesWhatThereIs) {
  const std::string error = ErrorOf([] { ParseAovList("N,colour"); });
  EXPECT_EQ(error, "--aov: unknown AOV \"colour\"; AOVs are " + AllAovNames());
  EXPECT_TRUE(AllAovNames().ends_with(", cryptomatte (both crypto AOVs)"));
}

}  // namespace
}  // namespace exphoton::cli
