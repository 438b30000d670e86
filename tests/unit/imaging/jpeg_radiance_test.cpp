// SPDX-License-Identifier: BSD-2-Clause
// These tests check JPEG and Radiance HDR files against known values, and damaged files. The JPEG
// files in tests/unit/imaging/files are 16 x 8 pixels of two colours, written by Pillow.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "core/imaging/files/jpeg.h"
#include "core/imaging/files/radiance.h"
#include "core/imaging/files/srgb.h"
#include "tests/support/scattering.h"
#include "tests/support/test_plugin.h"

namespace exphoton {
namespace {

std::string JpegFile(const std::string& name) {
  const std::string path = EXPHOTON_SOURCE_DIR "/tests/unit/imaging/files/" + name + ".jpg";
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

int Encoded(float linear) { return int(std::lround(EncodeSrgb(double(linear)) * 255)); }

std::string MessageOf(Image (*parse)(const std::string&, std::string_view),
                      const std::string& bytes) {
  try {
    parse("a/file", bytes);
  } catch (const ImageError& error) {
    return error.what();
  }
  return "no error";
}

TEST(Jpeg, HasTheColorsOfItsTwoHalves) {
  for (const char* name : {"baseline", "progressive"}) {
    const Image image = ParseJpeg("a", JpegFile(name));
    EXPECT_EQ(image.channels, (std::vector<std::string>{"R", "G", "B"}));
    ASSERT_EQ(image.Width(), 16);
    ASSERT_EQ(image.Height(), 8);
    EXPECT_TRUE(image.isFromSrgb);
    const int left[3] = {200, 60, 20}, right[3] = {30, 90, 180};
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(Encoded(image.At(0, 0, c)), left[c], 1) << name;
      EXPECT_NEAR(Encoded(image.At(7, 7, c)), left[c], 1) << name;
      EXPECT_NEAR(Encoded(image.At(8, 0, c)), right[c], 1) << name;
      EXPECT_NEAR(Encoded(image.At(15, 7, c)), right[c], 1) << name;
    }
  }
}

TEST(Jpeg, InGreyHasThreeEqualChannels) {
  const Image image = ParseJpeg("a", JpegFile("grey"));
  for (int c = 0; c < 3; ++c) EXPECT_EQ(Encoded(image.At(2, 3, c)), 97);
}

TEST(Jpeg, ThatIsTruncatedIsAnErrorThatSaysSo) {
  for (const char* name : {"baseline", "progressive", "grey"}) {
    const std::string good = JpegFile(name);
    // Without the last two bytes, which mark the end, all pixels may be there.
    for (std::size_t size = 3; size + 2 < good.size(); ++size)
      EXPECT_THROW(ParseJpeg("a", good.substr(0, size)), ImageError) << name << " " << size;
    const std::size_t scan = good.rfind("\xff\xda");
    EXPECT_EQ(MessageOf(ParseJpeg, good.substr(0, scan + 12)),
              "a/file: the file ends before its last pixel");
  }
}

TEST(Jpeg, ThatIsDamagedOrOfAnotherKindIsAnErrorThatNamesWhatIsExpected) {
  std::string damaged = JpegFile("baseline");
  damaged[damaged.find("\xff\xc0") + 4] = 12;  // bits
  EXPECT_TRUE(MessageOf(ParseJpeg, damaged)
                  .starts_with("a/file: the JPEG picture is damaged or of an unknown kind; "
                               "expected 8 bits, baseline or progressive ("))
      << MessageOf(ParseJpeg, damaged);
  EXPECT_EQ(MessageOf(ParseJpeg, JpegFile("cmyk")),
            "a/file: JPEG pictures in CMYK are not read; convert the picture to RGB");
}

TEST(Jpeg, OfMorePixelsThanTheLimitIsRefusedBeforeMemoryIsAllocated) {
  std::string large = JpegFile("baseline");
  const std::size_t size = large.find("\xff\xc0") + 5;
  large[size] = large[size + 2] = 0x4e;  // 20,000 x 20,000, about
  EXPECT_EQ(MessageOf(ParseJpeg, large), "a/file: more than 2^28 pixels");
  large[size] = large[size + 2] = 0x3f;  // 16,000 x 16,000, about
  EXPECT_EQ(MessageOf(ParseJpeg, large), "a/file: the file ends before its last pixel");
}

constexpr const char* kHdrHeader = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n";

std::string Hdr(const std::string& header, std::initializer_list<int> bytes) {
  std::string text = header;
  for (const int byte : bytes) text += char(byte);
  return text;
}

// The first row is (.25, 2, 100), the second (1, .5, 0). OpenImageIO wrote these bytes.
const std::string& PlainHdr() {
  static const std::string text =
      Hdr(std::string(kHdrHeader) + "\n-Y 2 +X 2\n",
          {0, 4, 200, 135, 0, 4, 200, 135, 128, 64, 0, 129, 128, 64, 0, 129});
  return text;
}
const std::string& RunLengthHdr() {
  static const std::string text = Hdr(std::string(kHdrHeader) + "\n-Y 2 +X 9\n",
                                      {2, 2, 0, 9, 137, 0,   137, 4,  137, 200, 137, 135,
                                       2, 2, 0, 9, 137, 128, 137, 64, 137, 0,   137, 129});
  return text;
}

TEST(Radiance, HasTheValuesOfPlainAndRunLengthEncodedRows) {
  for (const std::string& bytes : {PlainHdr(), RunLengthHdr()}) {
    const Image image = ParseRadiance("a", bytes);
    EXPECT_FALSE(image.isFromSrgb);
    const int last = image.Width() - 1;
    // A green of 4 with the exponent 135 is 2; a red of 0 is 0.
    EXPECT_EQ(image.At(last, 0, 0), 0);
    EXPECT_EQ(image.At(last, 0, 1), 2);
    EXPECT_EQ(image.At(last, 0, 2), 100);
    EXPECT_EQ(image.At(0, 1, 0), 1);
    EXPECT_EQ(image.At(last, 1, 1), .5f);
    EXPECT_EQ(image.At(last, 1, 2), 0);
  }
}

TEST(Radiance, HasLiteralBytesAndRunsOfWholePixels) {
  const std::string literal =
      Hdr(std::string(kHdrHeader) + "\n-Y 1 +X 8\n",
          {2, 2, 0, 8, 8, 10, 20, 30, 40, 50, 60, 70, 80, 136, 7, 136, 9, 136, 136});
  const Image image = ParseRadiance("a", literal);
  for (int x = 0; x < 8; ++x) EXPECT_EQ(image.At(x, 0, 0), float(10 + 10 * x));
  EXPECT_EQ(image.At(5, 0, 1), 7);
  EXPECT_EQ(image.At(5, 0, 2), 9);
  const Image old = ParseRadiance("a", Hdr(std::string(kHdrHeader) + "\n-Y 1 +X 5\n",
                                           {10, 20, 30, 136, 1, 1, 1, 3, 40, 50, 60, 136}));
  EXPECT_EQ(old.At(3, 0, 1), 20);
  EXPECT_EQ(old.At(4, 0, 1), 50);
  // One more, and 256 times one more.
  const Image far =
      ParseRadiance("a", Hdr(std::string(kHdrHeader) + "\n-Y 1 +X 259\n",
                             {10, 20, 30, 136, 1, 1, 1, 1, 1, 1, 1, 1, 40, 50, 60, 136}));
  EXPECT_EQ(far.At(257, 0, 1), 20);
  EXPECT_EQ(far.At(258, 0, 1), 50);
}

TEST(Radiance, HeedsExposureAndTheDirectionOfRowsAndColumns) {
  std::string text = PlainHdr();
  text.insert(std::string(kHdrHeader).size(), "EXPOSURE=4\nEXPOSURE= .5\nSOFTWARE=x\n");
  EXPECT_EQ(ParseRadiance("a", text).At(0, 0, 2), 50);
  text = PlainHdr();
  text.replace(text.find("-Y"), 9, "+Y 2 -X 2");
  EXPECT_EQ(ParseRadiance("a", text).At(0, 1, 2), 100);
  text = Hdr(std::string(kHdrHeader) + "\n-Y 1 -X 2\n", {1, 2, 3, 136, 4, 5, 6, 136});
  EXPECT_EQ(ParseRadiance("a", text).At(0, 0, 0), 4);
}

TEST(Radiance, ThatIsTruncatedIsAnError) {
  for (const std::string& good : {PlainHdr(), RunLengthHdr()}) {
    EXPECT_NO_THROW(ParseRadiance("a", good));
    for (std::size_t size = 1; size < good.size(); ++size)
      EXPECT_THROW(ParseRadiance("a", good.substr(0, size)), ImageError) << size;
    EXPECT_EQ(MessageOf(ParseRadiance, good.substr(0, good.size() - 1)),
              "a/file: the file ends before its last pixel");
  }
}

TEST(Radiance, ThatIsDamagedIsAnErrorThatNamesWhatIsExpected) {
  const auto says = [](const std::string& bytes) { return MessageOf(ParseRadiance, bytes); };
  EXPECT_EQ(says("#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\n1234"),
            "a/file: HDR files with FORMAT=32-bit_rle_xyze are not read; expected "
            "FORMAT=32-bit_rle_rgbe");
  const std::string noSize =
      "a/file: the HDR file has no size of its picture; expected \"-Y height "
      "+X width\"";
  for (const char* size : {"+X 1 -Y 1", "-Y 0 +X 1", "-Y 1", "", "-Y x +X 1", "-Y -1 +X 1"})
    EXPECT_EQ(says(std::string(kHdrHeader) + "\n" + size + "\n1234"), noSize) << size;
  EXPECT_EQ(says(std::string(kHdrHeader) + "\n-Y 100000 +X 100000\n1234"),
            "a/file: more than 2^28 pixels");
  EXPECT_EQ(says(std::string(kHdrHeader) + "EXPOSURE=0\n\n-Y 1 +X 1\n1234"),
            "a/file: the EXPOSURE of an HDR file must be a number above 0");
  EXPECT_EQ(says(std::string(kHdrHeader) + "\n-Y 1 +X 9\n" + std::string("\2\2\0\10", 4)),
            "a/file: a row of the HDR file is not as wide as the picture");
  EXPECT_EQ(says(Hdr(std::string(kHdrHeader) + "\n-Y 1 +X 9\n", {2, 2, 0, 9, 138, 0, 0, 0})),
            "a/file: a run of the HDR file is longer than its row, or empty");
  EXPECT_EQ(says(Hdr(std::string(kHdrHeader) + "\n-Y 1 +X 9\n", {2, 2, 0, 9, 0, 0, 0, 0})),
            "a/file: a run of the HDR file is longer than its row, or empty");
  EXPECT_EQ(says(Hdr(std::string(kHdrHeader) + "\n-Y 1 +X 2\n", {1, 1, 1, 2, 0, 0, 0, 0})),
            "a/file: a run of the HDR file is longer than its row, or its first pixel");
}

TEST(PlainFormats, OfJpegAreTexturesInSrgbUnlessGammaIsGiven) {
  TestPlugins plugins;
  const auto texel = [&](const std::string& parameters) {
    return plugins
        .MakeColorTexture("\"imagemap\" \"string filename\" \"" EXPHOTON_SOURCE_DIR
                          "/tests/unit/imaging/files/baseline.jpg\"" +
                          parameters)
        ->Evaluate(FlatSurface());  // in the left half
  };
  EXPECT_NEAR(texel("").r, DecodeSrgb(200 / 255.), .01);
  EXPECT_NEAR(texel(" \"float gamma\" 1").r, 200 / 255., .01);
}

TEST(PlainFormats, OfRadianceAreLinearMapsOfLights) {
  const std::string path = testing::TempDir() + "exphoton-sky.hdr";
  std::ofstream(path, std::ios::binary) << RunLengthHdr();
  TestPlugins plugins;
  const auto light = plugins.MakeLight("\"infinite\" \"string mapname\" \"" + path + "\"", {});
  light->Prepare({{}, 1});
  // A quarter of the way down, the top row of two counts alone.
  const Vector3 up = Normalize(Vector3(1, 0, 1));
  EXPECT_NEAR(light->Le(up).b, 100, 1);
  EXPECT_NEAR(light->Le(up).g, 2, .02);
  EXPECT_NEAR(light->Le({up.x, 0, -up.z}).r, 1, .01);
}

TEST(PlainFormats, OfJpegAndRadianceAreRecognisedByTheirFirstBytes) {
  const std::filesystem::path path =
      std::filesystem::path(testing::TempDir()) / "exphoton-any.picture";
  const auto read = [&](const std::string& bytes) {
    std::ofstream(path, std::ios::binary) << bytes;
    return ReadImage(path.string());
  };
  EXPECT_EQ(read(PlainHdr()).At(0, 0, 2), 100);
  EXPECT_EQ(Encoded(read(JpegFile("grey")).At(2, 3, 0)), 97);
  EXPECT_THROW(read("GIF89a" + PlainHdr()), ImageError);
}

}  // namespace
}  // namespace exphoton
