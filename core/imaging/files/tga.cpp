// SPDX-License-Identifier: BSD-2-Clause
// ParseTga: the header, the colour map, and a stream of plain or repeated pixels. The size that the
// header promises is compared with the bytes that follow before any pixel is allocated.
#include "core/imaging/files/tga.h"

#include <algorithm>
#include <array>
#include <cstdint>

#include "core/imaging/files/srgb.h"

namespace exphoton {
namespace {

constexpr std::size_t kTgaHeaderSize = 18;
constexpr std::string_view kTgaSignature{"TRUEVISION-XFILE.\0", 18};

struct TgaHeader {
  int idLength, mapType, imageType;
  int mapFirst, mapCount, mapBits;
  int width, height, bits, flags;

  bool IsEncoded() const { return imageType >= 9; }
  bool IsMapped() const { return (imageType & 7) == 1; }
  bool IsGrey() const { return (imageType & 7) == 3; }
  int PixelBytes() const { return (bits + 7) / 8; }
  // The number of bits that one colour has: of the map, or of a pixel.
  int ColorBits() const { return IsMapped() ? mapBits : bits; }
  bool HasAlpha() const { return !IsGrey() && ColorBits() == 32 && (IsMapped() || (flags & 15)); }
};

[[noreturn]] void FailTga(const std::string& path, const std::string& text) {
  throw ImageError(path + ": " + text);
}

TgaHeader ReadTgaHeader(const std::string& path, std::string_view bytes) {
  if (bytes.size() < kTgaHeaderSize) FailTga(path, "a TGA file needs a header of 18 bytes");
  const auto byte = [&](std::size_t i) { return int(static_cast<unsigned char>(bytes[i])); };
  const auto word = [&](std::size_t i) { return byte(i) + 256 * byte(i + 1); };
  const TgaHeader header{byte(0), byte(1),  byte(2),  word(3),  word(5),
                         byte(7), word(12), word(14), byte(16), byte(17)};
  constexpr int kTypes[] = {1, 2, 3, 9, 10, 11};
  if (std::find(std::begin(kTypes), std::end(kTypes), header.imageType) == std::end(kTypes))
    FailTga(path, "TGA pictures of type " + std::to_string(header.imageType) + " are not read");
  if (header.width == 0 || header.height == 0) FailTga(path, "the TGA picture has no pixels");
  CheckPixelCount(path, header.width, header.height);
  const int pixel = header.bits;
  const bool isKnown = header.IsMapped() ? pixel == 8 || pixel == 16
                       : header.IsGrey() ? pixel == 8
                                         : pixel == 15 || pixel == 16 || pixel == 24 || pixel == 32;
  if (!isKnown) FailTga(path, "TGA pixels of " + std::to_string(pixel) + " bits are not read");
  const int map = header.mapBits;
  if (header.mapType > 1 || (header.IsMapped() && header.mapType == 0))
    FailTga(path, "the TGA picture has no colour map");
  if (header.mapType == 1 && map != 15 && map != 16 && map != 24 && map != 32)
    FailTga(path, "TGA colour maps of " + std::to_string(map) + " bits are not read");
  return header;
}

// A colour as bytes: red, green, blue, alpha.
using TgaColor = std::array<std::uint8_t, 4>;

TgaColor TgaColorAt(const char* bytes, int bits) {
  const auto byte = [&](int i) { return std::uint8_t(bytes[i]); };
  if (bits == 8) return {byte(0), byte(0), byte(0), 255};
  if (bits >= 24) return {byte(2), byte(1), byte(0), bits == 32 ? byte(3) : std::uint8_t(255)};
  const int word = byte(0) + 256 * byte(1);
  const auto five = [&](int shift) { return std::uint8_t(((word >> shift) & 31) * 255 / 31); };
  return {five(10), five(5), five(0), 255};
}

// TgaPixels reads the pixels in the order of the file.
class TgaPixels {
 public:
  TgaPixels(const std::string& path, const TgaHeader& header, std::string_view bytes)
      : path_(path), header_(header) {
    const std::size_t mapBytes = header.mapType == 0 ? 0 : std::size_t((header.mapBits + 7) / 8);
    const std::size_t mapSize = mapBytes * std::size_t(header.mapCount);
    const std::size_t map = kTgaHeaderSize + std::size_t(header.idLength);
    if (bytes.size() < map + mapSize) FailTga(path, "the file ends within its colour map");
    for (std::size_t i = 0; header.IsMapped() && i < std::size_t(header.mapCount); ++i)
      colors_.push_back(TgaColorAt(bytes.data() + map + i * mapBytes, header.mapBits));
    rest_ = bytes.substr(map + mapSize);
    // A packet of a run-length code holds at most 128 pixels.
    const std::uint64_t pixels = std::uint64_t(header.width) * std::uint64_t(header.height);
    const auto pixelBytes = std::uint64_t(header.PixelBytes());
    const std::uint64_t needed =
        header.IsEncoded() ? (pixels + 127) / 128 * (pixelBytes + 1) : pixels * pixelBytes;
    if (rest_.size() < needed) FailShort();
  }

