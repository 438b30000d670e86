// SPDX-License-Identifier: BSD-2-Clause
// These tests cover mistakes that newcomers make on the command line, and what the program prints
// for people: mistyped words, names of pictures, help, hints and messages about a render.
#include <algorithm>
#include <sstream>

#include "core/imaging/files/exr.h"
#include "core/imaging/files/png.h"
#include "tests/cli/program.h"

namespace exphoton {
namespace {

using Names = std::vector<std::string>;

class Newcomer : public ProgramTest {
 protected:
  Newcomer() { Write("scene.pbrt", SmallScene()); }

  static bool Has(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
  }
  // Runs the program on a pseudo terminal (script of util-linux), with an end of input after it.
  ProgramResult RunOnTerminal(const std::string& arguments) const {
    ProcessCommand command;
    command.words = {"script", "-qec", EXPHOTON_BINARY_DIR "/bin/exphoton " + arguments,
                     "/dev/null"};
    command.environment = {"TERM=xterm", "NO_COLOR=1"};
    command.folder = Path("");
    command.timeLimit = 60;
    return RunProcess(command);
  }
};

TEST_F(Newcomer, WithoutArgumentsATerminalGetsTheUsage) {
  const ProgramResult result = RunOnTerminal("");
  EXPECT_EQ(result.status, 1) << result.out;
  EXPECT_TRUE(Has(result.out, "no scene and no command is given")) << result.out;
  EXPECT_TRUE(Has(result.out, "exphoton explain SCENE")) << result.out;
  EXPECT_TRUE(Has(RunOnTerminal("--quick").out, "no scene is named"));
}

TEST_F(Newcomer, WithoutArgumentsANullInputGetsTheUsage) {
  ProcessCommand command;
  command.words = {"sh", "-c", EXPHOTON_BINARY_DIR "/bin/exphoton < /dev/null"};
  command.folder = Path("");
  const ProgramResult result = RunProcess(command);
  EXPECT_EQ(result.status, 1) << result.err;
  EXPECT_TRUE(Has(result.err, "no scene and no command is given")) << result.err;
  EXPECT_EQ(Run({}).status, 2) << "an empty pipe is an empty scene";
}

TEST_F(Newcomer, AMistypedCommandRendersNothing) {
  const ProgramResult result = Run({"explan", "scene.pbrt"});
  EXPECT_EQ(result.status, 3);
  EXPECT_TRUE(Has(result.err, "\"explan\": no such file")) << result.err;
  EXPECT_TRUE(Has(result.err, "did you mean \"explain\"?")) << result.err;
  EXPECT_EQ(Files(), Names{"scene.pbrt"});
}

TEST_F(Newcomer, HelpTakesTheNameOfACommand) {
  const ProgramResult merge = Run({"help", "merge"});
  EXPECT_EQ(merge.status, 0);
  EXPECT_EQ(merge.out, Run({"merge", "--help"}).out);
  EXPECT_EQ(Run({"help"}).out, Run({"--help"}).out);
  EXPECT_EQ(Run({"help", "help"}).out, Run({"--help"}).out);
  const ProgramResult wrong = Run({"help", "mrge"});
  EXPECT_EQ(wrong.status, 1);
  EXPECT_TRUE(Has(wrong.err, "there is no command \"mrge\"")) << wrong.err;
  EXPECT_TRUE(Has(wrong.err, "did you mean \"merge\"?")) << wrong.err;
  EXPECT_TRUE(Has(Run({"help", "nosuch"}).err, "exphoton --help lists the commands"));
  EXPECT_EQ(Run({"help", "merge", "info"}).status, 1);
}

TEST_F(Newcomer, AFolderOfPluginsThatIsNotThereIsAnError) {
  for (const Names& command : {Names{"scene.pbrt"}, {"plugins"}, {"merge", ".", "-o", "a.exr"}})
    for (const char* folder : {"nosuch", "scene.pbrt"}) {
      Names words = command;
      words.insert(words.end(), {"--plugin-dir", folder});
      const ProgramResult result = Run(words);
      EXPECT_EQ(result.status, 3) << command[0];
      EXPECT_TRUE(Has(result.err, "cannot look for plugins in \"" + std::string(folder) + '"'))
          << result.err;
    }
  EXPECT_EQ(Files(), Names{"scene.pbrt"});
}

TEST_F(Newcomer, AnUnreadableSceneStopsAllOthers) {
  const ProgramResult result = Run({"scene.pbrt", "scen.pbrt"});
  EXPECT_EQ(result.status, 3);
  EXPECT_TRUE(Has(result.err, "did you mean \"scene.pbrt\"?")) << result.err;
  const ProgramResult folder = Run({"scene.pbrt", "."});
  EXPECT_EQ(folder.status, 3);
  EXPECT_TRUE(Has(folder.err, "\".\": is a directory\n    hint: name a scene file in it"))
      << folder.err;
  EXPECT_EQ(Files(), Names{"scene.pbrt"});
}

TEST_F(Newcomer, TheEndingOfTheNameChoosesTheFormat) {
  EXPECT_EQ(Run({"scene.pbrt", "-o", "a.PNG"}).status, 0);
  EXPECT_EQ(Read("a.PNG").substr(1, 3), "PNG");
  EXPECT_EQ(Run({"scene.pbrt", "-o", "a.exr"}).status, 0);
  EXPECT_EQ(ReadExr(Path("a.exr")).Width(), 8);
  for (const Names& wrong : {Names{"-o", "a.jpg"},
                             {"-o", "a"},
                             {"--preview", "p.exr"},
                             {"--set", "Film.filename=a.tif"}}) {
    const ProgramResult result = Run({"scene.pbrt", wrong[0], wrong[1]});
    EXPECT_EQ(result.status, 1) << wrong[1];
    EXPECT_TRUE(Has(result.err, ".png")) << result.err;
  }
  EXPECT_EQ(Files(), (Names{"a.PNG", "a.exr", "scene.pbrt"}));
}

TEST_F(Newcomer, OfSeveralNamesSetForThePictureTheLastCounts) {
  EXPECT_EQ(
      Run({"scene.pbrt", "--set", "Film.filename=a.exr", "--set", "Film.filename=b.exr"}).status,
      0);
  EXPECT_EQ(Files(), (Names{"b.exr", "scene.pbrt"}));
  EXPECT_EQ(Run({"scene.pbrt", "--set", "Film.filename=b.exr", "-o", "c.exr"}).status, 0);
  EXPECT_EQ(Files(), (Names{"b.exr", "c.exr", "scene.pbrt"}));
}

TEST_F(Newcomer, ASceneThatNamesAPngGetsAnExr) {
  Write("scene.pbrt", SmallScene("Film \"image\" \"string filename\" \"room.png\" "
                                 "\"integer xresolution\" 4 \"integer yresolution\" 4"));
  const ProgramResult result = Run({"scene.pbrt"});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_TRUE(Has(result.err, "\"room.png\" becomes \"room.exr\"")) << result.err;
  EXPECT_EQ(Files(), (Names{"room.exr", "scene.pbrt"}));
}

TEST_F(Newcomer, APngHasNoLayersAndAnExrNoExposure) {
  EXPECT_EQ(Run({"scene.pbrt", "-o", "a.png", "--aov", "N"}).status, 1);
  EXPECT_EQ(Run({"scene.pbrt", "-o", "a.png", "--two-halves"}).status, 1);
  EXPECT_EQ(Run({"scene.pbrt", "-o", "a.png", "--float"}).status, 1);
  EXPECT_EQ(Run({"scene.pbrt", "-o", "a.exr", "--exposure", "1"}).status, 1);
  EXPECT_EQ(Run({"scene.pbrt", "-o", "a.png", "--exposure", "bright"}).status, 1);
  EXPECT_EQ(Files(), Names{"scene.pbrt"});
}

// The emission of a sphere that fills the view is the picture.
std::string Emitter(const std::string& radiance) {
  return "Film \"image\" \"integer xresolution\" 4 \"integer yresolution\" 4 \"string filename\" "
         "\"out.exr\"\nPixelFilter \"box\"\nCamera "
         "\"perspective\"\nWorldBegin\nReverseOrientation\n"
         "Material \"matte\" \"color Kd\" [0 0 0]\n"
         "AreaLightSource \"area\" \"color L\" [" +
         radiance + "]\nShape \"sphere\" \"float radius\" 2\nWorldEnd\n";
}

TEST_F(Newcomer, ExposureMultipliesAndTheFilmicCurveRollsOff) {
  Write("bright.pbrt", Emitter(".25 .25 .25"));
  const auto value = [&](const Names& options) {
    Names words{"bright.pbrt", "-o", "a.png", "--preview", "p.png"};
    words.insert(words.end(), options.begin(), options.end());
    EXPECT_EQ(Run(words).status, 0);
    EXPECT_EQ(Read("a.png"), Read("p.png"));
    return double(ReadPng(Path("a.png")).At(1, 1, 0));
  };
  EXPECT_NEAR(value({}), .25, .004);
  EXPECT_NEAR(value({"--exposure", "1"}), .5, .006);
  EXPECT_NEAR(value({"--exposure=-1"}), .125, .003);
  EXPECT_NEAR(value({"--exposure", "auto"}), .18, .004);
  // Narkowicz's curve at 0.25: .25 (2.51 * .25 + .03) / (.25 (2.43 * .25 + .59) + .14).
  EXPECT_NEAR(value({"--tone-curve", "filmic"}), .3742, .005);
}

TEST_F(Newcomer, AHintReportsClippedAndOfBlackPictures) {
  Write("bright.pbrt", Emitter("8 8 8"));
  const ProgramResult bright = Run({"bright.pbrt", "-o", "a.png"});
  EXPECT_TRUE(Has(bright.err, "100 % of the pixels of \"a.png\" are lost: 100 % clipped"))
      << bright.err;
  EXPECT_TRUE(Has(bright.err, "--exposure auto would choose -5.47")) << bright.err;
  Write("dark.pbrt", Emitter(".0001 .0001 .0001"));
  EXPECT_TRUE(Has(Run({"dark.pbrt", "-o", "a.png"}).err, "100 % black"));
  const ProgramResult chosen = Run({"dark.pbrt", "-o", "a.png", "--exposure", "auto"});
  EXPECT_TRUE(Has(chosen.err, "exposure of \"a.png\": 10.81")) << chosen.err;
  EXPECT_FALSE(Has(chosen.err, "are lost")) << chosen.err;
}

TEST_F(Newcomer, ConvertTakesOneLayer) {
  ASSERT_EQ(Run({"scene.pbrt", "--aov", "albedo,N,samples", "--float"}).status, 0);
  const Image whole = ReadExr(Path("out.exr"));
  for (const char* layer : {"albedo", "N", "samples"}) {
    ASSERT_EQ(Run({"convert", "out.exr", "l.exr", "--layer", layer, "--float"}).status, 0) << layer;
    const Image one = ReadExr(Path("l.exr"));
    EXPECT_EQ(one.ChannelCount(), 3);
    const std::string first = std::string(layer) + (layer[0] == 'a'   ? ".R"
                                                    : layer[0] == 'N' ? ".X"
                                                                      : ".count");
    EXPECT_EQ(one.At(4, 3, one.FindChannel("R")), whole.At(4, 3, whole.FindChannel(first)));
  }
  const ProgramResult wrong = Run({"convert", "out.exr", "l.png", "--layer", "Albdo"});
  EXPECT_EQ(wrong.status, 1);
  EXPECT_TRUE(Has(wrong.err, "did you mean \"albedo\"?")) << wrong.err;
  EXPECT_EQ(Run({"convert", "out.exr", "l.jpg"}).status, 1);
}

TEST_F(Newcomer, PluginsOfTheSceneCanBeReplaced) {
  Write("scene.pbrt", SmallScene("Sampler \"stratified\" \"integer xsamples\" 3 \"integer "
                                 "ysamples\" 3\nPixelFilter \"box\" \"float xwidth\" 2\n"));
  const ProgramResult result =
      Run({"explain", "scene.pbrt", "--sampler", "random", "--filter", "gaussian", "--camera",
           "orthographic", "--accelerator", "kdtree", "--resolution", "20x10"});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(result.err, "");
  for (const char* part :
       {"sampler       random", "samples       9 a pixel", "filter        gaussian",
        "camera        orthographic", "accelerator   kdtree", "picture       20 x 10"})
    EXPECT_TRUE(Has(result.out, part)) << part << "\n" << result.out;
  const ProgramResult wrong = Run({"scene.pbrt", "--sampler", "halten"});
  EXPECT_EQ(wrong.status, 1);
  EXPECT_TRUE(Has(wrong.err, "did you mean \"halton\"?")) << wrong.err;
  EXPECT_EQ(Run({"scene.pbrt", "--resolution", "20"}).status, 1);
}

TEST_F(Newcomer, ATypingMistakeGetsASuggestion) {
  for (const auto& [arguments, hint] : std::vector<std::pair<Names, std::string>>{
           {{"scene.pbrt", "--intergrator", "path"}, "--integrator"},
           {{"scene.pbrt", "--integrator", "pth"}, "path"},
           {{"scene.pbrt", "--aov", "Albdo"}, "albedo"},
           {{"scene.pbrt", "--dialect", "v3"}, "v1"},
           {{"scene.pbrt", "--set", "Sampelr.pixelsamples=1"}, "Sampler"},
           {{"scene.pbrt", "--set", "Sampler.pixelsampels=1"}, "pixelsamples"},
           {{"scene.pbrt", "--effects", "caustic=off"}, "caustics"},
           {{"plugins", "mate"}, "matte"},
           {{"study", "scene.pbrt", "--out", "s", "--clok", "cpu"}, "--clock"},
           {{"study", "scene.pbrt", "--plan", "--integrators", "path", "--vary", "maxdept=2"},
            "maxdepth"},
           {{"study", "scene.pbrt", "--plan", "--integrators", "path", "--vary", "pth:spp=2"},
            "path"},
           {{"study", "scene.pbrt", "--plan", "--vary", "Samplr.pixelsamples=2"}, "Sampler"}}) {
    const ProgramResult result = Run(arguments);
    EXPECT_NE(result.status, 0) << hint;
    EXPECT_TRUE(Has(result.err, "did you mean \"" + hint + "\"?")) << hint << "\n" << result.err;
  }
  EXPECT_EQ(Files(), Names{"scene.pbrt"});
}

TEST_F(Newcomer, AWrongValueNamesItsOption) {
  for (const auto& [arguments, message] : std::vector<std::pair<Names, std::string>>{
           {{"info", "scene.pbrt", "--photons-at", "4"}, "--photons-at takes x,y, not \"4\""},
           {{"study", "scene.pbrt", "--plan", "--crop", "0,1"}, "--crop takes x0,x1,y0,y1"},
           {{"compare", "a.exr", "b.exr", "--max-mean", "1%"}, "--max-mean: 1% is not a number"},
           {{"compare", "a.exr", "b.exr", "--max-mean", "-1"},
            "--max-mean: -1 is not a number of at least 0"},
           {{"compare", "a.exr", "b.exr", "--scale", "0"}, "--scale: 0 is not a number above 0"},
           {{"quote", "scene.pbrt", "--integrators", ","}, "--integrators names no integrator"},
           {{"study", "scene.pbrt", "--plan", "--make-reference", "pth"},
            "there is no integrator \"pth\""},
           {{"study", "scene.pbrt", "--plan", "--make-reference", "path maxdept=9"},
            "integrator \"path\" has no parameter \"maxdept\""}}) {
    const ProgramResult result = Run(arguments);
    EXPECT_NE(result.status, 0) << message;
    EXPECT_TRUE(Has(result.err, message)) << message << "\n" << result.err;
  }
  EXPECT_EQ(Files(), Names{"scene.pbrt"});
}

TEST_F(Newcomer, HelpNamesCommandsFirstAndFitsTheTerminal) {
  const std::string help = Run({"--help"}).out;
  EXPECT_LT(help.find("Commands"), help.find("Examples"));
  EXPECT_LT(help.find("Examples"), help.find("How much to render:"));
  EXPECT_EQ(Run({"help"}).out, help);
  for (const char* command : {"render", "plugins", "info", "convert", "import", "denoise",
                              "compare", "study", "report"}) {
    std::istringstream lines(Run({command, "--help"}).out);
    for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 80u) << line;
  }
  EXPECT_EQ(Run({"-V"}).out, Run({"--version"}).out);
}

TEST_F(Newcomer, PluginsSeparateBasicParameters) {
  const std::string text = Run({"plugins", "exphotonmap"}).out;
  const std::size_t further = text.find("Further parameters");
  ASSERT_NE(further, std::string::npos);
  for (const char* name :
       {"indirectphotons", "causticphotons", "nused", "finalgathersamples", "integer maxdepth"})
    EXPECT_LT(text.find(name), further) << name;
  for (const char* name : {"radiancereach", "kernel", "shortrays", "photonroulette"})
    EXPECT_GT(text.find(name), further) << name;
}

TEST_F(Newcomer, AShortRenderIsDescribedInTwoLines) {
  const ProgramResult result = Run({"scene.pbrt"});
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 2) << result.err;
  EXPECT_TRUE(result.err.starts_with("exphoton: note: effects: ")) << result.err;
  const std::string table = Run({"scene.pbrt", "--verbose"}).err;
  EXPECT_TRUE(Has(table, "\nmotion        off  nothing moves\n")) << table;
  const std::string shown = RunOnTerminal("scene.pbrt").out;
  EXPECT_FALSE(Has(shown, "Rendering: 0.")) << shown;  // a phase under a second leaves no line
}

