// SPDX-License-Identifier: BSD-2-Clause
// ParsePfm: three words of text, one character of white space, and the values.
#include "core/imaging/files/pfm.h"

#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>

namespace exphoton {
namespace {

[[noreturn]] void FailPfm(const std::string& path, const std::string& text) {
  throw ImageError(path + ": " + text);
}

bool IsPfmSpace(char c) { return c == ' ' || c == '\n' || c == '\t' || c == '\r'; }

// Removes the next word of the header, with one character of white space after it.
std::string_view TakePfmWord(std::string_view* bytes) {
  std::size_t begin = 0;
  while (begin < bytes->size() && IsPfmSpace((*bytes)[begin])) ++begin;
  std::size_t end = begin;
  while (end < bytes->size() && end - begin < 64 && !IsPfmSpace((*bytes)[end])) ++end;
  const std::string_view word = bytes->substr(begin, end - begin);
  bytes->remove_prefix(std::min(end + 1, bytes->size()));
  return word;
}

template <class T>
T PfmNumber(const std::string& path, std::string_view* bytes, const char* what) {
  const std::string_view word = TakePfmWord(bytes);
  T value{};
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size() || word.empty())
    FailPfm(path, std::string("the PFM header has no ") + what);
  return value;
}

float PfmValue(const char* bytes, bool isLittle) {
  std::uint32_t bits;
  std::memcpy(&bits, bytes, sizeof bits);
  if (isLittle != (std::endian::native == std::endian::little))
    bits = (bits >> 24) | ((bits >> 8) & 0xff00u) | ((bits << 8) & 0xff0000u) | (bits << 24);
  return std::bit_cast<float>(bits);
}

}  // namespace

bool IsPfm(std::string_view bytes) {
  return bytes.size() > 2 && bytes[0] == 'P' && (bytes[1] == 'F' || bytes[1] == 'f') &&
         IsPfmSpace(bytes[2]);
}

Image ParsePfm(const std::string& path, std::string_view bytes) {
  const bool isColor = TakePfmWord(&bytes) == "PF";
  const int width = PfmNumber<int>(path, &bytes, "width");
  const int height = PfmNumber<int>(path, &bytes, "height");
  const float scale = PfmNumber<float>(path, &bytes, "scale");
  if (width < 1 || height < 1) FailPfm(path, "the PFM picture has no pixels");
  CheckPixelCount(path, width, height);
  if (scale == 0 || !std::isfinite(scale)) FailPfm(path, "the scale of a PFM file must not be 0");
  const std::size_t channels = isColor ? 3 : 1, pixel = channels * sizeof(float);
  if (bytes.size() < pixel * std::size_t(width) * std::size_t(height))
    FailPfm(path, "the file ends before its last pixel");
  Image image(width, height, {"R", "G", "B"});
  const char* at = bytes.data();
  for (int y = height - 1; y >= 0; --y)
    for (int x = 0; x < width; ++x, at += pixel)
      for (std::size_t c = 0; c < 3; ++c)
        image.At(x, y, int(c)) =
            PfmValue(at + (isColor ? c * sizeof(float) : 0), scale < 0) * std::abs(scale);
  return image;
}

}  // namespace exphoton