  TgaColor Next() {
    if (!header_.IsEncoded()) return Read();
    if (left_ == 0) {
      if (rest_.empty()) FailShort();
      const int packet = static_cast<unsigned char>(rest_[0]);
      rest_.remove_prefix(1);
      left_ = (packet & 127) + 1;
      isRun_ = packet >= 128;
      if (isRun_) repeated_ = Read();
    }
    --left_;
    return isRun_ ? repeated_ : Read();
  }

 private:
  [[noreturn]] void FailShort() const { FailTga(path_, "the file ends before its last pixel"); }

  TgaColor Read() {
    const auto size = std::size_t(header_.PixelBytes());
    if (rest_.size() < size) FailShort();
    const char* const pixel = rest_.data();
    rest_.remove_prefix(size);
    if (!header_.IsMapped()) return TgaColorAt(pixel, header_.bits);
    int index = static_cast<unsigned char>(pixel[0]);
    if (size == 2) index += 256 * static_cast<unsigned char>(pixel[1]);
    index -= header_.mapFirst;
    if (index < 0 || index >= int(colors_.size()))
      FailTga(path_, "a pixel names a colour that is not in the colour map");
    return colors_[std::size_t(index)];
  }

  const std::string& path_;
  const TgaHeader& header_;
  std::string_view rest_;
  std::vector<TgaColor> colors_;
  int left_ = 0;  // pixels left in the packet
  bool isRun_ = false;
  TgaColor repeated_{};
};

}  // namespace

bool IsTga(const std::string& path, std::string_view bytes) {
  std::string end = path.size() < 4 ? "" : path.substr(path.size() - 4);
  for (char& c : end) c = c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c;
  return end == ".tga" || bytes.ends_with(kTgaSignature);
}

Image ParseTga(const std::string& path, std::string_view bytes) {
  const TgaHeader header = ReadTgaHeader(path, bytes);
  TgaPixels pixels(path, header, bytes);
  std::vector<std::string> names{"R", "G", "B"};
  if (header.HasAlpha()) names.push_back("A");
  Image image(header.width, header.height, names);
  image.isFromSrgb = true;
  image.hasStraightAlpha = header.HasAlpha();
  const std::array<float, 256> linear = SrgbTable();
  const bool isFromRight = header.flags & 16, isFromTop = header.flags & 32;
  for (int row = 0; row < header.height; ++row) {
    for (int column = 0; column < header.width; ++column) {
      const TgaColor color = pixels.Next();
      const int x = isFromRight ? header.width - 1 - column : column;
      const int y = isFromTop ? row : header.height - 1 - row;
      for (std::size_t c = 0; c < 3; ++c) image.At(x, y, int(c)) = linear[color[c]];
      if (header.HasAlpha()) image.At(x, y, 3) = float(color[3]) / 255.f;
    }
  }
  return image;
}

}  // namespace exphoton
