// SPDX-License-Identifier: BSD-2-Clause
// ParseRadiance: lines of text up to an empty one, the size, and rows of pixels. The size is
// compared with the bytes that follow before any pixel is allocated.
#include "core/imaging/files/radiance.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <vector>

namespace exphoton {
namespace {

[[noreturn]] void FailRadiance(const std::string& path, const std::string& text) {
  throw ImageError(path + ": " + text);
}

[[noreturn]] void FailShortRadiance(const std::string& path) {
  FailRadiance(path, "the file ends before its last pixel");
}

struct RadianceHeader {
  int width = 0, height = 0;
  bool isFromTop = true, isFromLeft = true;
  double scale = 1;  // of all values
};

std::string_view TakeRadianceLine(const std::string& path, std::string_view* bytes) {
  const std::size_t end = bytes->find('\n');
  if (end == std::string_view::npos) FailRadiance(path, "the header of the HDR file has no end");
  std::string_view line = bytes->substr(0, end);
  bytes->remove_prefix(end + 1);
  if (line.ends_with('\r')) line.remove_suffix(1);
  return line;
}

void ReadVariable(const std::string& path, std::string_view line, RadianceHeader* header) {
  constexpr std::string_view kFormat = "FORMAT=", kExposure = "EXPOSURE=";
  if (line.starts_with(kFormat) && line != "FORMAT=32-bit_rle_rgbe")
    FailRadiance(path, "HDR files with " + std::string(line.substr(0, 40)) +
                           " are not read; expected FORMAT=32-bit_rle_rgbe");
  if (!line.starts_with(kExposure)) return;
  std::string_view number = line.substr(kExposure.size());
  while (number.starts_with(' ')) number.remove_prefix(1);
  double exposure = 0;
  std::from_chars(number.data(), number.data() + number.size(), exposure);
  if (!(exposure > 0) || !std::isfinite(exposure))
    FailRadiance(path, "the EXPOSURE of an HDR file must be a number above 0");
  header->scale /= exposure;
}

// Takes a word such as "-Y" and a number such as "512".
int TakeSize(const std::string& path, std::string_view* line, char axis, char* sign) {
  const auto skip = [&] {
    while (line->starts_with(' ')) line->remove_prefix(1);
  };
  skip();
  int size = 0;
  bool isGood = line->size() > 2 && (*line)[1] == axis && ((*line)[0] == '-' || (*line)[0] == '+');
  if (isGood) {
    *sign = (*line)[0];
    line->remove_prefix(2);
    skip();
    const auto [end, error] = std::from_chars(line->data(), line->data() + line->size(), size);
    isGood = error == std::errc() && size > 0;
    line->remove_prefix(std::size_t(end - line->data()));
  }
  if (!isGood)
    FailRadiance(path, "the HDR file has no size of its picture; expected \"-Y height +X width\"");
  return size;
}

RadianceHeader ReadRadianceHeader(const std::string& path, std::string_view* bytes) {
  RadianceHeader header;
  TakeRadianceLine(path, bytes);
  for (std::string_view line; !(line = TakeRadianceLine(path, bytes)).empty();)
    ReadVariable(path, line, &header);
  std::string_view size = TakeRadianceLine(path, bytes);
  char y = 0, x = 0;
  header.height = TakeSize(path, &size, 'Y', &y);
  header.width = TakeSize(path, &size, 'X', &x);
  header.isFromTop = y == '-';
  header.isFromLeft = x == '+';
  CheckPixelCount(path, header.width, header.height);
  return header;
}

// RadianceRows reads rows of pixels of four bytes: red, green, blue, exponent.
class RadianceRows {
 public:
  RadianceRows(const std::string& path, int width, std::string_view bytes)
      : path_(path), rest_(bytes), row_(std::size_t(width) * 4) {}

