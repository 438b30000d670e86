// SPDX-License-Identifier: BSD-2-Clause
// These tests shoot photons into a file and render with them: the picture is the one of a render
// that shoots its own photons, and no other file is used.
#include <filesystem>

#include "tests/cli/program.h"

namespace exphoton {
namespace {

using Names = std::vector<std::string>;

class PhotonFile : public ProgramTest {
 protected:
  PhotonFile() { Write("scene.pbrt", Scene()); }

  // A matte ball and a glass ball in a box, 12 x 8 pixels. The camera moves with `eye`.
  static std::string Scene(const std::string& eye = "0 0 -3", const std::string& world = "") {
    return "LookAt " + eye + " 0 0 0 0 1 0\nCamera \"perspective\" \"float fov\" 50\n" +
           "Film \"image\" \"integer xresolution\" 12 \"integer yresolution\" 8\n"
           "Sampler \"random\" \"integer xsamples\" 1 \"integer ysamples\" 2\n"
           "SurfaceIntegrator \"exphotonmap\" \"integer indirectphotons\" 900 "
           "\"integer causticphotons\" 200 \"integer finalgathersamples\" 8\n"
           "WorldBegin\nLightSource \"point\" \"point from\" [ 0 1 -1 ]\n" +
           world +
           "ReverseOrientation Shape \"sphere\" \"float radius\" 4 ReverseOrientation\n"
           "Material \"glass\" Shape \"sphere\" \"float radius\" .5\n"
           "Material \"matte\" Translate 1 0 0 Shape \"sphere\" \"float radius\" .5\nWorldEnd\n";
  }
  void Shoot(const Names& more = {}) const {
    Names words{"photons", "scene.pbrt", "-o", "maps.expm"};
    words.insert(words.end(), more.begin(), more.end());
    const ProgramResult result = Run(words);
    EXPECT_EQ(result.status, 0) << result.err;
  }
  ProgramResult Render(const std::string& picture, const Names& more) const {
    Names words{"scene.pbrt", "--reproducible", "-o", picture};
    words.insert(words.end(), more.begin(), more.end());
    return Run(words);
  }
  // Renders with the file and without it, and compares the bytes.
  void ExpectSamePicture(const Names& more = {}) const {
    Names with = more;
    with.insert(with.end(), {"--photons", "maps.expm"});
    const ProgramResult own = Render("own.exr", more), read = Render("read.exr", with);
    EXPECT_EQ(own.status, 0) << own.err;
    EXPECT_EQ(read.status, 0) << read.err;
    EXPECT_TRUE(Read("own.exr") == Read("read.exr"));
  }
  void ExpectRefused(int status, const std::string& reason, const Names& more = {}) const {
    Names with = more;
    with.insert(with.end(), {"--photons", "maps.expm"});
    const ProgramResult result = Render("read.exr", with);
    EXPECT_EQ(result.status, status) << result.err;
    EXPECT_NE(result.err.find(reason), std::string::npos) << result.err;
    EXPECT_FALSE(Exists("read.exr"));
  }
};

TEST_F(PhotonFile, GivesThePictureOfARenderThatShoots) {
  Shoot({"--nthreads", "1"});
  ExpectSamePicture({"--nthreads", "1"});
  ExpectSamePicture({"--nthreads", "7"});
}

TEST_F(PhotonFile, HasTheSameBytesForAnyNumberOfThreads) {
  Shoot({"--nthreads", "1"});
  const std::string one = Read("maps.expm");
  Shoot({"--nthreads", "7"});
  EXPECT_TRUE(Read("maps.expm") == one);
}

TEST_F(PhotonFile, ServesOtherCamerasSizesSamplersAndGathers) {
  Shoot();
  Write("scene.pbrt", Scene("1 1 -2"));
  ExpectSamePicture();
  ExpectSamePicture({"--resolution", "9x7", "--spp", "3", "--sampler", "lowdiscrepancy"});
  ExpectSamePicture({"--set", "SurfaceIntegrator.finalgathersamples=5", "--set",
                     "SurfaceIntegrator.nused=20", "--set", "SurfaceIntegrator.radiancereach=.5"});
}

TEST_F(PhotonFile, IsMadeWithTheSeedAndTheSettingsOfThePhotons) {
  const Names more{"--seed", "5", "--set", "SurfaceIntegrator.indirectphotons=700"};
  Shoot(more);
  ExpectSamePicture(more);
  Remove("read.exr");
  ExpectRefused(1, "--seed is 5 there, 0 here");
  ExpectRefused(1, "indirectphotons is 700 there, 900 here", {"--seed", "5"});
}

TEST_F(PhotonFile, KeepsTheTimesOfMovingCaustics) {
  Write("scene.pbrt",
        "LookAt 0 2.5 -5.5  0 .7 0  0 1 0\nCamera \"perspective\" \"float fov\" 45\n"
        "Film \"image\" \"integer xresolution\" 12 \"integer yresolution\" 8\n"
        "SurfaceIntegrator \"exphotonmap\" \"integer indirectphotons\" 900 "
        "\"integer causticphotons\" 9000 \"integer finalgathersamples\" 8\n"
        "WorldBegin\nLightSource \"point\" \"point from\" [1.2 3.9 -.5] \"color I\" [9 9 9]\n"
        "Rotate -90 1 0 0 Shape \"disk\" \"float radius\" 9\n"
        "ActiveTransform EndTime Translate 1.5 0 0 ActiveTransform All Translate 0 0 .8 "
        "Material \"glass\" Shape \"sphere\" \"float radius\" .8\nWorldEnd\n");
  Shoot();
  ExpectSamePicture();
}

// Photons of a scene where only the camera moves are the same at all times.
TEST_F(PhotonFile, ServesAllTimesOfAMovingCamera) {
  const auto write = [&](const char* times) {
    std::string scene = Scene();
    const std::string camera = "Camera \"perspective\"";
    scene.replace(scene.find(camera), camera.size(),
                  "ActiveTransform EndTime Translate .2 0 0 ActiveTransform All " + camera +
                      " \"float shutteropen\" " + times);
    Write("scene.pbrt", scene);
  };
  const Names more{"--set", "SurfaceIntegrator.causticphotons=9000"};
  write("0 \"float shutterclose\" 1");
  Shoot(more);
  ExpectSamePicture(more);
  const std::string file = Read("maps.expm");
  write(".9 \"float shutterclose\" 1");
  ExpectSamePicture(more);
  Shoot(more);
  EXPECT_TRUE(Read("maps.expm") == file);
}

TEST_F(PhotonFile, OfAnotherWorldIsRefused) {
  Shoot();
  Write("scene.pbrt", Scene("0 0 -3", "Translate 0 .1 0 "));
  ExpectRefused(1, "the hash of the scene's world is ");
}

TEST_F(PhotonFile, OfAChangedTextureIsRefused) {
  const std::string world =
      "Texture \"t\" \"color\" \"imagemap\" \"string filename\" \"t.pfm\" Material \"matte\" "
      "\"texture Kd\" \"t\" Shape \"sphere\" ";
  const auto write = [&](float value) {
    Write("t.pfm", "Pf\n1 1\n-1\n" + std::string(reinterpret_cast<const char*>(&value), 4));
  };
  write(.5f);
  Write("scene.pbrt", Scene("0 0 -3", world));
  Shoot();
  ExpectSamePicture();
  Remove("read.exr");
  write(.25f);
  ExpectRefused(1, "t.pfm\" is ");
}

TEST_F(PhotonFile, ThatIsDamagedIsRefused) {
  Shoot();
  const std::string whole = Read("maps.expm");
  for (std::size_t tenth = 0; tenth < 10; ++tenth) {
    Write("maps.expm", whole.substr(0, whole.size() * tenth / 10));
    ExpectRefused(3, "damaged");
    std::string flipped = whole;
    flipped[(flipped.size() - 1) * tenth / 9] ^= 8;
    Write("maps.expm", flipped);
    ExpectRefused(3, "");
  }
  Write("maps.expm", "no photons at all");
  ExpectRefused(3, "it is no file of photons");
  Remove("maps.expm");
  ExpectRefused(3, "no such file");
}

TEST_F(PhotonFile, OfARenderIsRefused) {
  EXPECT_EQ(Run({"scene.pbrt", "--shard", "1/1", "-o", "parts/"}).status, 0);
  Write("maps.expm", Read("parts/part-1-of-1.state"));
  ExpectRefused(3, "it holds no photons");
}

TEST_F(PhotonFile, NeedsAnIntegratorThatKeepsPhotons) {
  Shoot();
  ExpectRefused(1, "\"path\" keeps no photons", {"--integrator", "path"});
  const ProgramResult result =
      Run({"photons", "scene.pbrt", "-o", "none.expm", "--integrator", "path"});
  EXPECT_EQ(result.status, 1);
  EXPECT_FALSE(Exists("none.expm"));
}

TEST_F(PhotonFile, ServesOnePass) {
  Shoot();
  ExpectRefused(1, "--photons excludes", {"--two-halves"});
  ExpectRefused(1, "--photons excludes", {"--certify"});
  ExpectRefused(1, "--photons excludes", {"--target-error", ".1"});
  ExpectRefused(1, "--photons excludes", {"--time-limit", "9s"});
}

TEST_F(PhotonFile, IsNotOverwritten) {
  Shoot();
  const std::string whole = Read("maps.expm");
  const ProgramResult result =
      Run({"scene.pbrt", "-o", "a.exr", "--photons", "maps.expm", "--stats-json", "maps.expm"});
  EXPECT_EQ(result.status, 3) << result.err;
  EXPECT_TRUE(Read("maps.expm") == whole);
}

TEST_F(PhotonFile, MayBeWithoutPhotons) {
  Write("scene.pbrt", "SurfaceIntegrator \"photonmap\" WorldBegin Shape \"sphere\" WorldEnd\n");
  Shoot();
  ExpectSamePicture({"--resolution", "4x3", "--spp", "1"});
}

// Each seed has a file of its own. The pictures are those of a study that shoots.
TEST_F(PhotonFile, ServesAStudy) {
  const Names study{"study",    "scene.pbrt", "--integrators", "exphotonmap,path",
                    "--vary",   "spp=1,2",    "--seeds",       "2",
                    "--no-maps"};
  const auto with = [&](Names words, const Names& more) {
    words.insert(words.end(), more.begin(), more.end());
    return words;
  };
  for (const char* seed : {"1", "2"})
    ASSERT_EQ(
        Run({"photons", "scene.pbrt", "--seed", seed, "-o", "maps" + std::string(seed) + ".expm"})
            .status,
        0);
  ASSERT_EQ(Run(with(study, {"--out", "own"})).status, 0);
  const ProgramResult read = Run(with(study, {"--out", "read", "--photons", "maps%d.expm"}));
  ASSERT_EQ(read.status, 0) << read.err;
  EXPECT_NE(read.out.find("Photons were read from maps%d.expm"), std::string::npos) << read.out;
  const std::string results = Read("read/results.json");
  EXPECT_NE(results.find("--photons maps2.expm"), std::string::npos);
  int pictures = 0;
  for (const auto& entry : std::filesystem::directory_iterator(Path("own/images"))) {
    if (entry.path().extension() != ".exr") continue;
    const std::string name = "/images/" + entry.path().filename().string();
    EXPECT_TRUE(Read("own" + name) == Read("read" + name)) << name;
    ++pictures;
  }
  EXPECT_EQ(pictures, 8);
}

TEST_F(PhotonFile, OfOneSeedCannotServeAStudyOfSeveral) {
  Shoot();
  const Names study{"study", "scene.pbrt", "--integrators", "exphotonmap", "--no-maps",
                    "--out", "out",        "--photons",     "maps.expm",   "--seeds"};
  const auto refused = [&](const std::string& seeds, const std::string& integrator) {
    Names words = study;
    words.push_back(seeds);
    words[3] = integrator;
    const ProgramResult result = Run(words);
    EXPECT_EQ(result.status, 1);
    EXPECT_FALSE(Exists("out"));
    return result.err;
  };
  EXPECT_NE(refused("2", "exphotonmap").find("a file for each seed"), std::string::npos);
  EXPECT_NE(refused("1", "path").find("keeps photons"), std::string::npos);
}

}  // namespace
}  // namespace exphoton
