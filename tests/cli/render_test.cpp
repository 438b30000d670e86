// SPDX-License-Identifier: BSD-2-Clause
// These tests run the program as its users do. They check exit statuses, messages, and the files
// that the program leaves in the folder.
#include <signal.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <thread>

#include "core/app/options/app.h"
#include "core/imaging/files/exr.h"
#include "core/math/real.h"
#include "tests/cli/program.h"

namespace exphoton {
namespace {

using Names = std::vector<std::string>;

class RenderCommandTest : public ProgramTest {
 protected:
  // An error must leave no new file and must not change an older picture.
  void ExpectFailure(const ProgramResult& result, int status, const std::string& message) {
    EXPECT_EQ(result.status, status) << result.err;
    EXPECT_NE(result.err.find(message), std::string::npos) << result.err;
    EXPECT_EQ(result.out, "");
    EXPECT_EQ(Files(), (Names{"out.exr", "scene.pbrt"}));
    EXPECT_EQ(Read("out.exr"), "older picture");
  }
  ProgramResult RunText(const std::string& scene, std::vector<std::string> arguments = {}) {
    Write("out.exr", "older picture");
    Write("scene.pbrt", scene);
    arguments.push_back("scene.pbrt");
    // The option -o is the user's choice and may replace any file. A scene's own file name may only
    // replace a picture.
    const bool isNamed = std::find(arguments.begin(), arguments.end(), "-o") != arguments.end();
    if (!isNamed) arguments.insert(arguments.end(), {"-o", "out.exr"});
    return Run(arguments);
  }
};

TEST_F(RenderCommandTest, WritesThePictureAndNothingElse) {
  const ProgramResult result = RunText(SmallScene());
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(result.out, "");
  EXPECT_EQ(Files(), (Names{"out.exr", "scene.pbrt"}));
  const Image image = ReadExr(Path("out.exr"));
  EXPECT_EQ(image.Width(), 8);
  EXPECT_EQ(image.Height(), 6);
  EXPECT_NE(result.err.find("wrote \"out.exr\""), std::string::npos);
}

TEST_F(RenderCommandTest, SaysNothingWhenQuiet) {
  EXPECT_EQ(RunText(SmallScene(), {"--quiet"}).err, "");
}

TEST_F(RenderCommandTest, PutsAttributesIntoThePicture) {
  RunText(SmallScene(), {"--seed", "7", "--spp=2"});
  const auto attributes = ReadExr(Path("out.exr")).attributes;
  EXPECT_EQ(std::get<std::string>(attributes.at("integrator")), "directlighting");
  EXPECT_EQ(std::get<std::string>(attributes.at("seed")), "7");
  EXPECT_EQ(std::get<int>(attributes.at("samplesPerPixel")), 2);
  EXPECT_EQ(std::get<std::string>(attributes.at("scene")), "scene.pbrt");
  EXPECT_EQ(std::get<std::vector<float>>(attributes.at("worldToCamera")).size(), 16u);
  for (const char* name : {"software", "sceneHash", "effects", "commandLine", "time/parse",
                           "renderTimeSeconds", "capDate", "worldToNDC"})
    EXPECT_TRUE(attributes.contains(name)) << name;
}

TEST_F(RenderCommandTest, WritesEqualFilesWhenReproducible) {
  RunText(SmallScene(), {"--reproducible", "--nthreads", "1"});
  const std::string one = Read("out.exr");
  RunText(SmallScene(), {"--reproducible", "--nthreads", "3", "--no-progress"});
  EXPECT_EQ(one, Read("out.exr"));
  EXPECT_FALSE(ReadExr(Path("out.exr")).attributes.contains("commandLine"));
}

TEST_F(RenderCommandTest, CropsToTheSamePixels) {
  RunText(SmallScene(), {"--float"});
  const Image whole = ReadExr(Path("out.exr"));
  RunText(SmallScene(), {"--float", "--pixelbounds", "2,5,1,4", "--stats-json", "s.json"});
  EXPECT_NE(Read("s.json").find("\"pixelBounds\":[2,5,1,4]"), std::string::npos);
  const Image part = ReadExr(Path("out.exr"));
  EXPECT_EQ(part.data, (PixelBounds{2, 1, 5, 4}));
  EXPECT_EQ(part.display, whole.data);
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 3; ++x) EXPECT_EQ(part.At(x, y, 0), whole.At(x + 2, y + 1, 0));
  RunText(SmallScene(), {"--pixel", "3,3"});
  EXPECT_EQ(ReadExr(Path("out.exr")).data, (PixelBounds{3, 3, 4, 4}));
}

TEST_F(RenderCommandTest, ReadsStandardInput) {
  for (const Names& arguments : {Names{}, Names{"-"}, Names{"render"}, Names{"render", "-"}}) {
    const ProgramResult result = Run(arguments, SmallScene());
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_EQ(Files(), Names{"out.exr"});
    unlink(Path("out.exr").c_str());
  }
  EXPECT_EQ(Run({}, "WorldEnd").err,
            "<stdin>:1:1: error: WorldEnd without WorldBegin\n    WorldEnd\n    ^\n");
}

TEST_F(RenderCommandTest, RendersSeveralScenesOfOneFileAndOfSeveralFiles) {
  Write("a.pbrt", SmallScene() +
                      "Film \"image\" \"integer xresolution\" 4 \"integer yresolution\" "
                      "4 \"string filename\" \"second.exr\"\nAccelerator "
                      "\"bruteforce\"\nWorldBegin LightSource \"point\" WorldEnd\n");
  Write("b.pbrt", SmallScene("Film \"image\" \"integer xresolution\" 4 \"integer yresolution\" 4 "
                             "\"string filename\" \"third.exr\""));
  const ProgramResult result = Run({"a.pbrt", "b.pbrt"});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(Files(), (Names{"a.pbrt", "b.pbrt", "out.exr", "second.exr", "third.exr"}));
}

TEST_F(RenderCommandTest, GoesOnWithTheNextFileAfterAnError) {
  Write("bad.pbrt", "WorldEnd");
  Write("good.pbrt", SmallScene());
  EXPECT_EQ(Run({"bad.pbrt", "good.pbrt"}).status, 2);
  EXPECT_TRUE(Exists("out.exr"));
}

TEST_F(RenderCommandTest, RendersNothingOfAFileWithAnErrorAtItsEnd) {
  ExpectFailure(RunText(SmallScene() + "AttributeEnd\n"), 2,
                "scene.pbrt:10:1: error: AttributeEnd must be between WorldBegin and WorldEnd");
}

TEST_F(RenderCommandTest, CallsWrongUsageStatus1) {
  const std::string scene = SmallScene();
  for (const Names& arguments : {Names{"--nosuch"},
                                 Names{"--nthreads", "-1"},
                                 Names{"--nthreads", "100000"},
                                 Names{"--nthreads", "x"},
                                 Names{"--spp", "0"},
                                 Names{"--cropwindow", "0,1,0"},
                                 Names{"--cropwindow", "1,0,0,1"},
                                 Names{"--pixelbounds", "5,5,0,1"},
                                 Names{"--pixel", "100,100"},
                                 Names{"--pixel", "1"},
                                 Names{"--dialect", "v3"},
                                 Names{"--effects", "caustic=off"},
                                 Names{"--set", "Film.xresolution"},
                                 Names{"--set", "Film.nosuch=1"},
                                 Names{"--half", "--float"},
                                 Names{"--quiet", "--verbose"},
                                 Names{"--integrator", "nosuch"},
                                 Names{"-o", "x.exr", "other.pbrt"},
                                 Names{"--time-limit", "0"},
                                 Names{"--time-limit", "3x"},
                                 Names{"--target-error", "0"},
                                 Names{"--target-error", "-1"},
                                 Names{"--two-halves", "--time-limit", "3"},
                                 Names{"--aov", "albeido"},
                                 Names{"--aov", "N,"},
                                 Names{"--aov", "photonDensity"}}) {
    const ProgramResult result = RunText(scene, arguments);
    EXPECT_EQ(result.status, 1) << arguments[0] << "\n" << result.err;
    EXPECT_NE(result.err.find("error: "), std::string::npos) << result.err;
    EXPECT_EQ(Files(), (Names{"out.exr", "scene.pbrt"})) << arguments[0];
    EXPECT_EQ(Read("out.exr"), "older picture");
  }
}

TEST_F(RenderCommandTest, CallsAWrongSceneStatus2AndLeavesTheOlderPicture) {
  ExpectFailure(RunText(SmallScene("Translte 1 1 1")), 2,
                "scene.pbrt:4:1: error: unknown directive Translte\n    Translte 1 1 1\n    ^\n"
                "    hint: did you mean \"Translate\"?\n");
  ExpectFailure(RunText("Include \"none.pbrt\""), 2,
                "cannot read the included file \"none.pbrt\": no such file");
  ExpectFailure(RunText(SmallScene("SurfaceIntegrator \"pth\"")), 2,
                "scene.pbrt:4:1: error: there is no integrator \"pth\"");
  ExpectFailure(RunText(SmallScene("", "Material \"../matte\"")), 2, "error: ");
  ExpectFailure(RunText(SmallScene("", "Shape \"sphere\" \"float radius\" -1")), 2,
                "error: parameter \"radius\" of shape \"sphere\"");
  ExpectFailure(RunText(SmallScene("", "Shape \"sphere\" \"float radius\" [1 2]")), 2, "error: ");
  ExpectFailure(RunText(SmallScene("",
                                   "Material \"matte\" \"texture Kd\" \"nosuch\" Shape "
                                   "\"sphere\"")),
                2, "nosuch");
  ExpectFailure(RunText(SmallScene("",
                                   "Texture \"t\" \"color\" \"imagemap\" \"string filename\" "
                                   "\"none.exr\"")),
                2, "none.exr");
}

TEST_F(RenderCommandTest, NamesThePluginsThatExist) {
  const ProgramResult result = RunText(SmallScene("", "Shape \"spere\""));
  EXPECT_EQ(result.status, 2);
  for (const char* name : {"there is no shape \"spere\"", "cylinder", "disk", "sphere"})
    EXPECT_NE(result.err.find(name), std::string::npos) << result.err;
}

TEST_F(RenderCommandTest, WarnsOfMisspeltParametersAndRefusesThemWhenStrict) {
  const std::string scene = SmallScene("", "Shape \"sphere\" \"float radus\" 1");
  const char* hint =
      "unknown parameter \"radus\" of shape \"sphere\"\n"
      "    Shape \"sphere\" \"float radus\" 1\n"
      "                   ^\n    hint: did you mean \"radius\"?\n";
  ExpectFailure(RunText(scene, {"--strict"}), 2, std::string("scene.pbrt:7:16: error: ") + hint);
  const ProgramResult result = RunText(scene);
  EXPECT_EQ(result.status, 0);
  EXPECT_NE(result.err.find(std::string("scene.pbrt:7:16: warning: ") + hint), std::string::npos);
}

TEST_F(RenderCommandTest, CallsFilesThatCannotBeReadOrWrittenStatus3) {
  EXPECT_EQ(Run({"none.pbrt"}).err,
            "exphoton: error: cannot read the scene \"none.pbrt\": no such file\n");
  EXPECT_EQ(Run({"none.pbrt"}).status, 3);
  EXPECT_EQ(Run({"."}).status, 3);
  mkdir(Path("folder").c_str(), 0700);
  Write("scene.pbrt", SmallScene());
  for (const std::string output : {"nowhere/out.exr", "folder", "/dev/full", "scene.pbrt"}) {
    const ProgramResult result = Run({"scene.pbrt", "-o", output});
    EXPECT_EQ(result.status, 3) << output << result.err;
    EXPECT_NE(result.err.find("exphoton: error: cannot "), std::string::npos) << result.err;
    EXPECT_NE(result.err.find('"' + output + '"'), std::string::npos) << result.err;
    EXPECT_EQ(result.err.find("effects"), std::string::npos) << "rendering has begun";
  }
  EXPECT_EQ(Run({"scene.pbrt", "-o", std::string(300, 'x') + ".exr"}).status, 3);
  EXPECT_EQ(Run({"scene.pbrt", "--preview", "nowhere/x.png"}).status, 3);
  EXPECT_EQ(Run({"scene.pbrt", "--stats-json", "nowhere/x.json"}).status, 3);
  EXPECT_EQ(Files(), (Names{"folder", "scene.pbrt"}));
}

TEST_F(RenderCommandTest, DoesNotWriteOverATextureOfTheScene) {
  RunText(SmallScene());
  rename(Path("out.exr").c_str(), Path("map.exr").c_str());
  const std::string map = Read("map.exr");
  const ProgramResult result =
      RunText(SmallScene("", "LightSource \"infinite\" \"string mapname\" \"map.exr\""),
              {"-o", "./map.exr"});
  EXPECT_EQ(result.status, 3) << result.err;
  EXPECT_NE(result.err.find("reads this file as \"map.exr\""), std::string::npos) << result.err;
  EXPECT_EQ(Read("map.exr"), map);
}

TEST_F(RenderCommandTest, CallsAPictureTooLargeForMemoryStatus4) {
  const ProgramResult result = RunText(
      SmallScene(), {"--set", "Film.xresolution=16000000", "--set", "Film.yresolution=16000000"});
  ExpectFailure(result, 4, "exphoton: error: ");
}

TEST_F(RenderCommandTest, ChecksAndExplainsWithoutRendering) {
  const ProgramResult check = RunText(SmallScene(), {"--check"});
  EXPECT_EQ(check.status, 0);
  EXPECT_EQ(check.out, "");
  ExpectFailure(RunText("WorldEnd", {"--check"}), 2, "WorldEnd without WorldBegin");
  for (const Names& arguments : {Names{"--explain"}, Names{"explain"}}) {
    Write("out.exr", "older picture");
    Write("scene.pbrt", SmallScene());
    Names all = arguments;
    all.push_back("scene.pbrt");
    const ProgramResult result = Run(all);
    EXPECT_EQ(result.status, 0);
    for (const char* part : {"integrator    directlighting\n", "specular      off  no specular",
                             "lights        1\n", "plugins       ", "materials/matte"})
      EXPECT_NE(result.out.find(part), std::string::npos) << result.out;
    EXPECT_EQ(Read("out.exr"), "older picture");
  }
}

TEST_F(RenderCommandTest, ExplainsPhotonMapsAndTheirMemory) {
  Write("scene.pbrt", SmallScene("SurfaceIntegrator \"exphotonmap\" \"integer directphotons\" 5"));
  const std::string text = Run({"explain", "scene.pbrt"}).out;
  EXPECT_NE(text.find("photons       5 direct, 100000 indirect\n"), std::string::npos) << text;
  // The maps hold 100005 photons of 30 bytes, and an eighth as many radiance photons of 34 bytes.
  // The sum of 3.2 MiB is rounded up. In double it is 6.4 MiB.
  const std::string size = sizeof(Real) == 4 ? "4" : "7";
  EXPECT_NE(text.find("memory        about " + size + " MiB for the photon maps\n"),
            std::string::npos)
      << text;
}

TEST_F(RenderCommandTest, PrintsStatisticsOnlyWhenAsked) {
  const ProgramResult result = RunText(SmallScene(), {"--stats", "--stats-json", "s.json"});
  EXPECT_EQ(result.status, 0);
  for (const char* part : {"phase", "parse", "camera", "shadow"})
    EXPECT_NE(result.out.find(part), std::string::npos) << result.out;
  const std::string json = Read("s.json");
  EXPECT_EQ(json.substr(0, 23), "{\"scene\":\"scene.pbrt\",\"");
  // 4 samples in each of 12 x 10 pixels: the default filter reaches 2 pixels beyond the picture.
  EXPECT_NE(json.find("\"rays\":{\"camera\":480,"), std::string::npos) << json;
  EXPECT_EQ(std::count(json.begin(), json.end(), '\n'), 1);
}

TEST_F(RenderCommandTest, WritesAPreview) {
  EXPECT_EQ(RunText(SmallScene(), {"--preview", "p.png"}).status, 0);
  EXPECT_EQ(Read("p.png").substr(1, 3), "PNG");
}

TEST_F(RenderCommandTest, FollowsSymbolicLinks) {
  mkdir(Path("there").c_str(), 0700);
  Write("there/old.exr", "older");
  ASSERT_EQ(symlink("there/old.exr", Path("link.exr").c_str()), 0);
  Write("scene.pbrt", SmallScene());
  EXPECT_EQ(Run({"scene.pbrt", "-o", "link.exr"}).status, 0);
  EXPECT_EQ(ReadExr(Path("there/old.exr")).Width(), 8);
  ASSERT_EQ(symlink("gone/x.exr", Path("dangling.exr").c_str()), 0);
  EXPECT_EQ(Run({"scene.pbrt", "-o", "dangling.exr"}).status, 3);
}

TEST_F(RenderCommandTest, KeepsWhatIsFinishedWhenInterrupted) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    Write("out.exr", "older picture");
    Write("scene.pbrt", SmallScene("PixelFilter \"box\""));
    const pid_t process =
        Start({"scene.pbrt", "-o", "out.exr", "--nthreads", "1", "--spp", "100000000"});
    ASSERT_TRUE(WaitForMessage("effects"));  // this message is printed just before rendering
    std::this_thread::sleep_for(std::chrono::milliseconds(700));
    ASSERT_EQ(kill(process, signal), 0);
    const ProgramResult result = Wait(process);
    EXPECT_EQ(result.status, 128 + signal) << result.err;
    EXPECT_EQ(Files(), (Names{"out.exr", "out.partial.exr", "scene.pbrt"}));
    EXPECT_EQ(Read("out.exr"), "older picture");
    const Image image = ReadExr(Path("out.partial.exr"));
    EXPECT_EQ(image.Width(), 8);
    EXPECT_NE(result.err.find("wrote what is finished to \"out.partial.exr\""), std::string::npos);
    unlink(Path("out.partial.exr").c_str());
  }
}

