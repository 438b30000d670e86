// SPDX-License-Identifier: BSD-2-Clause
// These tests check OpenEXR files: round trips, windows, AOV channels, attributes, atomic writing,
// and refusal of bad files.
#include "core/imaging/files/exr.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <bit>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "core/base/error.h"
#include "core/math/sampling/random.h"

namespace exphoton {
namespace {

namespace fs = std::filesystem;

// ExrTest provides a folder that is removed after the test.
class ExrTest : public testing::Test {
 protected:
  ExrTest() {
    std::string name = (fs::temp_directory_path() / "exphoton-exr-XXXXXX").string();
    folder_ = mkdtemp(name.data());
  }
  ~ExrTest() override { fs::remove_all(folder_); }
  std::string Path(const std::string& name) const { return (folder_ / name).string(); }
  std::size_t FileCount() const {
    return std::size_t(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
  }
  static std::string Bytes(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  static void WriteBytes(const std::string& path, const std::string& bytes) {
    std::ofstream(path, std::ios::binary) << bytes;
  }

  fs::path folder_;
};

Image RandomImage(PixelBounds data, PixelBounds display, std::vector<std::string> channels) {
  Image image(data, display, std::move(channels));
  RandomStream random(7);
  for (float& v : image.pixels) v = float(random.Uniform() * 1000 - 500);
  return image;
}

void ExpectSameBits(const Image& a, const Image& b) {
  ASSERT_EQ(a.data, b.data);
  ASSERT_EQ(a.channels.size(), b.channels.size());
  for (int c = 0; c < a.ChannelCount(); ++c) {
    const int other = b.FindChannel(a.channels[std::size_t(c)]);
    ASSERT_GE(other, 0) << a.channels[std::size_t(c)];
    for (int y = 0; y < a.Height(); ++y)
      for (int x = 0; x < a.Width(); ++x)
        ASSERT_EQ(std::bit_cast<unsigned>(a.At(x, y, c)),
                  std::bit_cast<unsigned>(b.At(x, y, other)));
  }
}

TEST_F(ExrTest, FloatsComeBackBitForBit) {
  Image image = RandomImage({0, 0, 37, 53}, {0, 0, 37, 53}, {"R", "G", "B", "A"});
  image.pixels[5] = std::numeric_limits<float>::quiet_NaN();
  image.pixels[6] = std::numeric_limits<float>::infinity();
  image.pixels[7] = 1e-45f;
  image.pixels[8] = -0.f;
  image.pixels[9] = 1e6f;
  WriteExr(Path("a.exr"), image, false);
  const Image read = ReadExr(Path("a.exr"));
  EXPECT_EQ(read.channels, image.channels);
  ExpectSameBits(image, read);
  EXPECT_EQ(FileCount(), 1u);
}

TEST_F(ExrTest, EqualImagesGiveEqualBytes) {
  const Image image = RandomImage({0, 0, 20, 20}, {0, 0, 20, 20}, {"R", "G", "B", "A"});
  WriteExr(Path("a.exr"), image, true);
  WriteExr(Path("b.exr"), image, true);
  EXPECT_EQ(Bytes(Path("a.exr")), Bytes(Path("b.exr")));
}

TEST_F(ExrTest, ACropWindowIsTheDataWindow) {
  const Image image = RandomImage({60, 31, 97, 64}, {0, 0, 300, 200}, {"R", "G", "B", "A"});
  WriteExr(Path("a.exr"), image, false);
  const Image read = ReadExr(Path("a.exr"));
  EXPECT_EQ(read.display, (PixelBounds{0, 0, 300, 200}));
  ExpectSameBits(image, read);
}

TEST_F(ExrTest, LayersKeepTheirNames) {
  const Image image =
      RandomImage({0, 0, 5, 40}, {0, 0, 5, 40}, {"R", "G", "B", "A", "albedo.R", "N.X", "time.ms"});
  WriteExr(Path("a.exr"), image, false);
  ExpectSameBits(image, ReadExr(Path("a.exr")));
}

TEST_F(ExrTest, AttributesComeBack) {
  Image image(2, 2, {"R", "G", "B"});
  image.attributes["software"] = std::string("a renderer");
  image.attributes["seed"] = 17;
  image.attributes["renderTimeSeconds"] = 1.5f;
  image.attributes["time/photon maps"] = .25f;
  image.attributes["chromaticities"] =
      std::vector<float>{.64f, .33f, .3f, .6f, .15f, .06f, .3127f, .329f};
  std::vector<float> matrix(16);
  for (std::size_t i = 0; i < 16; ++i) matrix[i] = float(i);
  image.attributes["worldToCamera"] = matrix;
  image.attributes["aNameOfMoreThanThirtyOneCharacters"] = std::string();
  WriteExr(Path("a.exr"), image, true);
  EXPECT_EQ(ReadExr(Path("a.exr")).attributes, image.attributes);
}

TEST_F(ExrTest, ExactChannelsKeepAllTheirBits) {
  Image image = RandomImage({3, 5, 8, 45}, {0, 0, 50, 50}, {"R", "G", "B", "A", "Z", "N.X"});
  image.exactChannels = {"Z"};
  for (int y = 0; y < image.Height(); ++y) image.At(1, y, 4) = 100001.f + float(y);
  EXPECT_EQ(WriteExr(Path("a.exr"), image, true).clampedToHalf, 0);
  const Image read = ReadExr(Path("a.exr"));
  for (int y = 0; y < image.Height(); ++y) {
    for (int x = 0; x < image.Width(); ++x) {
      ASSERT_EQ(read.At(x, y, read.FindChannel("Z")), image.At(x, y, 4));
      ASSERT_NEAR(read.At(x, y, read.FindChannel("N.X")) / image.At(x, y, 5), 1, .001);
      ASSERT_NEAR(read.At(x, y, 1) / image.At(x, y, 1), 1, .001);
    }
  }
}

TEST_F(ExrTest, HalvesAreClampedAndCountedButNanIsKept) {
  Image image(4, 1, {"R", "G"});
  image.pixels = {1e6f,
                  -1e6f,
                  65504,
                  0.5f,
                  std::numeric_limits<float>::infinity(),
                  65505,
                  std::numeric_limits<float>::quiet_NaN(),
                  -65504};
  EXPECT_EQ(WriteExr(Path("a.exr"), image, true).clampedToHalf, 4);
  const Image read = ReadExr(Path("a.exr"));
  const std::vector<float> expected = {65504, -65504, 65504, 0.5f, 65504, 65504};
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_EQ(read.pixels[i], expected[i]);
  EXPECT_TRUE(std::isnan(read.pixels[6]));
  EXPECT_EQ(read.pixels[7], -65504);
}

TEST_F(ExrTest, LuminanceBecomesRgb) {
  Image image(3, 2, {"Y"});
  for (std::size_t i = 0; i < 6; ++i) image.pixels[i] = float(i);
  WriteExr(Path("a.exr"), image, true);
  const Image read = ReadImage(Path("a.exr"));
  EXPECT_EQ(read.channels, (std::vector<std::string>{"R", "G", "B"}));
  for (int c = 0; c < 3; ++c) EXPECT_EQ(read.At(2, 1, c), 5);
}

TEST_F(ExrTest, AFailedWriteLeavesTheOldFileAndNoOther) {
  const Image image = RandomImage({0, 0, 200, 200}, {0, 0, 200, 200}, {"R", "G", "B", "A"});
  WriteBytes(Path("a.exr"), "old");
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit before;
  getrlimit(RLIMIT_FSIZE, &before);
  for (rlim_t bytes : {rlim_t(0), rlim_t(100), rlim_t(20000), rlim_t(100000)}) {
    const rlimit limit{bytes, before.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
    for (bool asHalf : {false, true}) {
      try {
        WriteExr(Path("a.exr"), image, asHalf);
        ADD_FAILURE() << "no error at a limit of " << bytes;
      } catch (const Error& error) {
        EXPECT_EQ(error.Status(), ExitStatus::File);
        EXPECT_NE(std::string(error.what()).find("a.exr"), std::string::npos);
      }
    }
    setrlimit(RLIMIT_FSIZE, &before);
    EXPECT_EQ(Bytes(Path("a.exr")), "old");
    EXPECT_EQ(FileCount(), 1u);
  }
}

TEST_F(ExrTest, UnwritableTargetsAreFileErrors) {
  const Image image(2, 2, {"R", "G", "B"});
  fs::create_directory(Path("folder"));
  for (const std::string& path : {Path("missing/a.exr"), Path("folder"), std::string("/dev/full"),
                                  Path(std::string(300, 'x') + ".exr")}) {
    try {
      WriteExr(path, image, true);
      ADD_FAILURE() << path;
    } catch (const Error& error) {
      EXPECT_EQ(error.Status(), ExitStatus::File);
    }
  }
  EXPECT_EQ(FileCount(), 1u);
}

TEST_F(ExrTest, ALinkIsFollowed) {
  WriteBytes(Path("real.exr"), "old");
  fs::create_symlink(Path("real.exr"), Path("link.exr"));
  WriteExr(Path("link.exr"), Image(2, 2, {"R", "G", "B"}), true);
  EXPECT_TRUE(fs::is_symlink(Path("link.exr")));
  EXPECT_EQ(ReadExr(Path("real.exr")).Width(), 2);
}

TEST_F(ExrTest, BadFilesAreErrorsThatNameThem) {
  WriteExr(Path("good.exr"), RandomImage({0, 0, 64, 64}, {0, 0, 64, 64}, {"R", "G", "B"}), false);
  const std::string good = Bytes(Path("good.exr"));
  std::vector<std::string> contents = {"", "x", "no picture at all", std::string(1000, '\0')};
  for (std::size_t i = 1; i < 16; ++i) contents.push_back(good.substr(0, good.size() * i / 16));
  for (std::size_t i = 4; i < 400; i += 13) contents.push_back(good.substr(0, i));
  for (const std::string& bytes : contents) {
    WriteBytes(Path("bad.exr"), bytes);
    try {
      ReadImage(Path("bad.exr"));
      ADD_FAILURE() << bytes.size() << " bytes were read";
    } catch (const ImageError& error) {
      EXPECT_NE(std::string(error.what()).find("bad.exr"), std::string::npos) << error.what();
    }
  }
  EXPECT_THROW(ReadImage(Path("missing.exr")), ImageError);
  EXPECT_THROW(ReadImage(folder_.string()), ImageError);
}

TEST_F(ExrTest, AHugeDataWindowIsRefusedBeforeAllocating) {
  WriteExr(Path("good.exr"), Image(64, 64, {"R", "G", "B"}), false);
  std::string bytes = Bytes(Path("good.exr"));
  const std::size_t at = bytes.find("dataWindow");
  ASSERT_NE(at, std::string::npos);
  const std::size_t box = at + std::string("dataWindow").size() + 1 + sizeof("box2i") + 4;
  const auto put = [&](std::size_t index, std::int32_t v) {
    for (std::size_t i = 0; i < 4; ++i)
      bytes[box + 4 * index + i] = char(std::uint32_t(v) >> (8 * i) & 255);
  };
  for (std::int32_t size : {1 << 20, 1 << 29, 0x7fffffff, -5}) {
    put(2, size);
    put(3, size);
    WriteBytes(Path("bad.exr"), bytes);
    EXPECT_THROW(ReadExr(Path("bad.exr")), ImageError) << size;
  }
}

// The files state a size of 2 GB in a few hundred bytes, or a number of pixels that only a larger
// file can hold.
TEST_F(ExrTest, SizesThatTheFileCannotHoldAreRefusedBeforeAllocating) {
  Image image(16, 16, {"R"});
  image.attributes["comments"] = std::string("words");
  WriteExr(Path("good.exr"), image, false);
  const std::string good = Bytes(Path("good.exr"));
  const auto read = [&](const std::string& after, std::size_t skip, std::uint32_t value) {
    std::string bytes = good;
    const std::size_t at = bytes.find(after) + after.size() + skip;
    for (std::size_t i = 0; i < 4; ++i) bytes[at + i] = char(value >> (8 * i) & 255);
    WriteBytes(Path("bad.exr"), bytes);
    return ReadExr(Path("bad.exr"));
  };
  const std::string comments("comments\0string\0", 16);
  EXPECT_NO_THROW(read(comments, 0, 5));
  for (const std::uint32_t size : {std::uint32_t(good.size()), 0x7fffffffu, 0xffffffffu})
    EXPECT_THROW(read(comments, 0, size), ImageError) << size;
  const std::string window("dataWindow\0box2i\0", 17);
  EXPECT_THROW(read(window, 4 + 8, (1u << 28) - 1), ImageError);
}

// Bits are flipped anywhere. The result must be an error or a picture, never a crash.
TEST_F(ExrTest, DamagedFilesAreRefusedOrReadAsWhole) {
  WriteExr(Path("good.exr"), RandomImage({0, 0, 16, 16}, {0, 0, 16, 16}, {"R", "G", "B"}), true);
  const std::string good = Bytes(Path("good.exr"));
  RandomStream random(3);
  int read = 0, sameSize = 0;
  for (int i = 0; i < 300; ++i) {
    std::string bad = good;
    bad[std::size_t(random.Bits() % 500)] ^= char(1 << random.Bits() % 8);
    WriteBytes(Path("bad.exr"), bad);
    try {
      const Image image = ReadImage(Path("bad.exr"));
      ++read;
      EXPECT_EQ(image.pixels.size(),
                std::size_t(image.Width()) * std::size_t(image.Height()) * image.channels.size());
      sameSize += image.Width() == 16 && image.Height() == 16;
    } catch (const ImageError&) {
    }
  }
  EXPECT_GT(read, 0);
  EXPECT_LT(read, 300);
  EXPECT_GE(sameSize, read - 3) << "of " << read;  // few of the flipped bits belong to the window
}

}  // namespace
}  // namespace exphoton
