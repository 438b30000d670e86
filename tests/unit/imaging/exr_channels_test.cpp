// SPDX-License-Identifier: BSD-2-Clause
// These tests check which channels of an OpenEXR file stay exact when it is read and written again,
// and how many channels a file may have.
#include <gtest/gtest.h>

#include "core/imaging/files/exr.h"
#include "core/imaging/film/aovs.h"
#include "tests/support/process.h"

namespace exphoton {
namespace {

using Names = std::set<std::string>;

// ExrChannels writes a picture into a folder of its own and reads it.
class ExrChannels : public testing::Test {
 protected:
  std::string Path() const { return folder_.File("a.exr"); }
  Image Reread(const Image& image, bool asHalf) const {
    WriteExr(Path(), image, asHalf);
    return ReadExr(Path());
  }

 private:
  TestFolder folder_;
};

std::vector<std::string> ChannelsOfAllAovsAndHalves() {
  std::vector<std::string> channels{"R", "G", "B", "A"};
  for (int i = 0; i < kAovCount; ++i) {
    const auto& own = GetAovInfo(Aov(i)).channels;
    channels.insert(channels.end(), own.begin(), own.end());
  }
  for (const char* half : {"half1.", "half2."})
    for (const char* color : {"R", "G", "B"}) channels.push_back(std::string(half) + color);
  return channels;
}

TEST_F(ExrChannels, FloatsBesideHalvesStayExact) {
  Image image(5, 40, {"R", "G", "B", "Z", "motion.X", "albedo.R"});
  image.exactChannels = {"Z", "motion.X"};
  for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = 1000.03f + float(i);
  const Image once = Reread(image, true);
  EXPECT_EQ(once.exactChannels, (Names{"Z", "motion.X"}));
  const Image twice = Reread(once, true);
  for (const char* name : {"Z", "motion.X"})
    for (int y = 0; y < image.Height(); ++y)
      EXPECT_EQ(twice.At(2, y, twice.FindChannel(name)), image.At(2, y, image.FindChannel(name)));
}

TEST_F(ExrChannels, APictureOfFloatsKeepsExactAovsAndNoColors) {
  Names exact;
  for (int i = 0; i < kAovCount; ++i) {
    const AovInfo& info = GetAovInfo(Aov(i));
    if (info.isExact) exact.insert(info.channels.begin(), info.channels.end());
  }
  EXPECT_TRUE(exact.contains("CryptoObject00.R"));
  const Image image(2, 2, ChannelsOfAllAovsAndHalves());
  EXPECT_EQ(Reread(image, false).exactChannels, exact);
}

TEST_F(ExrChannels, HalvesAreNotExact) {
  EXPECT_EQ(Reread(Image(2, 2, {"R", "G", "B", "Z", "P.X"}), true).exactChannels, Names());
}

TEST_F(ExrChannels, CryptomatteOfOtherProgramsStaysExact) {
  Image image(2, 2, {"R", "G", "B", "View.Asset00.r", "View.Asset01.a", "View.Combined.r"});
  image.attributes["cryptomatte/1234567/name"] = std::string("View.Asset");
  image.attributes["cryptomatte/1234567/hash"] = std::string("R");
  image.attributes["cryptomatte/7654321/name"] = std::string();
  EXPECT_EQ(Reread(image, false).exactChannels, (Names{"View.Asset00.r", "View.Asset01.a"}));
}

// The type in the list of channels is changed: 0 is an integer, 2 is a float.
TEST_F(ExrChannels, IntegersStayExact) {
  WriteExr(Path(), Image(2, 2, {"R", "G", "B", "id"}), false);
  std::string bytes = ReadFile(Path());
  const std::size_t at = bytes.find(std::string("id\0\2\0\0\0", 7));
  ASSERT_NE(at, std::string::npos);
  bytes[at + 3] = 0;
  WriteFile(Path(), bytes);
  EXPECT_EQ(ReadExr(Path()).exactChannels, Names{"id"});
}

TEST_F(ExrChannels, LuminanceThatIsExactBecomesExactColors) {
  Image image(2, 2, {"Y", "A"});
  image.exactChannels = {"Y"};
  EXPECT_EQ(Reread(image, true).exactChannels, (Names{"R", "G", "B"}));
  EXPECT_EQ(Reread(Image(2, 2, {"Y", "A"}), false).exactChannels, Names());
}

TEST_F(ExrChannels, APictureOfAllAovsAndHalvesIsReadAndLeavesRoom) {
  std::vector<std::string> channels = ChannelsOfAllAovsAndHalves();
  EXPECT_EQ(Reread(Image(3, 2, channels), true).channels.size(), channels.size());
  EXPECT_LE(2 * int(channels.size()), kMaxImageChannels);
}

TEST_F(ExrChannels, TooManyChannelsAreRefused) {
  std::vector<std::string> channels;
  for (int i = 0; i < kMaxImageChannels; ++i) channels.push_back("layer." + std::to_string(i));
  EXPECT_EQ(Reread(Image(2, 2, channels), false).ChannelCount(), kMaxImageChannels);
  channels.emplace_back("more");
  try {
    Reread(Image(2, 2, channels), false);
    ADD_FAILURE() << "read " << channels.size() << " channels";
  } catch (const ImageError& error) {
    EXPECT_NE(std::string(error.what()).find("more than 256 channels"), std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace exphoton