  const std::vector<std::uint8_t>& Next() {
    const std::size_t width = row_.size() / 4;
    const bool isByChannel = width >= 8 && width < 32768 && rest_.size() >= 4 && rest_[0] == 2 &&
                             rest_[1] == 2 && !(Byte(2) & 128);
    isByChannel ? ReadChannels(width) : ReadPixels(width);
    return row_;
  }

 private:
  int Byte(std::size_t i) const { return static_cast<unsigned char>(rest_[i]); }
  void Need(std::size_t count) const {
    if (rest_.size() < count) FailShortRadiance(path_);
  }

  // Each channel of the row follows the one before it, in runs and literal bytes.
  void ReadChannels(std::size_t width) {
    if (std::size_t(Byte(2)) * 256 + std::size_t(Byte(3)) != width)
      FailRadiance(path_, "a row of the HDR file is not as wide as the picture");
    rest_.remove_prefix(4);
    for (std::size_t channel = 0; channel < 4; ++channel) {
      for (std::size_t x = 0; x < width;) {
        Need(2);
        const bool isRun = Byte(0) > 128;
        const std::size_t count = std::size_t(Byte(0)) - (isRun ? 128 : 0);
        if (count == 0 || count > width - x)
          FailRadiance(path_, "a run of the HDR file is longer than its row, or empty");
        Need(1 + (isRun ? 1 : count));
        for (std::size_t i = 0; i < count; ++i)
          row_[(x + i) * 4 + channel] = std::uint8_t(Byte(isRun ? 1 : 1 + i));
        x += count;
        rest_.remove_prefix(1 + (isRun ? 1 : count));
      }
    }
  }

  // A pixel (1, 1, 1, n) repeats the one before it n times. Directly after such a pixel, n counts
  // 256 times as much.
  void ReadPixels(std::size_t width) {
    int shift = 0;
    for (std::size_t x = 0; x < width; rest_.remove_prefix(4)) {
      Need(4);
      if (Byte(0) != 1 || Byte(1) != 1 || Byte(2) != 1) {
        for (std::size_t c = 0; c < 4; ++c) row_[x * 4 + c] = std::uint8_t(Byte(c));
        ++x;
        shift = 0;
        continue;
      }
      const std::size_t count = shift > 24 ? width + 1 : std::size_t(Byte(3)) << shift;
      if (x == 0 || count > width - x)
        FailRadiance(path_, "a run of the HDR file is longer than its row, or its first pixel");
      for (std::size_t i = 0; i < count * 4; ++i) row_[x * 4 + i] = row_[x * 4 + i - 4];
      x += count;
      shift += 8;
    }
  }

  const std::string& path_;
  std::string_view rest_;
  std::vector<std::uint8_t> row_;
};

}  // namespace

bool IsRadiance(std::string_view bytes) {
  return bytes.starts_with("#?RADIANC") || bytes.starts_with("#?RGBE");
}

Image ParseRadiance(const std::string& path, std::string_view bytes) {
  const RadianceHeader header = ReadRadianceHeader(path, &bytes);
  // A row takes at least four bytes.
  if (bytes.size() / 4 < std::size_t(header.height)) FailShortRadiance(path);
  Image image(header.width, header.height, {"R", "G", "B"});
  RadianceRows rows(path, header.width, bytes);
  for (int row = 0; row < header.height; ++row) {
    const std::vector<std::uint8_t>& pixels = rows.Next();
    const int y = header.isFromTop ? row : header.height - 1 - row;
    for (int column = 0; column < header.width; ++column) {
      const std::uint8_t* const pixel = pixels.data() + std::size_t(column) * 4;
      const int x = header.isFromLeft ? column : header.width - 1 - column;
      // Mantissas of 8 bits, the exponent with an offset of 128; exponent 0 is black.
      const double unit = pixel[3] == 0 ? 0 : std::ldexp(header.scale, pixel[3] - 136);
      for (std::size_t c = 0; c < 3; ++c)
        image.At(x, y, int(c)) = float(std::min(double(pixel[c]) * unit, 3e38));
    }
  }
  return image;
}

}  // namespace exphoton
