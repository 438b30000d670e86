// SPDX-License-Identifier: BSD-2-Clause
// These tests check TGA and PFM files: all kinds of pixels, both orders of rows, run-length codes,
// byte orders, and damaged files.
#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <fstream>

#include "core/imaging/files/pfm.h"
#include "core/imaging/files/srgb.h"
#include "core/imaging/files/tga.h"
#include "core/imaging/image.h"

namespace exphoton {
namespace {

std::string TgaHeader(int type, int width, int height, int bits, int flags = 0) {
  std::string header(18, '\0');
  header[2] = char(type);
  header[12] = char(width & 255), header[13] = char(width >> 8);
  header[14] = char(height & 255), header[15] = char(height >> 8);
  header[16] = char(bits);
  header[17] = char(flags);
  return header;
}
std::string Bytes(std::initializer_list<int> values) {
  std::string text;
  for (const int value : values) text += char(value);
  return text;
}
float Linear(int byte) { return float(DecodeSrgb(byte / 255.)); }

TEST(Tga, OfColorsBeginsWithTheLowestRow) {
  const Image image = ParseTga("a.tga", TgaHeader(2, 1, 2, 24) + Bytes({10, 20, 30, 40, 50, 60}));
  EXPECT_EQ(image.channels, (std::vector<std::string>{"R", "G", "B"}));
  EXPECT_EQ(image.At(0, 1, 0), Linear(30));
  EXPECT_EQ(image.At(0, 1, 2), Linear(10));
  EXPECT_EQ(image.At(0, 0, 1), Linear(50));
  EXPECT_TRUE(image.isFromSrgb);
  // Bit 5 of the flags: the highest row comes first; bit 4: the right column.
  const Image turned =
      ParseTga("a.tga", TgaHeader(2, 2, 1, 24, 48) + Bytes({10, 20, 30, 40, 50, 60}));
  EXPECT_EQ(turned.At(1, 0, 0), Linear(30));
  EXPECT_EQ(turned.At(0, 0, 0), Linear(60));
}

TEST(Tga, HasGreyAlphaAndFifteenBits) {
  const Image grey = ParseTga("a.tga", TgaHeader(3, 2, 1, 8) + Bytes({0, 200}));
  for (int c = 0; c < 3; ++c) EXPECT_EQ(grey.At(1, 0, c), Linear(200));
  const Image alpha = ParseTga("a.tga", TgaHeader(2, 1, 1, 32, 8) + Bytes({1, 2, 3, 51}));
  ASSERT_EQ(alpha.ChannelCount(), 4);
  EXPECT_FLOAT_EQ(alpha.At(0, 0, 3), .2f);
  EXPECT_EQ(alpha.At(0, 0, 0), Linear(3));
  EXPECT_TRUE(alpha.hasStraightAlpha);
  EXPECT_FALSE(grey.hasStraightAlpha);
  const Image five = ParseTga("a.tga", TgaHeader(2, 1, 1, 16) + Bytes({31, 124}));
  EXPECT_EQ(five.At(0, 0, 0), 1);
  EXPECT_EQ(five.At(0, 0, 1), 0);
  EXPECT_EQ(five.At(0, 0, 2), 1);
}

TEST(Tga, HasColorMapsAndRuns) {
  std::string header = TgaHeader(1, 2, 1, 8);
  header[1] = 1;   // a colour map
  header[3] = 5;   // its first index
  header[5] = 2;   // its length
  header[7] = 24;  // bits of a colour
  const std::string map = Bytes({1, 2, 3, 4, 5, 6});
  const Image mapped = ParseTga("a.tga", header + map + Bytes({6, 5}));
  EXPECT_EQ(mapped.At(0, 0, 0), Linear(6));
  EXPECT_EQ(mapped.At(1, 0, 0), Linear(3));
  EXPECT_THROW(ParseTga("a.tga", header + map + Bytes({7, 5})), ImageError);
  header[7] = 15;  // two bytes
  const Image five = ParseTga("a.tga", header + Bytes({31, 0, 0, 124}) + Bytes({6, 5}));
  EXPECT_EQ(five.At(0, 0, 0), 1);  // red
  EXPECT_EQ(five.At(0, 0, 2), 0);
  EXPECT_EQ(five.At(1, 0, 0), 0);
  EXPECT_EQ(five.At(1, 0, 2), 1);  // blue
  // Three equal pixels, then two others.
  const Image runs = ParseTga("a.tga", TgaHeader(11, 5, 1, 8) + Bytes({130, 9, 1, 20, 30}));
  const int expected[] = {9, 9, 9, 20, 30};
  for (int x = 0; x < 5; ++x) EXPECT_EQ(runs.At(x, 0, 0), Linear(expected[x])) << x;
}

TEST(Tga, ThatIsDamagedIsAnError) {
  const std::string good =
      TgaHeader(10, 3, 2, 24) + Bytes({130, 1, 2, 3, 2, 1, 2, 3, 4, 5, 6, 7, 8, 9});
  EXPECT_NO_THROW(ParseTga("a.tga", good));
  for (std::size_t size = 0; size < good.size(); ++size)
    EXPECT_THROW(ParseTga("a.tga", good.substr(0, size)), ImageError) << size;
  for (const int type : {0, 4, 32}) {
    const std::string other = TgaHeader(type, 1, 1, 24) + "abc";
    EXPECT_THROW(ParseTga("a.tga", other), ImageError) << type;
  }
  EXPECT_THROW(ParseTga("a.tga", TgaHeader(2, 1, 1, 12) + "abc"), ImageError);
  EXPECT_THROW(ParseTga("a.tga", TgaHeader(2, 0, 1, 24)), ImageError);
  // A header may promise more pixels than the file can hold.
  EXPECT_THROW(ParseTga("a.tga", TgaHeader(2, 65535, 65535, 32)), ImageError);
  EXPECT_THROW(ParseTga("a.tga", TgaHeader(10, 16384, 16384, 32) + "abc"), ImageError);
}

std::string FloatBytes(std::initializer_list<float> values, bool isSwapped = false) {
  std::string text;
  for (const float value : values) {
    char bytes[4];
    std::memcpy(bytes, &value, 4);
    if (isSwapped) std::swap(bytes[0], bytes[3]), std::swap(bytes[1], bytes[2]);
    text.append(bytes, 4);
  }
  return text;
}

TEST(Pfm, HasColorsAndGreyInBothByteOrders) {
  const Image color = ParsePfm("a", "PF\n1 2\n-1.0\n" + FloatBytes({1, 2, 3, 40, 50, 60}));
  EXPECT_EQ(color.At(0, 1, 2), 3);
  EXPECT_EQ(color.At(0, 0, 0), 40);
  EXPECT_FALSE(color.isFromSrgb);
  const Image grey = ParsePfm("a", "Pf 2 1 2.0\n" + FloatBytes({.5f, 7}, true));
  for (int c = 0; c < 3; ++c) EXPECT_EQ(grey.At(1, 0, c), 14);
}

TEST(Pfm, ThatIsDamagedIsAnError) {
  const std::string good = "PF\n1 1\n-1\n" + FloatBytes({1, 2, 3});
  EXPECT_NO_THROW(ParsePfm("a", good));
  for (std::size_t size = 2; size < good.size(); ++size)
    EXPECT_THROW(ParsePfm("a", good.substr(0, size)), ImageError) << size;
  for (const char* bad : {"PF\n0 1\n-1\n", "PF\n1 1\n0\n", "PF\n1 1\nnan\n", "PF\nx 1\n-1\n",
                          "PF\n2000000000 2000000000\n-1\n"})
    EXPECT_THROW(ParsePfm("a", bad + std::string(12, '\0')), ImageError) << bad;
}

TEST(PlainFormats, AreRecognised) {
  const std::filesystem::path folder = testing::TempDir();
  const auto read = [&](const std::string& name, const std::string& bytes) {
    const std::string path = (folder / name).string();
    std::ofstream(path, std::ios::binary) << bytes;
    return ReadImage(path).At(0, 0, 0);
  };
  const std::string tga = TgaHeader(3, 1, 1, 8) + Bytes({200});
  EXPECT_EQ(read("exphoton-a.TGA", tga), Linear(200));
  EXPECT_EQ(read("exphoton-a.picture",
                 tga + std::string(8, '\0') + std::string("TRUEVISION-XFILE.\0", 18)),
            Linear(200));
  EXPECT_EQ(read("exphoton-b.picture", "Pf 1 1 -1\n" + FloatBytes({3})), 3);
  EXPECT_THROW(read("exphoton-c.picture", tga), ImageError);
}

}  // namespace
}  // namespace exphoton
