// SPDX-License-Identifier: BSD-2-Clause
// These tests run `exphoton denoise` on rendered pictures.
#include "core/imaging/image.h"
#include "core/imaging/metrics/metrics.h"
#include "tests/cli/program.h"

namespace exphoton {
namespace {

class DenoiseProgram : public ProgramTest {
 protected:
  // Renders a sphere under a lamp and a sky, which path tracing shows with noise.
  void Render(const std::string& name, std::vector<std::string> options) const {
    Write("scene.pbrt",
          "Film \"image\" \"integer xresolution\" 48 \"integer yresolution\" 36\n"
          "SurfaceIntegrator \"path\"\nPixelFilter \"box\"\n"
          "Camera \"perspective\" \"float fov\" 50\nWorldBegin\n"
          "AttributeBegin\nAreaLightSource \"area\" \"color L\" [9 8 6]\n"
          "Translate 1 3 3 Rotate 90 1 0 0 Shape \"disk\" \"float radius\" .6\nAttributeEnd\n"
          "LightSource \"infinite\" \"color L\" [.2 .3 .4]\nTranslate 0 -.5 4\n"
          "Material \"matte\" \"color Kd\" [.7 .6 .5]\nShape \"sphere\"\n"
          "Translate 0 -1 0 Rotate -90 1 0 0 Shape \"disk\" \"float radius\" 5\nWorldEnd\n");
    std::vector<std::string> words{"scene.pbrt", "--float", "-o", name};
    words.insert(words.end(), options.begin(), options.end());
    const ProgramResult result = Run(words);
    ASSERT_EQ(result.status, 0) << result.err;
  }
  double ErrorOf(const std::string& name) const {
    return CompareImages(ReadImage(Path("ref.exr")), ReadImage(Path(name))).relMse;
  }
};

TEST_F(DenoiseProgram, BringsAPictureNearerToItsReference) {
  Render("ref.exr", {"--spp", "512", "--seed", "5"});
  Render("noisy.exr", {"--spp", "4", "--two-halves", "--aov", "albedo,N,Z"});
  const ProgramResult result = Run({"denoise", "noisy.exr", "--float"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.err.find("wrote \"noisy-denoised.exr\": noise \u00b1"), std::string::npos)
      << result.err;
  EXPECT_NE(result.err.find("(bias not included)"), std::string::npos);
  EXPECT_LT(ErrorOf("noisy-denoised.exr"), ErrorOf("noisy.exr") / 2);
  const Image picture = ReadImage(Path("noisy-denoised.exr"));
  EXPECT_TRUE(picture.attributes.contains("residualNoise"));
  EXPECT_EQ(std::get<std::string>(picture.attributes.at("scene")), "scene.pbrt");
}

TEST_F(DenoiseProgram, ThreadsDoNotChangeTheFile) {
  Render("noisy.exr", {"--spp", "8", "--two-halves", "--aov", "albedo,N", "--reproducible"});
  ASSERT_EQ(Run({"denoise", "noisy.exr", "-o", "one.exr", "--nthreads", "1"}).status, 0);
  ASSERT_EQ(Run({"denoise", "noisy.exr", "-o", "three.exr", "--nthreads", "3"}).status, 0);
  EXPECT_EQ(Read("one.exr"), Read("three.exr"));
  ASSERT_EQ(Run({"denoise", "noisy.exr", "-o", "view.png", "--exposure", "1"}).status, 0);
  EXPECT_TRUE(Exists("view.png"));
}

TEST_F(DenoiseProgram, NamesTheOptionsOfAMissingLayer) {
  Render("plain.exr", {"--spp", "4", "--aov", "albedo"});
  const ProgramResult result = Run({"denoise", "plain.exr"});
  EXPECT_EQ(result.status, 3);
  EXPECT_NE(result.err.find("\"plain.exr\" lacks the layers half1, half2, N\n    hint: render with "
                            "--two-halves --aov albedo,N,Z"),
            std::string::npos)
      << result.err;
  EXPECT_EQ(Run({"denoise", "plain.exr", "-o", "a.jpg"}).status, 1);
  EXPECT_EQ(Run({"denoise", "plain.exr", "-o", "plain.exr"}).status, 3);
  EXPECT_EQ(Run({"denoise", "plain.exr", "-o", "a.exr", "--exposure", "1"}).status, 1);
  EXPECT_EQ(Run({"denoise"}).status, 1);
  EXPECT_FALSE(Exists("plain-denoised.exr"));
}

}  // namespace
}  // namespace exphoton
