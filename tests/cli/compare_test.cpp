// SPDX-License-Identifier: BSD-2-Clause
// `exphoton compare` gives verdicts: the limit that a picture breaks, and whether pictures differ
// by more than their noise. The rates of false alarms are tested in tests/unit/imaging.
#include "core/imaging/files/exr.h"
#include "core/imaging/files/png.h"
#include "tests/cli/program.h"

namespace exphoton {
namespace {

class CompareTest : public ProgramTest {
 protected:
  void WriteColor(const std::string& name, float r, float g, float b) const {
    Image image(3, 2, {"R", "G", "B"});
    for (int i = 0; i < 6; ++i) image.At(i % 3, i / 3, 0) = r;
    for (int i = 0; i < 6; ++i) image.At(i % 3, i / 3, 1) = g;
    for (int i = 0; i < 6; ++i) image.At(i % 3, i / 3, 2) = b;
    WriteExr(Path(name), image, false);
  }
  static std::string LastLine(const std::string& text) {
    const std::size_t end = text.find_last_of('\n');
    const std::size_t begin = text.find_last_of('\n', end - 1);
    return text.substr(begin + 1, end - begin - 1);
  }
  // A box that is lit through its own light, with walls of this green.
  void WriteRoom(const std::string& name, const std::string& green) const {
    Write(name,
          "Film \"image\" \"integer xresolution\" 48 \"integer yresolution\" 32 \"string "
          "filename\" \"out.exr\"\nSampler \"random\" \"integer pixelsamples\" 16\nPixelFilter "
          "\"gaussian\"\nCamera \"perspective\"\nSurfaceIntegrator \"path\"\nWorldBegin\n"
          "AttributeBegin Translate 0 2 3 AreaLightSource \"area\" \"color L\" [9 9 9]\n"
          "Shape \"sphere\" \"float radius\" .3 AttributeEnd\n"
          "Material \"matte\" \"color Kd\" [.6 " +
              green + " .6]\nReverseOrientation Shape \"sphere\" \"float radius\" 5\nWorldEnd\n");
  }
};

TEST_F(CompareTest, TheVerdictNamesTheLimitThatIsBroken) {
  WriteColor("a.exr", .5f, .5f, .5f);
  WriteColor("b.exr", .5f, .495f, .5f);
  const auto verdict = [&](const std::vector<std::string>& limits) {
    std::vector<std::string> words{"compare", "a.exr", "b.exr"};
    words.insert(words.end(), limits.begin(), limits.end());
    return LastLine(Run(words).out);
  };
  EXPECT_EQ(verdict({"--max-mean", ".005"}), "FAIL: mean of G -1 % > 0.5 %");
  EXPECT_EQ(verdict({"--max-mean", ".02"}), "PASS: within the limits");
  EXPECT_EQ(verdict({"--max-relmse", "1e-6"}), "FAIL: relMSE 3.21e-05 > 1e-06");
  EXPECT_EQ(LastLine(Run({"compare", "a.exr", "a.exr"}).out), "PASS: identical");
  EXPECT_EQ(verdict({}).substr(0, 19), "FAIL: not identical");
}

// The colours of an EXR are multiplied by alpha, and those of a PNG are not.
TEST_F(CompareTest, AnExrEqualsItsPngWhereAlphaIsPartial) {
  Image image(2, 1, {"R", "G", "B", "A"});
  image.pixels = {.25f, .1f, .2f, .5f, .5f, .2f, .4f, 1};
  WriteExr(Path("a.exr"), image, false);
  ASSERT_EQ(Run({"convert", "a.exr", "a.png"}).status, 0);
  EXPECT_EQ(Run({"compare", "a.exr", "a.png", "--max-mean", ".02"}).status, 0);
}

TEST_F(CompareTest, EveryPictureMustPass) {
  WriteColor("a.exr", .5f, .5f, .5f);
  WriteColor("b.exr", .5f, .4f, .5f);
  WriteColor("c.exr", .5f, .5f, .5f);
  EXPECT_EQ(Run({"compare", "a.exr", "c.exr", "a.exr"}).status, 0);
  EXPECT_EQ(Run({"compare", "a.exr", "b.exr", "c.exr"}).status, 1);
  EXPECT_EQ(Run({"compare", "a.exr", "c.exr", "b.exr"}).status, 1);
}

TEST_F(CompareTest, EachChannelHasADifferencePicture) {
  WriteColor("a.exr", .5f, .5f, .5f);
  WriteColor("b.exr", .7f, .5f, .3f);
  Run({"compare", "a.exr", "b.exr", "--difference", "d"});
  const auto color = [&](const char* channel) {
    const Image image = ReadPng(Path(std::string("d/b-difference-") + channel + ".png"));
    return std::pair(image.At(1, 1, 0) - image.At(1, 1, 2), image.At(1, 1, 1));
  };
  EXPECT_GT(color("R").first, .3f);   // red: too bright
  EXPECT_LT(color("B").first, -.3f);  // blue: too dark
  EXPECT_NEAR(double(color("G").first), 0, .01);
  EXPECT_NEAR(double(color("G").second), 1, .01);
}

TEST_F(CompareTest, AnotherSeedPassesAndAnotherPaintFails) {
  WriteRoom("room.pbrt", ".6");
  WriteRoom("painted.pbrt", ".57");
  const auto render = [&](const std::string& scene, const char* seed, const std::string& picture,
                          const std::vector<std::string>& layers) {
    std::vector<std::string> words{scene, "--seed", seed, "-o", picture, "--float"};
    words.insert(words.end(), layers.begin(), layers.end());
    ASSERT_EQ(Run(words).status, 0);
  };
  for (const std::vector<std::string>& layers :
       {std::vector<std::string>{"--two-halves"}, {"--aov", "variance"}}) {
    render("room.pbrt", "1", "a.exr", layers);
    render("room.pbrt", "2", "b.exr", layers);
    render("painted.pbrt", "3", "c.exr", layers);
    const ProgramResult same = Run({"compare", "a.exr", "b.exr", "--z-test"});
    EXPECT_EQ(same.status, 0) << same.out << same.err;
    EXPECT_EQ(LastLine(same.out).substr(0, 37), "PASS: no difference beyond noise (9 t")
        << same.out;
    const ProgramResult painted = Run({"compare", "a.exr", "c.exr"});
    EXPECT_EQ(painted.status, 1) << painted.out;
    EXPECT_EQ(LastLine(painted.out).substr(0, 13), "FAIL: G in x ") << painted.out;
  }
}

TEST_F(CompareTest, EachReferenceMustBeARenderOfItsOwn) {
  WriteRoom("room.pbrt", ".6");
  for (const char* seed : {"1", "2", "3"})
    ASSERT_EQ(Run({"room.pbrt", "--seed", seed, "-o", std::string(seed) + ".exr", "--float",
                   "--two-halves"})
                  .status,
              0);
  const auto more = [this](const std::string& name) {
    return Run({"compare", "1.exr", "2.exr", "--z-test", "--more-reference", name});
  };
  EXPECT_EQ(more("3.exr").status, 0);
  Write("copy.exr", Read("1.exr"));
  for (const char* name : {"1.exr", "copy.exr", "2.exr"}) {
    const ProgramResult result = more(name);
    EXPECT_EQ(result.status, 2) << result.out;
    ExpectIn("so the noise test would count them twice", result.err);
  }
}

// Pixels of exphotonmap share the noise of photons and of shared gathers. Four references with
// halves show it. tests/noise/compare_rates.py measures the rates with 100 seeds.
TEST_F(CompareTest, KnowsTheNoiseThatPixelsShare) {
  WriteRoom("room.pbrt", ".6");
  WriteRoom("painted.pbrt", ".5");
  const auto render = [&](const std::string& scene, int seed, const std::string& picture) {
    const ProgramResult result = Run({scene, "--integrator", "exphotonmap", "--two-halves",
                                      "--float", "--seed", std::to_string(seed), "-o", picture});
    ASSERT_EQ(result.status, 0) << result.err;
  };
  std::vector<std::string> more;
  for (int i = 0; i < 4; ++i) {
    const std::string name = "reference" + std::to_string(i) + ".exr";
    render("room.pbrt", 100 + i, name);
    if (i > 0) more.insert(more.end(), {"--more-reference", name});
  }
  const auto verdict = [&] {
    std::vector<std::string> words{"compare", "reference0.exr", "picture.exr", "--z-test"};
    words.insert(words.end(), more.begin(), more.end());
    return Run(words);
  };
  for (int seed = 1; seed <= 3; ++seed) {
    render("room.pbrt", seed, "picture.exr");
    const ProgramResult same = verdict();
    EXPECT_EQ(same.status, 0) << same.out << same.err;
    render("painted.pbrt", 10 + seed, "picture.exr");
    const ProgramResult painted = verdict();
    EXPECT_EQ(painted.status, 1) << painted.out << painted.err;
  }
}

TEST_F(CompareTest, AnUnknownNoiseIsNoPass) {
  WriteColor("a.exr", .5f, .5f, .5f);
  WriteColor("b.exr", .5f, .495f, .5f);
  const ProgramResult result = Run({"compare", "a.exr", "b.exr", "--z-test"});
  EXPECT_EQ(result.status, 2);
  EXPECT_NE(result.err.find("b.exr: --z-test does not know the noise"), std::string::npos)
      << result.err;
  EXPECT_EQ(Run({"compare", "a.exr", "b.exr", "--significance", "2"}).status, 2);
}

}  // namespace
}  // namespace exphoton
