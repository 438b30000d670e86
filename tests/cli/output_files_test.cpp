// SPDX-License-Identifier: BSD-2-Clause
// These tests check which files the program must not overwrite, and which properties of a replaced
// file it keeps.
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <filesystem>

#include "core/imaging/files/exr.h"
#include "tests/cli/program.h"

namespace exphoton {
namespace {

namespace fs = std::filesystem;
using Names = std::vector<std::string>;

class OutputFiles : public ProgramTest {
 protected:
  OutputFiles() {
    Write("inc.pbrt", "Shape \"disk\"\n");
    Write("scene.pbrt", SmallScene("", "Include \"inc.pbrt\""));
  }
  // Expects status 3 with these words before anything is rendered. Every file must be unchanged.
  void ExpectRefused(const Names& arguments, const Names& words) const {
    std::vector<std::pair<std::string, std::string>> before;
    for (const std::string& name : Files()) before.emplace_back(name, Read(name));
    const ProgramResult result = Run(arguments);
    EXPECT_EQ(result.status, 3) << arguments.back() << "\n" << result.err;
    for (const std::string& word : words)
      EXPECT_NE(result.err.find(word), std::string::npos) << word << "\n" << result.err;
    EXPECT_EQ(result.err.find("effects"), std::string::npos) << "rendering has begun";
    Names names;
    for (const auto& [name, text] : before) {
      EXPECT_EQ(Read(name), text) << name;
      names.push_back(name);
    }
    EXPECT_EQ(Files(), names);
  }
  void WritePicture(const std::string& name, const std::string& software) const {
    Image image(2, 2, {"R", "G", "B"});
    image.attributes["software"] = software;
    WriteExr(Path(name), image, false);
  }
};

TEST_F(OutputFiles, NoOutputReplacesAFileThatTheSceneReads) {
  ExpectRefused({"scene.pbrt", "-o", "inc.pbrt"}, {"\"inc.pbrt\"", "\"scene.pbrt\"", "-o FILE"});
  ExpectRefused({"scene.pbrt", "-o", "out.exr", "--preview", "scene.pbrt"}, {"--preview FILE.png"});
  ExpectRefused({"scene.pbrt", "-o", "out.exr", "--stats-json", "scene.pbrt"}, {"--stats-json"});
  ExpectRefused({"scene.pbrt", "-o", "out.exr", "--stats-json", "inc.pbrt"}, {"--stats-json"});
  ExpectRefused({"info", "--photons-at", "4,3", "--integrator", "exphotonmap", "--plot",
                 "scene.pbrt", "scene.pbrt"},
                {"--plot FILE.svg"});
}

TEST_F(OutputFiles, AFileIsRecognisedHoweverItIsSpelt) {
  fs::create_directory(Path("sub"));
  fs::create_symlink("..", Path("sub/up"));
  fs::create_symlink("inc.pbrt", Path("link.exr"));
  fs::create_symlink("link.exr", Path("link2.exr"));
  fs::create_hard_link(Path("inc.pbrt"), Path("hard.exr"));
  for (const std::string& name :
       {std::string("./inc.pbrt"), std::string("sub/../inc.pbrt"), std::string("sub/up/inc.pbrt"),
        Path("inc.pbrt"), std::string("link.exr"), std::string("link2.exr"),
        std::string("hard.exr")})
    ExpectRefused({"scene.pbrt", "-o", name}, {"\"" + name + "\"", "inc.pbrt\""});
}

TEST_F(OutputFiles, NoOutputReplacesMeshesOrSpectra) {
  Write("mesh.ply",
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
        "property float z\nelement face 1\nproperty list uchar int vertex_indices\n"
        "end_header\n0 0 5\n1 0 5\n0 1 5\n3 0 1 2\n");
  Write("light.spd", "400 1 700 1\n");
  Write("scene.pbrt", SmallScene("",
                                 "LightSource \"distant\" \"spectrum L\" \"light.spd\"\n"
                                 "Shape \"plymesh\" \"string filename\" \"mesh.ply\""));
  ExpectRefused({"scene.pbrt", "-o", "mesh.ply"}, {"mesh.ply"});
  ExpectRefused({"scene.pbrt", "-o", "./light.spd"}, {"light.spd"});
}

#ifndef EXPHOTON_STATIC_PLUGINS
// The test uses copies, so that a failure does not destroy the build.
TEST_F(OutputFiles, NoOutputReplacesPluginsOrTheProgram) {
  const fs::path build = EXPHOTON_BINARY_DIR;
  fs::create_directories(Path("mine/filters"));
  fs::copy(build / "plugins/filters/box.so", Path("mine/filters/box.so"));
  const std::string plugin = Read("mine/filters/box.so");
  const ProgramResult result =
      Run({"scene.pbrt", "--plugin-dir", "mine", "-o", "mine/filters/box.so"});
  EXPECT_EQ(result.status, 3) << result.err;
  EXPECT_NE(result.err.find("it is a plugin"), std::string::npos) << result.err;
  EXPECT_EQ(Read("mine/filters/box.so"), plugin);

  fs::create_directories(Path("copy/bin"));
  fs::copy(build / "bin/exphoton", Path("copy/bin/exphoton"));
  fs::copy(build / "lib", Path("copy/lib"), fs::copy_options::recursive);
  const std::string line = "cd '" + Path("") + "' && copy/bin/exphoton scene.pbrt --plugin-dir '" +
                           (build / "plugins").string() + "' -o copy/bin/exphoton 2>message";
  const std::string program = Read("copy/bin/exphoton");
  EXPECT_EQ(WEXITSTATUS(std::system(line.c_str())), 3) << Read("message");
  EXPECT_NE(Read("message").find("it is this program"), std::string::npos);
  EXPECT_TRUE(Read("copy/bin/exphoton") == program);
}
#endif

TEST_F(OutputFiles, TwoOutputsOfARunAreTwoFiles) {
  fs::create_symlink("one.exr", Path("link.exr"));
  for (const char* name : {"one.exr", "./one.exr", "link.exr"}) {
    ExpectRefused({"scene.pbrt", "-o", "one.exr", "--preview", name}, {"one.exr", "--preview"});
    ExpectRefused({"scene.pbrt", "-o", "one.exr", "--stats-json", name},
                  {"one.exr", "--stats", "this file is also the one for the picture"});
  }
  Write("other.pbrt", SmallScene());
  ExpectRefused({"scene.pbrt", "other.pbrt"}, {"\"scene.pbrt\"", "\"other.pbrt\"", "-o out.exr"});
  ExpectRefused({"scene.pbrt", "scene.pbrt"}, {"out.exr"});
  Write("two.pbrt", SmallScene() + SmallScene());
  ExpectRefused({"two.pbrt"}, {"out.exr"});
}

TEST_F(OutputFiles, OfOneSceneAreNotInputsOfALaterOne) {
  Write("inc.exr", "Shape \"disk\"\n");
  Write("reads.pbrt",
        "Film \"image\" \"string filename\" \"b.exr\" \"integer xresolution\" 4\n"
        "WorldBegin Include \"inc.exr\" LightSource \"point\" WorldEnd\n");
  Write("writes.pbrt",
        "Film \"image\" \"string filename\" \"inc.exr\"\nWorldBegin LightSource "
        "\"point\" WorldEnd\n");
  ExpectRefused({"writes.pbrt", "reads.pbrt"}, {"inc.exr", "writes.pbrt", "reads.pbrt"});
}

TEST_F(OutputFiles, ScenesFromPipesAreComparedToo) {
  Write("other.pbrt", SmallScene("Film \"image\" \"string filename\" \"other.exr\" \"integer "
                                 "xresolution\" 4 \"integer yresolution\" 4"));
  const ProgramResult both = Run({"-", "other.pbrt"}, SmallScene());
  EXPECT_EQ(both.status, 0) << both.err;
  EXPECT_TRUE(Exists("out.exr") && Exists("other.exr"));
  EXPECT_EQ(Run({"-", "other.pbrt"}, Read("other.pbrt")).status, 3);
  const std::string line = "cd '" + Path("") + "' && '" + EXPHOTON_BINARY_DIR +
                           "/bin/exphoton' --quiet -o scene.pbrt < scene.pbrt 2>message";
  EXPECT_EQ(WEXITSTATUS(std::system(line.c_str())), 3);
  EXPECT_EQ(Read("scene.pbrt"), SmallScene("", "Include \"inc.pbrt\""));
}

TEST_F(OutputFiles, ConvertAndCompareReplaceNoneOfTheirPictures) {
  WritePicture("a.exr", "test");
  fs::create_directories(Path("x"));
  WritePicture("x/b.exr", "test");
  WritePicture("b.exr", "test");
  ExpectRefused({"convert", "a.exr", "./a.exr"}, {"a.exr"});
  fs::copy_file(Path("a.exr"), Path("b-difference.exr"));
  const std::string before = Read("b-difference.exr");
  EXPECT_EQ(Run({"compare", "b-difference.exr", "b.exr", "--difference", "."}).status, 2);
  EXPECT_EQ(Run({"compare", "a.exr", "b.exr", "x/b.exr", "--difference", "d"}).status, 2);
  EXPECT_EQ(Read("b-difference.exr"), before);
}

TEST_F(OutputFiles, ReferencePagesReplaceOnlyReferencePages) {
  Write("README.md", "my notes\n");
  ExpectRefused({"plugins", "--write-reference", "."}, {"README.md"});
  unlink(Path("README.md").c_str());
  EXPECT_EQ(Run({"plugins", "--write-reference", "."}).status, 0);
  EXPECT_EQ(Run({"plugins", "--write-reference", "."}).status, 0);
}

TEST_F(OutputFiles, StatisticsOfSeveralScenesAreAllThere) {
  const auto film = [](const char* name) {
    return std::string(
               "Film \"image\" \"integer xresolution\" 4 \"integer yresolution\" 4 "
               "\"string filename\" \"") +
           name + "\"";
  };
  Write("a.pbrt", SmallScene(film("a.exr")) + SmallScene(film("b.exr")));
  Write("c.pbrt", SmallScene(film("c.exr")));
  Write("s.json", "older");
  ASSERT_EQ(Run({"a.pbrt", "c.pbrt", "--stats-json", "s.json"}).status, 0);
  const std::string json = Read("s.json");
  EXPECT_EQ(std::count(json.begin(), json.end(), '\n'), 3) << json;
  EXPECT_EQ(json.find("older"), std::string::npos);
  EXPECT_NE(json.find("{\"scene\":\"a.pbrt\""), std::string::npos);
  EXPECT_NE(json.find("{\"scene\":\"c.pbrt\""), std::string::npos);
}

TEST_F(OutputFiles, HardLinksAreReplacedWithAWarning) {
  WritePicture("out.exr", "exphoton 0");
  fs::create_hard_link(Path("out.exr"), Path("kept.exr"));
  const std::string older = Read("kept.exr");
  const ProgramResult result = Run({"scene.pbrt", "--quiet"});
  EXPECT_EQ(result.status, 0);
  EXPECT_NE(result.err.find("\"out.exr\" has 2 names"), std::string::npos) << result.err;
  EXPECT_EQ(Read("kept.exr"), older);
  EXPECT_EQ(ReadExr(Path("out.exr")).Width(), 8);
}

TEST_F(OutputFiles, AnInterruptedPictureReplacesNothingOfTheUsers) {
  // With the box filter, all pixels that are rendered belong to the picture.
  Write("scene.pbrt", SmallScene("PixelFilter \"box\""));
  Write("out.partial.exr", "my file");
  const pid_t process = Start({"scene.pbrt", "--nthreads", "1", "--spp", "100000000"});
  ASSERT_TRUE(WaitForMessage("effects"));
  usleep(700000);
  kill(process, SIGTERM);
  EXPECT_EQ(Wait(process).status, 128 + SIGTERM);
  EXPECT_EQ(Read("out.partial.exr"), "my file");
  EXPECT_EQ(ReadExr(Path("out.partial-2.exr")).Width(), 8);
}

// The photons take long enough for the signal to come before the first pixel. If they take longer
// than half a second, the program ends during them.
TEST_F(OutputFiles, AStopBeforeTheFirstPixelKeepsAnEarlierPartialPicture) {
  Write("scene.pbrt",
        SmallScene("SurfaceIntegrator \"exphotonmap\" \"integer indirectphotons\" 60000",
                   "Shape \"sphere\" \"float radius\" 50"));
  WritePicture("out.partial.exr", "exphoton 0");
  Write("out.exr.state", "my file");
  const std::string older = Read("out.partial.exr");
  const Names files = Files();
  for (const Names& more : {Names{"--spp", "100000"}, Names{"--two-halves", "--spp", "100000"},
                            Names{"--target-error", "1e-9"}, Names{"--certify", "--spp", "100000"},
                            Names{"--stats-json", "s.json", "--spp", "100000"}}) {
    Names words{"scene.pbrt", "--nthreads", "1"};
    words.insert(words.end(), more.begin(), more.end());
    const pid_t process = Start(words);
    ASSERT_TRUE(WaitForMessage("effects"));
    kill(process, SIGTERM);
    const ProgramResult result = Wait(process);
    EXPECT_EQ(result.status, 128 + SIGTERM);
    ExpectIn("interrupted before ", result.err);
    ExpectNotIn("wrote what is finished", result.err);
    EXPECT_EQ(Files(), files);
    EXPECT_EQ(Read("out.partial.exr"), older);
    EXPECT_EQ(Read("out.exr.state"), "my file");
  }
}

// The command nohup also ignores SIGHUP in this way.
TEST_F(OutputFiles, AHangupThatIsIgnoredStaysIgnored) {
  const std::string program = std::string(EXPHOTON_BINARY_DIR) + "/bin/exphoton";
  const std::string line = "cd '" + Path("") + "' && (trap '' HUP; exec '" + program +
                           "' scene.pbrt --quiet --spp 20000) & sleep 0.3; kill -HUP $!; wait $!";
  EXPECT_EQ(WEXITSTATUS(std::system(line.c_str())), 0);
  EXPECT_TRUE(Exists("out.exr"));
}

// Each render runs in a separate PID namespace, so all renders have the same process id.
TEST_F(OutputFiles, TwentyRendersToOneNameInContainersAllSucceed) {
  if (std::system("unshare --pid --fork true 2>/dev/null") != 0)
    GTEST_SKIP() << "the kernel makes no new PID namespace here";
  const std::string program = std::string(EXPHOTON_BINARY_DIR) + "/bin/exphoton";
  const std::string line =
      "cd '" + Path("") + "' && pids=; for i in $(seq 20); do unshare --pid --fork '" + program +
      "' scene.pbrt --quiet --reproducible --nthreads 1 --seed $i & pids=\"$pids $!\"; done; "
      "for p in $pids; do wait $p || exit 1; done";
  ASSERT_EQ(std::system(line.c_str()), 0);
  EXPECT_EQ(Files(), (Names{"inc.pbrt", "out.exr", "scene.pbrt"}));
  const std::string picture = Read("out.exr");
  bool isOne = false;
  for (int seed = 1; seed <= 20 && !isOne; ++seed) {
    ASSERT_EQ(Run({"scene.pbrt", "--quiet", "--reproducible", "--nthreads", "1", "--seed",
                   std::to_string(seed), "-o", "again.exr"})
                  .status,
              0);
    isOne = Read("again.exr") == picture;
  }
  EXPECT_TRUE(isOne) << "the file is none of the pictures";
}

}  // namespace
}  // namespace exphoton