// The default filter reaches 2 pixels beyond the picture: 4 samples in each of 68 x 52 pixels.
TEST_F(Newcomer, StatisticsHaveUnitsAndShares) {
  const ProgramResult result = Run({"scene.pbrt", "--stats", "--resolution", "64x48"});
  for (const char* part : {" s  100.0 %", " 14,144 ", "100.0 %", " MB  ", "per second"})
    EXPECT_TRUE(Has(result.out, part)) << part << "\n" << result.out;
  std::istringstream lines(result.out);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 80u) << line;
}

TEST_F(Newcomer, APlanSaysHowManyRendersAndHowLong) {
  const ProgramResult plan = Run({"study", "scene.pbrt", "--plan", "--integrators",
                                  "path,directlighting", "--vary", "spp=1,4", "--seeds", "3"});
  EXPECT_EQ(plan.status, 0) << plan.err;
  EXPECT_TRUE(Has(plan.out, "12 renders of 8 x 6 pixels (4 settings, 3 seeds each), about "))
      << plan.out;
  const ProgramResult timed =
      Run({"study", "scene.pbrt", "--plan", "--integrators", "path", "--budgets", "30s", "--seeds",
           "4", "--make-reference", "path", "--reference-time", "10m"});
  EXPECT_TRUE(Has(timed.out, "4 renders of 8 x 6 pixels (1 setting, 4 seeds), about 2 min"))
      << timed.out;
  EXPECT_TRUE(Has(timed.out, "about 12 min in all")) << timed.out;
  EXPECT_EQ(Files(), Names{"scene.pbrt"});
}

}  // namespace
}  // namespace exphoton