TEST_F(RenderCommandTest, EndsAtOnceWhenInterruptedBeforeTheFirstPixel) {
  Write("scene.pbrt",
        SmallScene("SurfaceIntegrator \"exphotonmap\" \"integer indirectphotons\" 20000000",
                   "Shape \"sphere\" \"float radius\" 50"));
  const pid_t process = Start({"scene.pbrt", "--nthreads", "1"});
  ASSERT_TRUE(WaitForMessage("effects"));
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  ASSERT_EQ(kill(process, SIGTERM), 0);
  const auto start = std::chrono::steady_clock::now();
  const ProgramResult result = Wait(process);
  EXPECT_EQ(result.status, 143) << result.err;
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(4));
  EXPECT_NE(result.err.find("interrupted before anything was rendered"), std::string::npos);
  EXPECT_EQ(Files(), Names{"scene.pbrt"});
}

TEST_F(RenderCommandTest, RendersTheSameTwiceInOneProcess) {
  Write("scene.pbrt", SmallScene());
  Names pictures;
  for (const char* name : {"a.exr", "b.exr"}) {
    EXPECT_EQ(
        cli::RunProgram({"exphoton", Path("scene.pbrt"), "-o", Path(name), "--reproducible",
                         "--quiet", "--plugin-dir", std::string(EXPHOTON_BINARY_DIR) + "/plugins"}),
        0);
    pictures.push_back(Read(name));
  }
  EXPECT_EQ(pictures[0], pictures[1]);
  EXPECT_NE(pictures[0], "");
}

