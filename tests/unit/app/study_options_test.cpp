// SPDX-License-Identifier: BSD-2-Clause
// These tests check that every option of a study, from the command line or a study file, arrives in
// its field, and what a study passes on to its renders.
#include "core/app/study/study_options.h"

#include <gtest/gtest.h>

#include "core/app/study/study_scene.h"
#include "core/base/error.h"
#include "tests/support/process.h"

namespace exphoton::cli {
namespace {

using Arguments = std::vector<std::string>;

class StudyOptionsTest : public testing::Test {
 protected:
  StudyOptionsTest() {
    for (const char* name : {"s.pbrt", "a.exr", "b.exr"}) WriteFile(folder_.File(name), "text");
  }
  // Adds a scene, and a folder for the results.
  StudyOptions Parse(Arguments arguments) const {
    arguments.insert(arguments.end(), {folder_.File("s.pbrt"), "--out", "out"});
    return ParseStudyOptions(arguments);
  }
  std::string ErrorOf(const Arguments& arguments) const {
    try {
      Parse(arguments);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  }
  std::vector<std::string> SettingsOf(const StudyOptions& options) const {
    std::vector<std::string> texts;
    for (const study::Setting& s : options.plan.bases)
      texts.push_back(s.label + "/" + s.integrator + "/" + s.Text());
    return texts;
  }

  TestFolder folder_;
};

TEST_F(StudyOptionsTest, HaveTheDefaultsOfTheManual) {
  const StudyOptions options = Parse({});
  EXPECT_EQ(options.scene, folder_.File("s.pbrt"));
  EXPECT_EQ(options.folder, "out");
  EXPECT_EQ(options.seeds, 4);
  EXPECT_EQ(options.threads, 0);
  EXPECT_EQ(options.footprintSamples, 16);
  EXPECT_EQ(options.referenceSeconds, 1800);
  EXPECT_EQ(options.clock, "cpu");
  EXPECT_EQ(options.targets, (std::vector<double>{.1, .03, .01, .003}));
  EXPECT_TRUE(options.makesMaps);
  EXPECT_FALSE(options.isQuiet || options.onlyPlans || options.allowsScenePlugins);
  EXPECT_FALSE(options.certifies);
  EXPECT_EQ(SettingsOf(options),
            (Arguments{"exphotonmap/exphotonmap/as the scene says",
                       "photonmap/photonmap/as the scene says", "path/path/as the scene says"}));
  EXPECT_EQ(options.inputFiles, Arguments{folder_.File("s.pbrt")});
}

TEST_F(StudyOptionsTest, ArriveInTheirFields) {
  EXPECT_EQ(Parse({"--title", "room"}).title, "room");
  EXPECT_EQ(Parse({"--seeds", "1000"}).seeds, 1000);
  EXPECT_EQ(Parse({"--nthreads", "3"}).threads, 3);
  EXPECT_EQ(Parse({"--ncores", "4096"}).threads, 4096);
  EXPECT_EQ(Parse({"--footprint-spp", "5"}).footprintSamples, 5);
  EXPECT_EQ(Parse({"--clock", "wall"}).clock, "wall");
  EXPECT_EQ(Parse({"--targets", ".02,.5, .1"}).targets, (std::vector<double>{.5, .1, .02}));
  EXPECT_EQ(Parse({"--reference-time", "2m", "--make-reference", "path"}).referenceSeconds, 120);
  EXPECT_EQ(Parse({"--cropwindow", "0,.5,0,1"}).cropWindow, "0,.5,0,1");
  EXPECT_EQ(Parse({"--crop", "0,.5,0,1", "--crop", "0,1,0,1"}).crops,
            (Arguments{"0,.5,0,1", "0,1,0,1"}));
  EXPECT_EQ(Parse({"--resolution", "128x96", "--set", "Film.x=1"}).sets,
            (Arguments{"Film.x=1", "Film.xresolution=128", "Film.yresolution=96"}));
  EXPECT_EQ(Parse({"--plugin-dir", "p", "--plugin-dir", "q"}).pluginFolders, (Arguments{"p", "q"}));
  EXPECT_EQ(Parse({"--limits", "memory=2G"}).limits, "memory=2G");
  EXPECT_TRUE(Parse({"--allow-scene-plugins"}).allowsScenePlugins);
  EXPECT_FALSE(Parse({"--no-maps"}).makesMaps);
  EXPECT_TRUE(Parse({"--quiet"}).isQuiet);
  EXPECT_TRUE(Parse({"--plan"}).onlyPlans);
  EXPECT_TRUE(Parse({"--certify"}).certifies);
  EXPECT_EQ(Parse({"--budgets", "1,2m"}).plan.budgets, (std::vector<double>{60, 120}));
  EXPECT_EQ(Parse({"--vary", "spp=1,2"}).plan.varied.at(0).parameter, "spp");
  EXPECT_EQ(SettingsOf(Parse({"--integrators", "path,whitted", "--setting", "x: igi maxdepth=3"})),
            (Arguments{"path/path/as the scene says", "whitted/whitted/as the scene says",
                       "x/igi/maxdepth=3"}));
  const StudyOptions made = Parse({"--make-reference", "path spp=3"});
  EXPECT_EQ(made.makeReference, "path spp=3");
  const StudyOptions given =
      Parse({"--reference", folder_.File("a.exr"), "--reference", folder_.File("b.exr"),
             "--reference-scene", folder_.File("s.pbrt")});
  EXPECT_EQ(given.references, (Arguments{folder_.File("a.exr"), folder_.File("b.exr")}));
  EXPECT_EQ(given.referenceScene, folder_.File("s.pbrt"));
  EXPECT_EQ(given.inputFiles, (Arguments{folder_.File("s.pbrt"), folder_.File("a.exr"),
                                         folder_.File("b.exr"), folder_.File("s.pbrt")}));
}

TEST_F(StudyOptionsTest, RefuseWhatDoesNotFit) {
  for (const Arguments& arguments :
       {Arguments{"--seeds", "0"}, Arguments{"--seeds", "1001"}, Arguments{"--clock", "sun"},
        Arguments{"--resolution", "128"}, Arguments{"--resolution", "0x9"},
        Arguments{"--resolution", "9x"}, Arguments{"--resolution", "1234567x9"},
        Arguments{"--targets", "0"}, Arguments{"--targets", ".1x"}, Arguments{"--budgets", ","},
        Arguments{"--crop", "0,1,0,2"}, Arguments{"--cropwindow", "1,0,0,1"},
        Arguments{"--set", "x"}, Arguments{"--limits", "x"}, Arguments{"--vary", "spp"},
        Arguments{"--make-reference", "path x"}, Arguments{"--reference-time", "0"},
        Arguments{"--reference", "none.exr"}, Arguments{"--reference-scene", "none.pbrt"}})
    EXPECT_NE(ErrorOf(arguments), "") << arguments[0] << ' ' << arguments[1];
  const std::string a = folder_.File("a.exr");
  EXPECT_EQ(ErrorOf({"--reference", a, "--reference", a, "--reference", a}),
            "--reference: one picture, or two halves of it");
  EXPECT_EQ(ErrorOf({"--reference", a, "--make-reference", "path"}),
            "--reference and --make-reference exclude each other");
  EXPECT_EQ(ErrorOf({"--reference-time", "2m"}), "--reference-time needs --make-reference");
  EXPECT_EQ(ErrorOf({"--reference-time", "0", "--make-reference", "path"}),
            "--reference-time takes a time such as 90, 90s, 2m or 1h, not \"0\"");
  EXPECT_TRUE(ErrorOf({"--budgets", "1,0"}).starts_with("--budgets takes times above 0"));
  for (const char* option : {"--share-nodes", "--rounds=4", "--engine=slurm"})
    EXPECT_EQ(ErrorOf({option}), std::string(option).substr(0, std::string(option).find('=')) +
                                     " needs --tasks N, the number of jobs");
  EXPECT_EQ(ErrorOf({"--title", ""}), "--title: the value is empty");
  EXPECT_THROW(ParseStudyOptions({"--out", "out"}), Error);
  EXPECT_THROW(ParseStudyOptions({a}), Error);
  EXPECT_NO_THROW(ParseStudyOptions({a, "--plan"}));
}

TEST_F(StudyOptionsTest, ComeFromAStudyFileWithPathsOfItsFolder) {
  const std::string file = folder_.File("x.study");
  WriteFile(file,
            "# comment\n\n  scene s.pbrt \r\n\tseeds\t 7\nreference a.exr\nreference ./b.exr\n"
            "reference-scene s.pbrt\nno-maps\ntitle a room\nout " +
                folder_.File("results") + "\n");
  const StudyOptions options = ParseStudyOptions({file});
  EXPECT_EQ(options.scene, folder_.File("s.pbrt"));
  EXPECT_EQ(options.references, (Arguments{folder_.File("a.exr"), folder_.File("b.exr")}));
  EXPECT_EQ(options.referenceScene, folder_.File("s.pbrt"));
  EXPECT_EQ(options.seeds, 7);
  EXPECT_EQ(options.title, "a room");
  EXPECT_FALSE(options.makesMaps);
  EXPECT_EQ(options.folder, folder_.File("results"));
  EXPECT_EQ(options.inputFiles.front(), file);
  // The command line wins, before the file's name and behind it.
  EXPECT_EQ(ParseStudyOptions({"--seeds", "2", file}).seeds, 2);
  EXPECT_EQ(ParseStudyOptions({file, "--seeds", "3"}).seeds, 3);
}

TEST_F(StudyOptionsTest, OfTheCommandLineReplaceLinesOfAStudyFile) {
  const std::string file = folder_.File("x.study"), a = folder_.File("a.exr"),
                    b = folder_.File("b.exr");
  WriteFile(file, "scene s.pbrt\nout " + folder_.File("results") +
                      "\nreference a.exr\nreference a.exr\nintegrators path\nsetting igi\n"
                      "setting whitted\nvary spp=1\nvary path:spp=2\ncrop 0,1,0,1\nset Film.a=1\n");
  const StudyOptions all = ParseStudyOptions({file});
  EXPECT_EQ(all.references, (Arguments{a, a}));
  EXPECT_EQ(all.plan.bases.size(), 3u);
  EXPECT_EQ(all.plan.varied.size(), 2u);
  EXPECT_EQ(ParseStudyOptions({"--reference", b, file}).references, Arguments{b});
  EXPECT_EQ(ParseStudyOptions({file, "--reference=" + b, "--reference", a}).references,
            (Arguments{b, a}));
  EXPECT_EQ(SettingsOf(ParseStudyOptions({file, "--setting", "igi maxdepth=3"})),
            (Arguments{"path/path/as the scene says", "igi/igi/maxdepth=3"}));
  const StudyOptions varied = ParseStudyOptions({file, "--vary=maxdepth=3"});
  ASSERT_EQ(varied.plan.varied.size(), 1u);
  EXPECT_EQ(varied.plan.varied[0].parameter, "maxdepth");
  EXPECT_EQ(ParseStudyOptions({file, "--crop", "0,.5,0,1"}).crops, Arguments{"0,.5,0,1"});
  EXPECT_EQ(ParseStudyOptions({file, "--set", "Film.b=2"}).sets,
            (Arguments{"Film.a=1", "Film.b=2"}));
  // The time is for a reference that is made.
  WriteFile(file, "scene s.pbrt\nout " + folder_.File("results") +
                      "\nmake-reference path\nreference-time 2m\nshare-nodes\nrounds 4\n");
  EXPECT_EQ(ParseStudyOptions({file}).referenceSeconds, 120);
  EXPECT_EQ(ParseStudyOptions({file, "--reference", a}).references, Arguments{a});
  EXPECT_EQ(ParseStudyOptions({file, "--make-reference", "igi"}).referenceSeconds, 120);
  WriteFile(file, "scene s.pbrt\nout " + folder_.File("results") + "\nreference a.exr\n");
  // They exclude each other.
  const StudyOptions made = ParseStudyOptions({file, "--make-reference", "path"});
  EXPECT_EQ(made.makeReference, "path");
  EXPECT_EQ(made.references, Arguments());
}

TEST_F(StudyOptionsTest, RefuseInAStudyFileWhatOnlyTheUserMayChoose) {
  const std::string file = folder_.File("x.study");
  const auto error = [&](const std::string& line) {
    WriteFile(file, "seeds 2\n" + line + "\n");
    return ErrorOf({file});
  };
  for (const char* name : {"plugin-dir", "allow-scene-plugins", "limits", "tasks", "task", "from"})
    EXPECT_EQ(error(name), file + ":2: \"" + name + "\" can only be given on the command line");
  EXPECT_NE(error("tasks 4").find("\"tasks\" can only be given"), std::string::npos);
  EXPECT_EQ(error("--seeds 3"), file + ":2: options in a study file have no dashes");
  EXPECT_EQ(error("sed 3"), file + ":2: there is no option \"sed\"");
  EXPECT_NE(error("out /elsewhere").find("lies neither in the working folder"), std::string::npos);
  EXPECT_EQ(error("seeds 3"), "");
}

TEST_F(StudyOptionsTest, ArePassedOnToEveryRender) {
  StudyOptions options = Parse({});
  options.sets = {"Film.a=1"};
  options.cropWindow = "0,1,0,.5";
  options.pluginFolders = {"p"};
  options.allowsScenePlugins = true;
  options.footprintSamples = 5;
  options.threads = 6;
  const study::Setting setting{
      "x", "igi", {{"spp", "3"}, {"time", "0.5"}, {"maxdepth", "2"}, {"Sampler.b", "4"}}};
  EXPECT_EQ(RenderArguments(options, "scene", setting, 77),
            (Arguments{"render",
                       "scene",
                       "--integrator",
                       "igi",
                       "--set",
                       "Film.a=1",
                       "--spp",
                       "3",
                       "--time-limit",
                       "0.5s",
                       "--set",
                       "SurfaceIntegrator.maxdepth=2",
                       "--set",
                       "Sampler.b=4",
                       "--cropwindow",
                       "0,1,0,.5",
                       "--plugin-dir",
                       "p",
                       "--allow-scene-plugins",
                       "--footprint-spp",
                       "5",
                       "--nthreads",
                       "6",
                       "--seed",
                       "77",
                       "--float",
                       "--reproducible"}));
  EXPECT_EQ(CommandText({"render", "a b", "it's", "", "x=1,2"}),
            "exphoton render 'a b' 'it'\\''s' '' x=1,2");
}

TEST_F(StudyOptionsTest, MakeAPlanWhoseParametersTheIntegratorsHave) {
  StudyOptions options =
      Parse({"--integrators", "path,photonmap", "--vary", "indirectphotons=5,9"});
  std::vector<std::string> texts;
  for (const study::Setting& s : PlanSettings(options))
    texts.push_back(s.integrator + ' ' + s.Text());
  EXPECT_EQ(texts, (Arguments{"path as the scene says", "photonmap indirectphotons=5",
                              "photonmap indirectphotons=9"}));
  for (const char* wrong : {"path indirectphotons=5", "nosuch"}) {
    options = Parse({"--setting", wrong});
    EXPECT_THROW(PlanSettings(options), Error) << wrong;
  }
  options = Parse({"--setting", "path spp=2 time=1 Film.x=3"});
  EXPECT_EQ(PlanSettings(options).size(), 1u);
}

TEST_F(StudyOptionsTest, GiveCertificatesToRendersWithFinalGather) {
  const study::Setting photons{"x", "photonmap", {{"spp", "4"}}};
  StudyOptions options = Parse({});
  EXPECT_FALSE(HasCertificate(options, photons));
  const Arguments plain = RunArguments(options, photons, 3);
  const std::string file = folder_.File("x.study");
  WriteFile(file, "scene s.pbrt\nout " + folder_.File("results") + "\ncertify\n");
  options = ParseStudyOptions({file});
  Arguments certified = plain;
  certified[1] = folder_.File("s.pbrt");
  certified.push_back("--certify");
  EXPECT_EQ(RunArguments(options, photons, 3), certified);
  const auto with = [&](const study::Parameter& parameter) {
    study::Setting setting = photons;
    setting.parameters.push_back(parameter);
    return HasCertificate(options, setting);
  };
  EXPECT_TRUE(HasCertificate(options, {"x", "exphotonmap", {}}));
  EXPECT_FALSE(HasCertificate(options, {"x", "path", {}}));
  EXPECT_FALSE(with({"passes", "9"}));
  EXPECT_FALSE(with({"show", "causticphotons"}));
  EXPECT_FALSE(with({"finalgather", "false"}));
  EXPECT_FALSE(with({"SurfaceIntegrator.finalgather", "false"}));
  // A parameter of a setting replaces one of --set, which replaces one of the scene.
  options.sceneSets = {"SurfaceIntegrator.finalgather=false"};
  EXPECT_FALSE(HasCertificate(options, photons));
  EXPECT_THROW(RequireCertificates(options, {photons}), Error);
  EXPECT_TRUE(with({"finalgather", "true"}));
  options.sets = {"SurfaceIntegrator.finalgather=true"};
  EXPECT_TRUE(HasCertificate(options, photons));
  EXPECT_NO_THROW(RequireCertificates(options, {{"x", "path", {}}, photons}));
  EXPECT_FALSE(with({"finalgather", "false"}));
  EXPECT_EQ(ErrorOf({"--certify", "--photons", "a.expm", "--seeds", "1"}),
            "--certify excludes --photons");
  EXPECT_NE(ErrorOf({"--certify", "--predict", "--make-reference", "path"})
                .find("--certify excludes --predict"),
            std::string::npos);
}

TEST_F(StudyOptionsTest, QuotesNeedAReferenceAndWholePictures) {
  EXPECT_FALSE(Parse({}).predicts);
  EXPECT_TRUE(Parse({"--predict", "--make-reference", "path"}).predicts);
  EXPECT_TRUE(Parse({"--predict", "--reference", folder_.File("a.exr")}).predicts);
  EXPECT_NE(ErrorOf({"--predict"}).find("--predict needs a reference"), std::string::npos);
  const auto expectError = [&](Arguments arguments, const std::string& text) {
    arguments.insert(arguments.end(), {"--predict", "--make-reference", "path"});
    EXPECT_NE(ErrorOf(arguments).find(text), std::string::npos) << ErrorOf(arguments);
  };
  expectError({"--clock", "wall"}, "--predict needs --clock cpu");
  expectError({"--cropwindow", "0,1,0,.5"}, "--predict excludes --cropwindow");
  expectError({"--photons", "a.expm", "--seeds", "1"}, "--predict excludes --photons");
  expectError({"--tasks", "3"}, "--predict excludes --tasks");
  expectError({"--from", "out.tasks"}, "--predict excludes --tasks");
}

}  // namespace
}  // namespace exphoton::cli
