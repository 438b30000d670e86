// SPDX-License-Identifier: BSD-2-Clause
// A header is a list of attributes: name, type (each ended by a zero byte), size, value; an empty
// name ends it. A file of several parts has several headers, ended by an empty one (the OpenEXR
// file layout, openexr.com).
#include "core/imaging/exr_sizes.h"

#include <array>
#include <filesystem>
#include <fstream>

#include "core/imaging/image.h"

namespace exphoton {
namespace {

constexpr std::size_t kLongestName = 255;
constexpr std::uint32_t kMagic = 20000630;
constexpr unsigned kMultiPartFlag = 0x1000;

// Deflate makes at most 1032 bytes of one; the lossy methods drop whole blocks besides.
constexpr double kMostInflation = 65536;
constexpr double kAlwaysFine = 1 << 26;

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
  // Little-endian; 0 at the end of the file.
  std::uint32_t Number() {
    std::array<char, 4> bytes{};
    file_.read(bytes.data(), bytes.size());
    std::uint32_t number = 0;
    for (int i = 3; i >= 0; --i)
      number = number << 8 | static_cast<unsigned char>(bytes[std::size_t(i)]);
    return number;
  }

  // Of a name or type, and past its end.
  std::size_t Length() {
    std::size_t length = 0;
    while (length <= kLongestName && file_ && file_.get() > 0) ++length;
    return length;
  }

  // The number of attributes, as far as they can be read.
  int CheckHeader() {
    for (int count = 0;; ++count) {
      if (Length() == 0) return count;
      Length();
      const std::uint32_t bytes = Number();
      if (!file_) return count;
      const std::uint64_t at = std::uint64_t(file_.tellg());
      if (bytes > size_ - at) throw ImageError("an attribute that is longer than the file");
      file_.seekg(std::streamoff(at + bytes));
    }
  }

  std::ifstream file_;
  std::uint64_t size_;
};

}  // namespace

void CheckExrHeaders(const std::string& path) { HeaderWalk(path).Check(); }

void CheckExrPixels(const std::string& path, double pixelBytes) {
  if (pixelBytes <= kAlwaysFine) return;
  if (pixelBytes > kMostInflation * double(std::filesystem::file_size(path)))
    throw ImageError("more pixels than a file of this length can hold");
}

}  // namespace exphoton
