// SPDX-License-Identifier: BSD-2-Clause
// These tests read Cryptomatte layers with a decoder that is written from the specification 1.2,
// without the program's code for hashes.
#include <bit>
#include <cmath>
#include <cstdlib>
#include <map>
#include <numbers>

#include "core/imaging/image.h"
#include "tests/cli/program.h"

namespace exphoton {
namespace {

std::uint32_t Hash(const std::string& text) {
  const auto rotate = [](std::uint32_t x, int r) { return x << r | x >> (32 - r); };
  std::uint32_t h = 0, k = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    k |= std::uint32_t(static_cast<unsigned char>(text[i])) << 8 * (i % 4);
    if (i % 4 != 3 && i + 1 != text.size()) continue;
    k = rotate(k * 3432918353u, 15) * 461845907u;
    h ^= k;
    if (i % 4 == 3) h = rotate(h, 13) * 5 + 3864292196u;
    k = 0;
  }
  h ^= std::uint32_t(text.size());
  h = (h ^ h >> 16) * 2246822507u;
  h = (h ^ h >> 13) * 3266489909u;
  return h ^ h >> 16;
}

// One kind of layers, such as "CryptoObject", with its manifest of names and ids.
struct Decoded {
  const Image& image;
  std::string name;
  std::map<std::string, std::uint32_t> manifest;

  Decoded(const Image& picture, const std::string& layer) : image(picture), name(layer) {
    char key[16];
    std::snprintf(key, sizeof key, "%08x", Hash(layer));
    const std::string start = "cryptomatte/" + std::string(key).substr(0, 7) + "/";
    const auto text = [&](const char* what) {
      const auto found = image.attributes.find(start + what);
      return found == image.attributes.end() ? "" : std::get<std::string>(found->second);
    };
    EXPECT_EQ(text("name"), layer);
    EXPECT_EQ(text("hash"), "MurmurHash3_32");
    EXPECT_EQ(text("conversion"), "uint32_to_float32");
    std::string rest = text("manifest");
    for (std::size_t at = rest.find('"'); at != std::string::npos; at = rest.find('"', at)) {
      const std::size_t end = rest.find('"', at + 1), value = rest.find('"', end + 1);
      manifest[rest.substr(at + 1, end - at - 1)] =
          std::uint32_t(std::strtoul(rest.c_str() + value + 1, nullptr, 16));
      at = rest.find('"', value + 1) + 1;
    }
  }

