// SPDX-License-Identifier: BSD-2-Clause
// Walks the headers of an OpenEXR file. A header is a list of attributes: name and type (both
// zero-terminated), size, value. An empty name ends the list. A multi-part file has several
// headers, and an empty header ends them. Source: the OpenEXR file layout, openexr.com.
#include "core/imaging/files/exr_sizes.h"

#include <array>
#include <filesystem>
#include <fstream>
#include <string_view>

#include "core/imaging/image.h"

namespace exphoton {
namespace {

constexpr std::size_t kMaxExrNameLength = 255;
constexpr std::uint32_t kMagic = 20000630;
constexpr unsigned kMultiPartFlag = 0x1000;

// Deflate expands a byte to at most 1032 bytes. The lossy methods also drop whole blocks.
constexpr double kMaxExrInflation = 65536;
constexpr double kAlwaysFine = 1 << 26;

// Attribute types of fixed size. The library reads this number of bytes, whatever size the file
// states.
struct FixedType {
  std::string_view name;
  std::uint32_t bytes;
};
constexpr FixedType kFixedTypes[] = {{"box2i", 16},      {"box2f", 16},    {"chromaticities", 32},
                                     {"compression", 1}, {"double", 8},    {"envmap", 1},
                                     {"float", 4},       {"int", 4},       {"keycode", 28},
                                     {"m33f", 36},       {"m44f", 64},     {"m33d", 72},
                                     {"m44d", 128},      {"v2i", 8},       {"v2f", 8},
                                     {"v2d", 16},        {"v3i", 12},      {"v3f", 12},
                                     {"v3d", 24},        {"lineOrder", 1}, {"rational", 8},
                                     {"tiledesc", 9},    {"timecode", 8},  {"deepImageState", 1}};

class HeaderWalk {
 public:
  explicit HeaderWalk(const std::string& path)
      : file_(path, std::ios::binary), size_(std::filesystem::file_size(path)) {
    file_.exceptions(std::ios::badbit);
  }

  void Check() {
    if (Number() != kMagic) throw ImageError("not an OpenEXR file");
    const bool hasParts = Number() & kMultiPartFlag;
    while (CheckHeader() > 0 && hasParts && file_) {
    }
  }

 private:
  [[noreturn]] static void Fail() { throw ImageError("an attribute of a wrong size"); }

  // Reads a little-endian number; 0 at the end of the file.
  std::uint32_t Number() {
    std::array<char, 4> bytes{};
    file_.read(bytes.data(), bytes.size());
    std::uint32_t number = 0;
    for (int i = 3; i >= 0; --i)
      number = number << 8 | static_cast<unsigned char>(bytes[std::size_t(i)]);
    return number;
  }

  // Reads a zero-terminated name or type and skips the zero byte.
  std::string Text() {
    std::string text;
    for (int c; text.size() <= kMaxExrNameLength && (c = file_.get()) > 0;) text.push_back(char(c));
    return text;
  }

  std::uint64_t Position() { return std::uint64_t(file_.tellg()); }

  // Checks one header. Returns the number of attributes that could be read.
  int CheckHeader() {
    for (int count = 0;; ++count) {
      if (Text().empty()) return count;
      const std::string type = Text();
      const std::uint32_t bytes = Number();
      if (!file_) return count;
      const std::uint64_t end = Position() + bytes;
      if (end > size_) Fail();
      CheckValue(type, bytes, end);
      file_.seekg(std::streamoff(end));
    }
  }

  void CheckValue(const std::string& type, std::uint32_t bytes, std::uint64_t end) {
    for (const FixedType& fixed : kFixedTypes)
      if (type == fixed.name && bytes != fixed.bytes) Fail();
    if (type == "chlist") {
      constexpr int kChannelBytes = 16;
      while (!Text().empty()) file_.seekg(kChannelBytes, std::ios::cur);
      if (!file_ || Position() != end) Fail();
    } else if (type == "stringvector") {
      while (file_ && Position() < end) {
        const std::uint64_t length = Number();
        if (!file_ || length > end - Position()) Fail();
        file_.seekg(std::streamoff(length), std::ios::cur);
      }
    } else if (type == "preview") {
      const std::uint64_t width = Number(), height = Number();
      if (bytes < 8 || width * height != (bytes - 8) / 4) Fail();
    }
  }

  std::ifstream file_;
  std::uint64_t size_;
};

}  // namespace

void CheckExrHeaders(const std::string& path) { HeaderWalk(path).Check(); }

void CheckExrPixels(const std::string& path, double pixelBytes) {
  if (pixelBytes <= kAlwaysFine) return;
  if (pixelBytes > kMaxExrInflation * double(std::filesystem::file_size(path)))
    throw ImageError("more pixels than a file of this length can hold");
}

}  // namespace exphoton
