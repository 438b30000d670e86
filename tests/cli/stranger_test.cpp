// SPDX-License-Identifier: BSD-2-Clause
// These tests run scene and study files from an untrusted source. Such files must run no code,
// replace no file of the user, wait for nothing, and reveal no content of other files.
#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>

#include "core/imaging/files/exr.h"
#include "tests/cli/program.h"

namespace exphoton {
namespace {

namespace fs = std::filesystem;
using Names = std::vector<std::string>;

class Stranger : public ProgramTest {
 protected:
  static std::string Film(const std::string& name) {
    return SmallScene(
        "Film \"image\" \"integer xresolution\" 4 \"integer yresolution\" 4 "
        "\"string filename\" \"" +
        name + "\"");
  }
  void WritePicture(const std::string& name, const std::string& software) const {
    Image image(2, 2, {"R", "G", "B"});
    image.attributes["software"] = software;
    WriteExr(Path(name), image, false);
  }
};

TEST_F(Stranger, ASceneMayAddAFileOrReplaceAPictureOfThisProgram) {
  Write("scene.pbrt", Film("new.exr"));
  EXPECT_EQ(Run({"scene.pbrt"}).status, 0);
  EXPECT_EQ(ReadExr(Path("new.exr")).Width(), 4);
  EXPECT_EQ(Run({"scene.pbrt"}).status, 0);  // replaces the scene's own picture
}

TEST_F(Stranger, ASceneReplacesNoOtherFile) {
  Write("notes.txt", "my notes");
  WritePicture("photo.exr", "a camera");
  for (const char* name : {"photo.exr"}) {
    const std::string before = Read(name);
    Write("scene.pbrt", Film(name));
    const ProgramResult result = Run({"scene.pbrt", "--spp", "4"});
    EXPECT_EQ(result.status, 3);
    EXPECT_EQ(Read(name), before);
    EXPECT_EQ(result.err.find("effects"), std::string::npos) << "rendering has begun";
    EXPECT_NE(result.err.find(std::string("scene.pbrt --spp 4 -o ") + name + "\n"),
              std::string::npos)
        << result.err;
    // The user's explicit option may replace the file.
    EXPECT_EQ(Run({"scene.pbrt", "-o", name}).status, 0);
  }
  Write("scene.pbrt", Film("notes.txt"));
  EXPECT_EQ(Run({"scene.pbrt"}).status, 0);
  EXPECT_EQ(Read("notes.txt"), "my notes");
  EXPECT_TRUE(Exists("notes.txt.exr"));
  EXPECT_EQ(Run({"scene.pbrt", "-o", "notes.txt"}).status, 1);
  EXPECT_EQ(Run({"scene.pbrt", "--set", "Film.filename=notes.txt"}).status, 1);
  EXPECT_EQ(Read("notes.txt"), "my notes");
}

TEST_F(Stranger, ASceneWritesNearItselfOrTheWorkingFolderOnly) {
  fs::create_directories(Path("work/deep"));
  fs::create_directories(Path("scenes/pictures"));
  fs::create_directories(Path("private"));
  fs::create_symlink("../private", Path("work/away"));
  fs::create_symlink("../private/new.exr", Path("work/link.exr"));
  const std::string inWork = "cd '" + Path("work") + "' && '" + EXPHOTON_BINARY_DIR +
                             "/bin/exphoton' ../scenes/a.pbrt --quiet 2>../message";
  const auto status = [&](const std::string& name) {
    Write("scenes/a.pbrt", Film(name));
    return WEXITSTATUS(std::system(inWork.c_str()));
  };
  EXPECT_EQ(status("here.exr"), 0);
  EXPECT_EQ(status("deep/here.exr"), 0);
  EXPECT_EQ(status("../scenes/pictures/there.exr"), 0);
  EXPECT_EQ(status(Path("scenes/absolute.exr")), 0);
  for (const std::string& name :
       {std::string("../private/new.exr"), Path("private/new.exr"), std::string("away/new.exr"),
        std::string("link.exr"), std::string("deep/../../private/new.exr")}) {
    EXPECT_EQ(status(name), 3) << name;
    EXPECT_NE(Read("message").find("-o " + name), std::string::npos) << Read("message");
  }
  EXPECT_TRUE(fs::is_empty(Path("private")));
}

TEST_F(Stranger, AStudyFileChoosesNoFolderElsewhere) {
  fs::create_directories(Path("work"));
  fs::create_directories(Path("private"));
  Write("work/box.pbrt", SmallScene());
  Write("work/a.study", "scene box.pbrt\nintegrators path\nseeds 1\nno-maps\nout ../private/new\n");
  const std::string line = "cd '" + Path("work") + "' && '" + EXPHOTON_BINARY_DIR +
                           "/bin/exphoton' study a.study 2>../message >../out";
  EXPECT_EQ(WEXITSTATUS(std::system(line.c_str())), 3);
  EXPECT_NE(Read("message").find("exphoton study a.study --out ../private/new"), std::string::npos)
      << Read("message");
  EXPECT_TRUE(fs::is_empty(Path("private")));
  for (const char* option : {"plugin-dir ../private", "allow-scene-plugins", "limits memory=1T"}) {
    Write("work/a.study", std::string("scene box.pbrt\n") + option + "\n");
    EXPECT_EQ(WEXITSTATUS(std::system(line.c_str())), 3) << option;
    EXPECT_NE(Read("message").find("a.study:2: "), std::string::npos) << Read("message");
  }
}

#ifndef EXPHOTON_STATIC_PLUGINS
class StrangersPlugins : public Stranger {
 protected:
  StrangersPlugins() {
    setenv("EXPHOTON_TEST_MARK", Path("mark").c_str(), 1);
    const std::string faulty = EXPHOTON_BINARY_DIR "/faulty_plugins/filters/";
    fs::create_directories(Path("theirs/filters"));
    for (const char* name : {"marking_filter", "marking_library"})
      fs::copy_file(faulty + name + ".so", Path(std::string("theirs/filters/") + name + ".so"));
    fs::permissions(Path("theirs/filters/marking_filter.so"), fs::perms(0644));
    Write("scene.pbrt",
          SmallScene("SearchPath \"" + Path("theirs") + ":&\"\nPixelFilter \"marking_filter\""));
  }
  ~StrangersPlugins() override { unsetenv("EXPHOTON_TEST_MARK"); }
};

TEST_F(StrangersPlugins, AreNotLoadedFromAFolderThatASceneNames) {
  for (const Names& arguments :
       {Names{"scene.pbrt"}, Names{"--check", "scene.pbrt"}, Names{"explain", "scene.pbrt"},
        Names{"info", "--photons-at", "1,1", "scene.pbrt"},
        Names{"study", "scene.pbrt", "--out", "out"}}) {
    const ProgramResult result = Run(arguments);
    EXPECT_EQ(result.status, 2) << result.err;
    EXPECT_FALSE(Exists("mark")) << arguments[0] << " has run the scene's code";
    EXPECT_NE(result.err.find("--allow-scene-plugins"), std::string::npos) << result.err;
  }
}

TEST_F(StrangersPlugins, AreLoadedWhereTheUserAllowsIt) {
  EXPECT_EQ(Run({"scene.pbrt", "--allow-scene-plugins", "-o", "a.exr"}).status, 0);
  EXPECT_TRUE(Exists("mark"));
  EXPECT_EQ(Run({"scene.pbrt", "--plugin-dir", Path("theirs"), "-o", "a.exr"}).status, 0);
  EXPECT_EQ(Run({"scene.pbrt", "--plugin-dir", ".", "-o", "a.exr"}).status, 0);
  fs::permissions(Path("theirs/filters/marking_filter.so"), fs::perms(0666));
  const ProgramResult writable = Run({"scene.pbrt", "--allow-scene-plugins", "-o", "a.exr"});
  EXPECT_EQ(writable.status, 2);
  EXPECT_NE(writable.err.find("can be changed by other users"), std::string::npos) << writable.err;
}

TEST_F(StrangersPlugins, ThatAreNoPluginsNeverRun) {
  Write("scene.pbrt",
        SmallScene("SearchPath \"" + Path("theirs") + "\"\nPixelFilter \"marking_library\""));
  EXPECT_EQ(Run({"scene.pbrt", "--allow-scene-plugins"}).status, 2);
  Write("scene.pbrt", SmallScene("PixelFilter \"nosuch\""));
  EXPECT_EQ(Run({"scene.pbrt", "--plugin-dir", Path("theirs")}).status, 2);
  // The error message lists the available filters. To make the list, the program may load plugins
  // from the user's folder, but no other library.
  unlink(Path("theirs/filters/marking_filter.so").c_str());
  unlink(Path("mark").c_str());
  EXPECT_EQ(Run({"scene.pbrt", "--plugin-dir", Path("theirs")}).status, 2);
  EXPECT_FALSE(Exists("mark"));
}
#endif

// The test uses the SearchPath lines with which the scenes of version 1 begin.
TEST_F(Stranger, ScenesOfVersion1WithASearchPathStillRender) {
  for (const char* path : {"../../plugins:&", "/usr/local/pbrt/bin:&:.", "&", "bin", ""}) {
    Write("scene.pbrt", std::string("SearchPath \"") + path + "\"\n" + SmallScene());
    const ProgramResult result = Run({"scene.pbrt"});
    EXPECT_EQ(result.status, 0) << path << "\n" << result.err;
  }
  Write("scene.pbrt", "SearchPath \"bin\"\n" + SmallScene());
  EXPECT_NE(Run({"scene.pbrt"}).err.find("\"bin\" is not searched for plugins"), std::string::npos);
  EXPECT_EQ(Run({"scene.pbrt", "--quiet"}).err, "");
}

TEST_F(Stranger, PipesAndDevicesInsideFilesAreRefusedAtOnce) {
  ASSERT_EQ(mkfifo(Path("pipe").c_str(), 0600), 0);
  for (const std::string name : {"pipe", "/dev/zero"}) {
    const std::string file = "\"string filename\" \"" + name + "\"";
    for (const std::string& world :
         {"Include \"" + name + "\"", "Texture \"t\" \"color\" \"imagemap\" " + file,
          "LightSource \"infinite\" \"string mapname\" \"" + name + "\"",
          "LightSource \"distant\" \"spectrum L\" \"" + name + "\"", "Shape \"plymesh\" " + file}) {
      Write("scene.pbrt", SmallScene("", world));
      const ProgramResult result = Run({"scene.pbrt"});
      EXPECT_EQ(result.status, 2) << world << result.err;
      EXPECT_NE(result.err.find("is not a regular file"), std::string::npos) << result.err;
      EXPECT_LT(result.seconds, 20);
    }
    for (const Names& arguments : {Names{"info", name}, Names{"convert", name, "a.png"}})
      EXPECT_EQ(Run(arguments).status, 3) << arguments[0];
    EXPECT_EQ(Run({"compare", name, name}).status, 2);
    Write("a.study", "scene " + name + "\n");
    EXPECT_EQ(Run({"study", "a.study", "--out", "out"}).status, 3);
  }
}

TEST_F(Stranger, ASceneOnTheCommandLineMayBeAPipe) {
  Write("scene.pbrt", SmallScene());
  const std::string line = "cd '" + Path("") + "' && mkfifo pipe && { cat scene.pbrt > pipe & '" +
                           EXPHOTON_BINARY_DIR + "/bin/exphoton' --quiet pipe; }";
  EXPECT_EQ(WEXITSTATUS(std::system(line.c_str())), 0);
  EXPECT_TRUE(Exists("out.exr"));
}

TEST_F(Stranger, AtMostOneLineOfAFileOfAnotherKindIsShown) {
  Write("secret", "first=Alpha\nsecond=Bravo\nthird=Charlie\nfourth=Delta\n");
  const auto shown = [](const std::string& text) {
    int count = 0;
    for (const char* word : {"Alpha", "Bravo", "Charlie", "Delta"})
      count += text.find(word) != std::string::npos;
    return count;
  };
  const std::string file = "\"string filename\" \"secret\"";
  for (const std::string& world :
       {std::string("Include \"secret\""), "Texture \"t\" \"color\" \"imagemap\" " + file,
        std::string("LightSource \"distant\" \"spectrum L\" \"secret\""),
        "Shape \"plymesh\" " + file}) {
    Write("scene.pbrt", SmallScene("", world));
    const ProgramResult result = Run({"scene.pbrt"});
    EXPECT_EQ(result.status, 2);
    EXPECT_LE(shown(result.out + result.err), 1) << result.err;
  }
  fs::copy_file(Path("secret"), Path("secret.study"));
  const ProgramResult study = Run({"study", "secret.study", "--out", "out"});
  EXPECT_EQ(study.status, 1);
  EXPECT_LE(shown(study.err), 1) << study.err;
  EXPECT_LE(shown(Run({"info", "secret"}).err), 1);
  fs::create_directory(Path("data"));
  fs::copy_file(Path("secret"), Path("data/results.json"));
  EXPECT_LE(shown(Run({"report", "data"}).err), 1);
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
TEST_F(Stranger, LimitsEndWhatCostsTooMuchMemory) {
  Write("scene.pbrt", SmallScene());
  const Names large{"scene.pbrt",
                    "--nthreads",
                    "1",
                    "--set",
                    "Film.xresolution=20000",
                    "--set",
                    "Film.yresolution=20000",
                    "--limits",
                    "memory=500M"};
  const ProgramResult result = Run(large);
  EXPECT_EQ(result.status, 4) << result.err;
  EXPECT_LT(result.megabytes, 600);
  EXPECT_EQ(Files(), Names{"scene.pbrt"});
  EXPECT_EQ(Run({"scene.pbrt", "--limits", "memory=500M", "--nthreads", "1"}).status, 0);
}
#endif

TEST_F(Stranger, LimitsEndWhatTakesTooLongToPrepare) {
  Write("scene.pbrt",
        SmallScene("SurfaceIntegrator \"exphotonmap\" \"integer indirectphotons\" 100000000",
                   "Shape \"sphere\" \"float radius\" 50"));
  const ProgramResult result = Run({"scene.pbrt", "--nthreads", "1", "--limits", "time=0.5"});
  EXPECT_EQ(result.status, 4) << result.err;
  EXPECT_NE(result.err.find("the time limit of --limits is exceeded"), std::string::npos)
      << result.err;
  EXPECT_LT(result.seconds, 20);
  EXPECT_EQ(Files(), Names{"scene.pbrt"});
  // The time limit applies to preparation only, not to rendering.
  Write("scene.pbrt", SmallScene());
  EXPECT_EQ(Run({"scene.pbrt", "--nthreads", "1", "--spp", "40000", "--limits", "time=0.5"}).status,
            0);
  for (const char* text : {"memory", "memory=2", "time=x", "colour=red", "memory=2G;time=3"})
    EXPECT_EQ(Run({"scene.pbrt", "--limits", text}).status, 1) << text;
}

}  // namespace
}  // namespace exphoton
