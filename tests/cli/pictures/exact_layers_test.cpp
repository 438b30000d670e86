// SPDX-License-Identifier: BSD-2-Clause
// These tests check that `exphoton denoise` and `exphoton convert` keep layers of 32 bits, warn of
// values that 16 bits cannot hold, and read pictures with all AOVs.
#include <bit>

#include "core/imaging/film/aovs.h"
#include "core/imaging/image.h"
#include "tests/cli/program.h"

namespace exphoton {
namespace {

using Words = std::vector<std::string>;

const char* const kClampingText = "values above 65504 were written as 65504; --float stores them";

class ExactLayers : public ProgramTest {
 protected:
  ProgramResult RunWell(const Words& words) const {
    const ProgramResult result = Run(words);
    EXPECT_EQ(result.status, 0) << result.err;
    return result;
  }
  void Render(const Words& options) const {
    Write("scene.pbrt", SmallScene("SurfaceIntegrator \"directlighting\""));
    Words words{"scene.pbrt", "--two-halves", "--aov", "albedo,N,Z,P,objectId,cryptomatte"};
    words.insert(words.end(), options.begin(), options.end());
    RunWell(words);
  }
  void RenderBrightSky() const {
    Write("scene.pbrt",
          "Film \"image\" \"integer xresolution\" 4 \"integer yresolution\" 3\nWorldBegin\n"
          "LightSource \"infinite\" \"color L\" [1e6 1e6 1e6]\nWorldEnd\n");
    RunWell({"scene.pbrt", "--float", "--two-halves", "--aov", "albedo,N", "-o", "sky.exr"});
  }
  Image Picture(const std::string& name) const { return ReadImage(Path(name)); }
};

// Returns the bits of all pixels of a channel.
std::vector<std::uint32_t> ChannelBits(const Image& image, const std::string& name) {
  const int channel = image.FindChannel(name);
  EXPECT_GE(channel, 0) << name;
  std::vector<std::uint32_t> bits;
  for (int y = 0; y < image.Height() && channel >= 0; ++y)
    for (int x = 0; x < image.Width(); ++x)
      bits.push_back(std::bit_cast<std::uint32_t>(image.At(x, y, channel)));
  return bits;
}

// Returns whether 16 bits hold all values. A half has 13 bits less in its mantissa.
bool FitsHalves(const std::vector<std::uint32_t>& bits) {
  for (const std::uint32_t value : bits)
    if ((value & 0x1fffu) != 0) return false;
  return true;
}

void ExpectSameExactLayers(const Image& before, const Image& after) {
  EXPECT_FALSE(FitsHalves(ChannelBits(before, "Z")));
  EXPECT_FALSE(FitsHalves(ChannelBits(before, "CryptoObject00.R")));
  for (const char* name : {"Z", "P.X", "P.Y", "objectId.id", "CryptoObject00.R", "CryptoObject00.G",
                           "CryptoMaterial00.R", "CryptoMaterial00.G", "CryptoObject01.R"})
    EXPECT_EQ(ChannelBits(before, name), ChannelBits(after, name)) << name;
  for (const char* name : {"R", "G", "B", "albedo.R", "N.X"})
    EXPECT_TRUE(FitsHalves(ChannelBits(after, name))) << name;
}

TEST_F(ExactLayers, DenoisingKeepsDepthAndCryptomatte) {
  for (const char* type : {"--half", "--float"}) {
    Render({type});
    RunWell({"denoise", "out.exr", "-o", "clean.exr"});
    ExpectSameExactLayers(Picture("out.exr"), Picture("clean.exr"));
  }
}

TEST_F(ExactLayers, ConvertingKeepsDepthAndCryptomatte) {
  for (const char* type : {"--half", "--float"}) {
    Render({type});
    RunWell({"convert", "out.exr", "copy.exr"});
    ExpectSameExactLayers(Picture("out.exr"), Picture("copy.exr"));
  }
}

TEST_F(ExactLayers, ConvertingOneOfThemKeepsItsBits) {
  Render({"--float"});
  const Image whole = Picture("out.exr");
  for (const auto& [layer, channel] :
       {std::pair{"Z", "Z"}, std::pair{"P", "P.X"}, std::pair{"objectId", "objectId.id"},
        std::pair{"CryptoObject00", "CryptoObject00.R"}}) {
    RunWell({"convert", "out.exr", "layer.exr", "--layer", layer});
    EXPECT_EQ(ChannelBits(Picture("layer.exr"), "R"), ChannelBits(whole, channel)) << layer;
  }
  RunWell({"convert", "out.exr", "layer.exr", "--layer", "half1"});
  EXPECT_TRUE(FitsHalves(ChannelBits(Picture("layer.exr"), "R")));
}

TEST_F(ExactLayers, ConvertWarnsOfValuesThatAreTooLargeFor16Bits) {
  RenderBrightSky();
  const ProgramResult halves = RunWell({"convert", "sky.exr", "a.exr"});
  EXPECT_NE(halves.err.find(kClampingText), std::string::npos) << halves.err;
  EXPECT_EQ(RunWell({"convert", "sky.exr", "b.exr", "--float"}).err, "");
  EXPECT_EQ(Picture("a.exr").At(1, 1, 0), 65504);
}

TEST_F(ExactLayers, DenoiseWarnsOfValuesThatAreTooLargeFor16Bits) {
  RenderBrightSky();
  const ProgramResult halves = RunWell({"denoise", "sky.exr", "-o", "a.exr"});
  EXPECT_NE(halves.err.find("36 " + std::string(kClampingText)), std::string::npos) << halves.err;
  const ProgramResult floats = RunWell({"denoise", "sky.exr", "-o", "b.exr", "--float"});
  EXPECT_EQ(floats.err.find(kClampingText), std::string::npos) << floats.err;
}

TEST_F(ExactLayers, APictureWithAllAovsAndHalvesIsRead) {
  Write("scene.pbrt", SmallScene("SurfaceIntegrator \"exphotonmap\" \"integer causticphotons\" 0 "
                                 "\"integer indirectphotons\" 200"));
  std::string aovs;
  for (int i = 0; i < kAovCount; ++i)
    aovs += (aovs.empty() ? "" : ",") + std::string(GetAovInfo(Aov(i)).name);
  RunWell({"scene.pbrt", "--spp", "4", "--two-halves", "--aov", aovs});
  EXPECT_NE(RunWell({"info", "out.exr"}).out.find("half2.B"), std::string::npos);
  RunWell({"denoise", "out.exr", "-o", "clean.exr"});
  RunWell({"convert", "out.exr", "copy.exr"});
}

}  // namespace
}  // namespace exphoton