TEST_F(RenderCommandTest, RunsOnLittleStack) {
  Write("scene.pbrt", SmallScene());
  const std::string command = "cd '" + Path("") + "' && ulimit -s 256 && '" + EXPHOTON_BINARY_DIR +
                              "/bin/exphoton' scene.pbrt --quiet";
  EXPECT_EQ(std::system(command.c_str()), 0);
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
TEST_F(RenderCommandTest, SaysWhenMemoryIsNotEnough) {
  Write("scene.pbrt", SmallScene());
  const std::string command = "cd '" + Path("") + "' && ulimit -v 600000 && '" +
                              EXPHOTON_BINARY_DIR +
                              "/bin/exphoton' scene.pbrt --nthreads 1 --set Film.xresolution=20000 "
                              "--set Film.yresolution=20000 2>message";
  EXPECT_EQ(WEXITSTATUS(std::system(command.c_str())), 4);
  EXPECT_NE(Read("message").find("exphoton: error: "), std::string::npos) << Read("message");
  EXPECT_EQ(Files(), (Names{"message", "scene.pbrt"}));
}
#endif

TEST_F(RenderCommandTest, SaysThatItDidNotLookForPluginsInTheScenesSearchPath) {
  Write("scene.pbrt",
        "SearchPath \"nowhere:&\"\nSearchPath \"elsewhere\"\n" + SmallScene("", "Shape \"spere\""));
  const ProgramResult result = Run({"scene.pbrt"});
  EXPECT_EQ(result.status, 2);
  EXPECT_NE(result.err.find("sphere"), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("did not look in elsewhere, named by the scene: "
                            "--allow-scene-plugins"),
            std::string::npos)
      << result.err;
}

TEST_F(RenderCommandTest, EndsWithoutWaitingForAReaderThatIsGone) {
  Write("scene.pbrt", SmallScene());
  const std::string command = "cd '" + Path("") + "' && { '" + EXPHOTON_BINARY_DIR +
                              "/bin/exphoton' explain scene.pbrt 2>/dev/null; echo $? >status; } "
                              "| true";
  ASSERT_EQ(std::system(command.c_str()), 0);
  EXPECT_NE(Read("status"), "141\n");  // 0 or 3; 141 would be death by SIGPIPE
}

}  // namespace
}  // namespace exphoton