  // Returns the coverage of a pixel by this id.
  double Coverage(int x, int y, std::uint32_t id) const {
    double sum = 0;
    for (const char* level : {"00", "01", "02"})
      for (const auto& [idChannel, share] : {std::pair{".R", ".G"}, std::pair{".B", ".A"}}) {
        const int a = image.FindChannel(name + level + idChannel);
        const int b = image.FindChannel(name + level + share);
        if (a < 0 || b < 0) ADD_FAILURE() << name << level;
        if (std::bit_cast<std::uint32_t>(image.At(x, y, a)) == id) sum += double(image.At(x, y, b));
      }
    return sum;
  }
  double Area(const std::string& object) const {
    const auto found = manifest.find(object);
    if (found == manifest.end()) {
      ADD_FAILURE() << object;
      return 0;
    }
    double sum = 0;
    for (int y = 0; y < image.Height(); ++y)
      for (int x = 0; x < image.Width(); ++x) sum += Coverage(x, y, found->second);
    return sum;
  }
};

class CryptomatteProgram : public ProgramTest {
 protected:
  Image Render(const std::string& name, std::vector<std::string> options) const {
    Write("scene.pbrt",
          "Film \"image\" \"integer xresolution\" 40 \"integer yresolution\" 30\n"
          "Camera \"orthographic\" \"float screenwindow\" [-4 4 -3 3]\n"
          "SurfaceIntegrator \"directlighting\"\nWorldBegin\n"
          "LightSource \"infinite\"\n"
          "MakeNamedMaterial \"gold\" \"string type\" \"matte\"\n"
          "ObjectBegin \"tree\"\nShape \"sphere\" \"float radius\" .5\nObjectEnd\n"
          "AttributeBegin\nNamedMaterial \"gold\"\nTranslate -1.7 .3 5\n"
          "Shape \"sphere\" \"float radius\" 1.5\nAttributeEnd\n"
          "AttributeBegin\nTranslate 2 0 5\nObjectInstance \"tree\"\nAttributeEnd\n"
          "Translate 0 -2 4\n"
          "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] "
          "\"point P\" [-3 -.4 0 3 -.4 0 3 .4 0 -3 .4 0]\nWorldEnd\n");
    std::vector<std::string> words{"scene.pbrt", "-o",          name,
                                   "--aov",      "cryptomatte", "--reproducible"};
    words.insert(words.end(), options.begin(), options.end());
    const ProgramResult result = Run(words);
    EXPECT_EQ(result.status, 0) << result.err;
    return ReadImage(Path(name));
  }
};

TEST_F(CryptomatteProgram, MasksHaveTheAreasOfTheObjects) {
  for (const char* filter : {"box", "gaussian", "mitchell"}) {
    const Image image = Render("a.exr", {"--spp", "64", "--filter", filter});
    const Decoded objects(image, "CryptoObject"), materials(image, "CryptoMaterial");
    // A pixel is .2 wide and high.
    const double pi = std::numbers::pi;
    EXPECT_NEAR(objects.Area("sphere_1"), pi * 1.5 * 1.5 / .04, .5) << filter;
    EXPECT_NEAR(objects.Area("tree_2"), pi * .25 / .04, .5) << filter;
    EXPECT_NEAR(objects.Area("trianglemesh_3"), 6 * .8 / .04, .5) << filter;
    EXPECT_NEAR(materials.Area("gold"), objects.Area("sphere_1"), 1e-3) << filter;
    EXPECT_EQ(objects.manifest.size(), 3u);
  }
}

TEST_F(CryptomatteProgram, ManifestHoldsTheHashesOfTheNames) {
  const Image image = Render("a.exr", {"--spp", "4"});
  for (const char* layer : {"CryptoObject", "CryptoMaterial"})
    for (const auto& [name, id] : Decoded(image, layer).manifest) {
      std::uint32_t hash = Hash(name);
      const std::uint32_t exponent = hash >> 23 & 255;
      if (exponent == 0 || exponent == 255) hash ^= 1u << 23;
      EXPECT_EQ(id, hash) << name;
    }
}

TEST_F(CryptomatteProgram, LayersDoNotDependOnThreadsCropsHalvesOrShards) {
  const Image one = Render("a.exr", {"--spp", "8", "--nthreads", "1"});
  Render("b.exr", {"--spp", "8", "--nthreads", "3"});
  EXPECT_EQ(Read("a.exr"), Read("b.exr"));
  const Image crop = Render("c.exr", {"--spp", "8", "--pixelbounds", "7,25,3,20"});
  for (int y = 3; y < 20; ++y)
    for (int x = 7; x < 25; ++x)
      for (int c = 0; c < one.ChannelCount(); ++c)
        EXPECT_EQ(std::bit_cast<std::uint32_t>(one.At(x, y, c)),
                  std::bit_cast<std::uint32_t>(crop.At(x - 7, y - 3, c)));
  for (const char* shard : {"1/2", "2/2"})
    ASSERT_EQ(Run({"scene.pbrt", "--spp", "8", "--aov", "cryptomatte", "--reproducible", "--shard",
                   shard, "-o", "parts"})
                  .status,
              0);
  ASSERT_EQ(Run({"merge", "parts", "-o", "merged.exr"}).status, 0);
  EXPECT_EQ(Read("merged.exr"), Read("a.exr"));
}

TEST_F(CryptomatteProgram, ExrToolsReadTheLayers) {
  if (std::system("command -v exrheader > /dev/null 2>&1") != 0)
    GTEST_SKIP() << "exrheader is not installed";
  Render("a.exr", {"--spp", "1"});
  const ProcessResult header = RunProcess({{"exrheader", Path("a.exr")}, testing::TempDir()});
  EXPECT_EQ(header.status, 0);
  EXPECT_NE(header.out.find("CryptoObject00.R, 32-bit floating-point"), std::string::npos)
      << header.out;
  EXPECT_NE(header.out.find("\"CryptoMaterial\""), std::string::npos);
}

}  // namespace
}  // namespace exphoton
