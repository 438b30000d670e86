// SPDX-License-Identifier: BSD-2-Clause
// These tests run `exphoton import` and render the converted scenes.
#include "tests/cli/program.h"

namespace exphoton {
namespace {

class ImportProgram : public ProgramTest {};

const std::string kExact4 =
    "Film \"rgb\" \"string filename\" \"out.exr\" \"integer xresolution\" 24 "
    "\"integer yresolution\" 16\n"
    "Scale -1 1 1\nLookAt 0 1 -5 0 .5 0 0 1 0\nCamera \"perspective\" \"float fov\" 40\n"
    "Sampler \"halton\" \"integer pixelsamples\" 4\nIntegrator \"path\" \"integer maxdepth\" 3\n"
    "PixelFilter \"box\"\nWorldBegin\n"
    "LightSource \"point\" \"rgb I\" [9 9 9] \"point3 from\" [1 3 -3]\n"
    "MakeNamedMaterial \"red\" \"string type\" \"diffuse\" \"rgb reflectance\" [.7 .2 .1]\n"
    "NamedMaterial \"red\"\nShape \"sphere\" \"float radius\" .5\n"
    "Material \"diffuse\"\n"
    "Shape \"bilinearmesh\" \"point3 P\" [-3 -.5 -3 3 -.5 -3 -3 -.5 3 3 -.5 3]\n";
const std::string kTheSame =
    "Film \"image\" \"string filename\" \"same.exr\" \"integer xresolution\" 24 "
    "\"integer yresolution\" 16\n"
    "LookAt 0 1 -5 0 .5 0 0 1 0\nCamera \"perspective\" \"float fov\" 40\n"
    "Sampler \"halton\" \"integer pixelsamples\" 4\n"
    "SurfaceIntegrator \"path\" \"integer maxdepth\" 2\nPixelFilter \"box\"\nWorldBegin\n"
    "LightSource \"point\" \"color I\" [9 9 9] \"point from\" [1 3 -3]\n"
    "Material \"matte\" \"color Kd\" [.7 .2 .1]\nShape \"sphere\" \"float radius\" .5\n"
    "Material \"matte\" \"color Kd\" [.5 .5 .5]\n"
    "Shape \"trianglemesh\" \"integer indices\" [0 1 3 0 3 2] "
    "\"point P\" [-3 -.5 -3 3 -.5 -3 -3 -.5 3 3 -.5 3] "
    "\"float uv\" [0 0 1 0 0 1 1 1]\nWorldEnd\n";

TEST_F(ImportProgram, ConvertedSceneHasThePictureOfTheSameSceneWrittenByHand) {
  Write("four.pbrt", kExact4);
  Write("same.pbrt", kTheSame);
  const ProgramResult imported = Run({"import", "four.pbrt", "-o", "one.pbrt"});
  EXPECT_EQ(imported.status, 0) << imported.err;
  EXPECT_NE(imported.err.find("wrote \"one.pbrt\", converted from version 4: everything has its "
                              "equivalent"),
            std::string::npos)
      << imported.err;
  ASSERT_EQ(Run({"one.pbrt", "same.pbrt", "--strict", "--float"}).status, 0);
  const ProgramResult compared = Run({"compare", "same.exr", "out.exr", "--max-relmse", "0"});
  EXPECT_EQ(compared.status, 0) << compared.out << compared.err;
}

TEST_F(ImportProgram, StatusSaysWhetherSomethingIsMissing) {
  Write("four.pbrt", kExact4 + "Shape \"curve\"\n");
  const ProgramResult inexact = Run({"import", "four.pbrt", "-o", "one.pbrt"});
  EXPECT_EQ(inexact.status, 6);
  EXPECT_NE(inexact.err.find("four.pbrt:15:1: warning: Shape \"curve\" is left out"),
            std::string::npos)
      << inexact.err;
  EXPECT_NE(inexact.err.find("0 things are replaced by something similar, and 1 thing is left out"),
            std::string::npos)
      << inexact.err;
  EXPECT_NE(Read("one.pbrt").find("#   four.pbrt:15:1: Shape \"curve\" is left out\n"),
            std::string::npos);
}

TEST_F(ImportProgram, ErrorsWriteNothing) {
  Write("broken.pbrt", kExact4 + "Shape \"sphere\" \"float radius\" [1\n");
  const ProgramResult broken = Run({"import", "broken.pbrt", "-o", "one.pbrt"});
  EXPECT_EQ(broken.status, 2);
  EXPECT_NE(broken.err.find("broken.pbrt:15:31: error"), std::string::npos) << broken.err;
  EXPECT_EQ(Run({"import", "none.pbrt", "-o", "one.pbrt"}).status, 3);
  EXPECT_EQ(Run({"import", "broken.pbrt"}).status, 1);
  EXPECT_EQ(Run({"import", "broken.pbrt", "-o", "one.txt"}).status, 1);
  EXPECT_FALSE(Exists("one.pbrt"));
  Write("four.pbrt", kExact4);
  EXPECT_EQ(Run({"import", "four.pbrt", "-o", "four.pbrt"}).status, 3);
  EXPECT_EQ(Read("four.pbrt"), kExact4);
}

TEST_F(ImportProgram, RenderingALaterSceneNamesTheCommand) {
  Write("four.pbrt", kExact4);
  const ProgramResult refused = Run({"four.pbrt"});
  EXPECT_EQ(refused.status, 2);
  EXPECT_NE(refused.err.find("hint: exphoton import four.pbrt -o NEW.pbrt converts it"),
            std::string::npos)
      << refused.err;
}

// A map of one radiance gives the picture of a light without a map.
TEST_F(ImportProgram, ConvertsTheMapOfASky) {
  Write(
      "white.pfm", "PF\n4 4\n-1\n" + [] {
        std::string pixels;
        const float value = .5f;
        for (int i = 0; i < 48; ++i) pixels.append(reinterpret_cast<const char*>(&value), 4);
        return pixels;
      }());
  Write("four.pbrt", kExact4 + "LightSource \"infinite\" \"string filename\" \"white.pfm\"\n");
  const ProgramResult imported = Run({"import", "four.pbrt", "-o", "one.pbrt"});
  EXPECT_EQ(imported.status, 0) << imported.err;
  ASSERT_TRUE(Exists("one-sky1.exr"));
  EXPECT_NE(Read("one.pbrt").find("\"string mapname\" [\"one-sky1.exr\"]"), std::string::npos);
  std::string constant = kTheSame;
  constant.insert(constant.find("WorldEnd"), "LightSource \"infinite\" \"color L\" [.5 .5 .5]\n");
  Write("same.pbrt", constant);
  ASSERT_EQ(Run({"one.pbrt", "same.pbrt", "--spp", "64"}).status, 0);
  const ProgramResult compared = Run({"compare", "same.exr", "out.exr", "--max-relmse", "1e-2"});
  EXPECT_EQ(compared.status, 0) << compared.out << compared.err;
}

}  // namespace
}  // namespace exphoton
