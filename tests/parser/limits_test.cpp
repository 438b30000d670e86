// SPDX-License-Identifier: BSD-2-Clause
// These tests load short scene files that would cause endless work: chains and graphs of textures,
// and files that include other files repeatedly. The loader must refuse such files at once, and
// --limits must allow more. Another file would take much memory if materials kept all textures.
#include <gtest/gtest.h>

#include <chrono>

#include "core/base/statistics.h"
#include "tests/parser/parse_support.h"

namespace exphoton {
namespace {

// Returns a chain of textures. Texture t<i> uses t<i-1> through each of the given parameters, which
// are "tex1" or "tex2".
std::string Chain(int length, const std::vector<std::string>& parameters,
                  const std::string& plugin = "mix") {
  std::string text = "Texture \"t0\" \"color\" \"uv\"\n";
  for (int i = 1; i < length; ++i) {
    text += "Texture \"t" + std::to_string(i) + "\" \"color\" \"" + plugin + '"';
    for (const std::string& name : parameters)
      text += " \"texture " + name + "\" \"t" + std::to_string(i - 1) + '"';
    text += '\n';
  }
  return text + "Material \"matte\" \"texture Kd\" \"t" + std::to_string(length - 1) +
         "\" Shape \"sphere\"";
}

TEST(TextureGraphs, OfALongChainAreRefusedBeforeTheyOverflowTheStack) {
  EXPECT_EQ(BuildText(InWorld(Chain(256, {"tex1"}))).error, "");
  for (const int length : {257, 6000}) {
    const BuiltScene built = BuildText(InWorld(Chain(length, {"tex1"}, "scale")));
    EXPECT_EQ(built.status, 2);
    EXPECT_NE(built.error.find("260:1: error: texture \"t256\" is the top of a chain of more than "
                               "256 textures that use each other"),
              std::string::npos)
        << built.error;
  }
}

TEST(TextureGraphs, ThatDoubleAtEachLevelDoNotHangTheParser) {
  const auto start = std::chrono::steady_clock::now();
  for (const char* plugin : {"mix", "scale", "checkerboard"}) {
    const BuiltScene built = BuildText(InWorld(Chain(60, {"tex1", "tex2"}, plugin)));
    EXPECT_NE(built.error.find("error: texture \"t19\" evaluates more than 1000000 textures a "
                               "lookup"),
              std::string::npos)
        << built.error;
    EXPECT_NE(built.error.find("--limits texturenodes=N"), std::string::npos);
    // Without the limit the scene loads, because loading alone evaluates no texture.
    LoadOptions options;
    options.limits.textureNodes = std::int64_t(1) << 59;
    EXPECT_EQ(BuildText(InWorld(Chain(58, {"tex1", "tex2"}, plugin)), options).error, "");
    // The sum of the node counts must not overflow.
    options.limits.textureNodes = (std::int64_t(1) << 60) - 1;
    EXPECT_NE(BuildText(InWorld(Chain(200, {"tex1", "tex2"}, plugin)), options).error, "");
  }
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(20));
}

TEST(TextureGraphs, CountATextureOnlyForTheKindThatIsUsed) {
  // Every name exists as a colour texture and as a float texture. Each texture uses the texture
  // below it of the same kind, so counting both kinds would double the count at every level.
  std::string text =
      "Texture \"t0\" \"color\" \"uv\"\nTexture \"t0\" \"float\" \"bilerp\" \"float v01\" 1\n";
  for (int i = 1; i < 200; ++i) {
    const std::string name = "\"t" + std::to_string(i) + '"',
                      below = "\"t" + std::to_string(i - 1) + '"';
    text += "Texture " + name + " \"color\" \"scale\" \"texture tex1\" " + below + '\n';
    text += "Texture " + name + " \"float\" \"scale\" \"texture tex1\" " + below + '\n';
  }
  EXPECT_EQ(BuildText(InWorld(text)).error, "");
}

TEST(NamedMaterials, KeepOnlyTheTexturesThatTheyName) {
  std::string text;
  for (int i = 0; i < 1500; ++i) {
    const std::string name = "\"t" + std::to_string(i) + '"';
    text += "Texture " + name + " \"color\" \"constant\"\nMakeNamedMaterial " + name +
            " \"string type\" \"matte\" \"texture Kd\" " + name + '\n';
  }
  ResetPeakMemory();
  const double before = PeakMemoryBytes();
  EXPECT_EQ(BuildText(InWorld(text)).error, "");
  EXPECT_LT(PeakMemoryBytes() - before, 5e7);
}

TEST(Includes, ThatDoubleAtEachLevelEnd) {
  Files files{{"scene.pbrt", "Include \"a1\"\nInclude \"a1\"\n"}, {"a31", ""}};
  for (int i = 1; i < 31; ++i) {
    const std::string next = "Include \"a" + std::to_string(i + 1) + "\"\n";
    files["a" + std::to_string(i)] = next + next;
  }
  const std::string error = ParseErrorOf(files);
  EXPECT_NE(error.find("error: the scene includes more than 100000 files"), std::string::npos)
      << error;
  EXPECT_NE(error.find("--limits includes=N allows N"), std::string::npos);
}

TEST(Includes, MayBeAsManyAsTheLimit) {
  const auto isAllowed = [](int count, std::int64_t limit) {
    std::string text;
    for (int i = 0; i < count; ++i) text += "Include \"part\"\n";
    MemorySource source({{"scene.pbrt", text}, {"part", "Identity"}});
    DirectiveList list;
    Log quiet(Log::Level::Normal, Log::Sink::Memory);
    SceneLimits limits;
    limits.includes = limit;
    try {
      ParseScene(source, "scene.pbrt", list, quiet, limits);
    } catch (const Error&) {
      return false;
    }
    return true;
  };
  EXPECT_TRUE(isAllowed(3, 3));
  EXPECT_FALSE(isAllowed(4, 3));
  EXPECT_TRUE(isAllowed(1, 1));
  EXPECT_FALSE(isAllowed(1, 0));
}

TEST(Includes, OfOneFileManyTimesOverAreNoError) {
  std::string text;
  for (int i = 0; i < 20'000; ++i) text += "Include \"empty\"\n";
  EXPECT_EQ(ParseErrorOf({{"scene.pbrt", text}, {"empty", "Identity"}}), "");
}

}  // namespace
}  // namespace exphoton
