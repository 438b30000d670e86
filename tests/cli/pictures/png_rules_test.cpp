// SPDX-License-Identifier: BSD-2-Clause
// These tests check that no option or layer is lost silently where a picture is a PNG, however the
// picture is named and whichever command writes it.
#include "core/imaging/files/exr.h"
#include "tests/cli/program.h"

namespace exphoton {
namespace {

class PngRules : public ProgramTest {
 protected:
  using Arguments = std::vector<std::string>;

  PngRules() { Write("scene.pbrt", SmallScene("SurfaceIntegrator \"directlighting\"")); }
  ProgramResult RunWith(Arguments arguments, const Arguments& more) const {
    arguments.insert(arguments.end(), more.begin(), more.end());
    return Run(arguments);
  }
  static void ExpectText(const ProgramResult& result, int status, const std::string& text) {
    EXPECT_EQ(result.status, status) << result.err;
    EXPECT_NE(result.err.find(text), std::string::npos) << text << "\nnot in\n" << result.err;
  }
  void RenderPart(const Arguments& more) const {
    const ProgramResult result =
        RunWith({"scene.pbrt", "--shard", "1/1", "-o", "parts", "--spp", "2"}, more);
    ASSERT_EQ(result.status, 0) << result.err;
  }
};

TEST_F(PngRules, APngThatSetNamesHasTheRulesOfAnyOther) {
  for (const Arguments& name : {Arguments{"scene.pbrt", "-o", "a.png"},
                                Arguments{"scene.pbrt", "--set", "Film.filename=a.png"}}) {
    ExpectText(RunWith(name, {"--aov", "albedo"}), 1, "a PNG has no layers for --aov");
    ExpectText(RunWith(name, {"--two-halves"}), 1, "a PNG has no layers for --two-halves");
    ExpectText(RunWith(name, {"--float"}), 1, "a PNG has 8 bits");
    ExpectText(RunWith(name, {"--half"}), 1, "a PNG has 8 bits");
    EXPECT_EQ(Files(), Arguments{"scene.pbrt"});
    const ProgramResult result = RunWith(name, {"--exposure", "1", "--tone-curve", "filmic"});
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_TRUE(Exists("a.png"));
    Remove("a.png");
  }
}

TEST_F(PngRules, AnExrThatSetNamesHasNoToneCurve) {
  const Arguments set{"scene.pbrt", "--set", "Film.filename=a.exr"};
  ExpectText(RunWith(set, {"--exposure", "1"}), 1, "an EXR stays linear");
  const ProgramResult layers = RunWith(set, {"--aov", "albedo", "--float"});
  EXPECT_EQ(layers.status, 0) << layers.err;
  // The option -o takes precedence over --set.
  const ProgramResult png = RunWith(set, {"-o", "b.png", "--exposure", "1"});
  EXPECT_EQ(png.status, 0) << png.err;
}

// The colours of an EXR are multiplied by alpha, and those of a PNG are not.
TEST_F(PngRules, ConversionKeepsHalfCoveredPixels) {
  Image image(1, 1, {"R", "G", "B", "A"});
  image.pixels = {.25f, .1f, 0, .5f};
  WriteExr(Path("a.exr"), image, false);
  ExpectText(Run({"convert", "a.exr", "a.png"}), 0, "");
  EXPECT_NEAR(ReadImage(Path("a.png")).At(0, 0, 0), .5, .004);
  ExpectText(Run({"convert", "a.png", "b.exr", "--float"}), 0, "");
  const Image back = ReadImage(Path("b.exr"));
  EXPECT_NEAR(back.At(0, 0, 0), .25, .003);
  EXPECT_NEAR(back.At(0, 0, 1), .1, .003);
  EXPECT_NEAR(back.At(0, 0, 3), .5, .002);
}

// A film multiplies its colours by alpha once more, unless the scene asks for the ones that
// compositing needs. A PNG of these has the colours of the surfaces.
TEST_F(PngRules, APngOfAFilmWithoutPremultiplicationHasTheColoursOfSurfaces) {
  const Arguments scene{"scene.pbrt", "--spp", "4", "--seed", "2"};
  std::vector<float> pixels[2];
  int partial = 0;
  for (const int i : {0, 1}) {
    const std::string film = i == 0 ? "true" : "false";
    ExpectText(RunWith(scene, {"--set", "Film.premultiplyalpha=" + film, "-o", "a.png"}), 0, "");
    pixels[i] = ReadImage(Path("a.png")).pixels;
  }
  for (std::size_t i = 0; i < pixels[0].size(); i += 4) {
    const float alpha = pixels[0][i + 3];
    if (!(alpha > 0)) continue;
    partial += alpha < 1;
    for (std::size_t c = 0; c < 3; ++c) {
      if (!(pixels[1][i + c] < 1)) continue;                         // clipped
      EXPECT_NEAR(pixels[0][i + c], alpha * pixels[1][i + c], .01);  // one step of 8 bits
    }
  }
  EXPECT_GT(partial, 0);
}

TEST_F(PngRules, AMergeRefusesOptionsWithoutEffect) {
  RenderPart({});
  const Arguments exr{"merge", "parts", "-o", "a.exr"}, png{"merge", "parts", "-o", "a.png"};
  ExpectText(RunWith(exr, {"--exposure", "1"}), 1, "--exposure and --tone-curve are for PNG");
  ExpectText(RunWith(exr, {"--tone-curve", "filmic"}), 1, "an EXR stays linear");
  ExpectText(RunWith(png, {"--float"}), 1, "--half and --float are for EXR");
  ExpectText(RunWith(png, {"--half"}), 1, "a PNG has 8 bits");
  EXPECT_FALSE(Exists("a.exr"));
  EXPECT_FALSE(Exists("a.png"));
  EXPECT_EQ(RunWith(exr, {"--float"}).status, 0);
  const ProgramResult result = RunWith(png, {"--exposure", "1"});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(result.err.find("layers"), std::string::npos) << result.err;
}

TEST_F(PngRules, AMergeNamesTheLayersThatAPngLacks) {
  RenderPart({"--two-halves", "--aov", "albedo,N"});
  ExpectText(Run({"merge", "parts", "-o", "a.png", "--quiet"}), 0,
             "warning: a PNG has no layers, so \"a.png\" lacks albedo, N, half1, half2");
  EXPECT_TRUE(Exists("a.png"));
  const ProgramResult exr = Run({"merge", "parts", "-o", "a.exr"});
  EXPECT_EQ(exr.status, 0) << exr.err;
  EXPECT_EQ(exr.err.find("lacks"), std::string::npos) << exr.err;
}

}  // namespace
}  // namespace exphoton
