// SPDX-License-Identifier: BSD-2-Clause
// Image: construction and access. ReadImage chooses the reader by the first bytes of the file.
#include "core/imaging/image.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <new>
#include <utility>

#include "core/base/error.h"
#include "core/base/memory.h"
#include "core/files/input_file.h"
#include "core/imaging/files/exr.h"
#include "core/imaging/files/jpeg.h"
#include "core/imaging/files/pfm.h"
#include "core/imaging/files/png.h"
#include "core/imaging/files/radiance.h"
#include "core/imaging/files/tga.h"

namespace exphoton {

Image::Image(PixelBounds dataWindow, PixelBounds displayWindow,
             std::vector<std::string> channelNames)
    : data(dataWindow), display(displayWindow), channels(std::move(channelNames)) {
  if (!data.IsEmpty())
    pixels.resize(std::size_t(Width()) * std::size_t(Height()) * channels.size());
}

Image::Image(int width, int height, std::vector<std::string> channelNames)
    : Image({0, 0, width, height}, {0, 0, width, height}, std::move(channelNames)) {}

int Image::FindChannel(const std::string& name) const {
  const auto found = std::find(channels.begin(), channels.end(), name);
  return found == channels.end() ? -1 : int(found - channels.begin());
}

float& Image::At(int x, int y, int channel) {
  return pixels[(std::size_t(y) * std::size_t(Width()) + std::size_t(x)) * channels.size() +
                std::size_t(channel)];
}
float Image::At(int x, int y, int channel) const {
  return const_cast<Image*>(this)->At(x, y, channel);
}

void PremultiplyAlpha(Image* image) {
  if (!std::exchange(image->hasStraightAlpha, false)) return;
  const int alpha = image->FindChannel("A");
  for (const char* name : {"R", "G", "B"}) {
    const int color = image->FindChannel(name);
    if (color < 0 || alpha < 0) continue;
    for (int y = 0; y < image->Height(); ++y)
      for (int x = 0; x < image->Width(); ++x) image->At(x, y, color) *= image->At(x, y, alpha);
  }
}

double StraightFactor(const Image& image, double alpha) {
  return !image.hasStraightAlpha && alpha > 0 && alpha < 1 ? 1 / alpha : 1;
}

void CheckPixelCount(const std::string& path, std::int64_t width, std::int64_t height) {
  constexpr std::int64_t kLongest = std::int64_t(1) << 30;
  if (width > kLongest || height > kLongest || width * height > kMaxImagePixels)
    throw ImageError(path + ": more than 2^28 pixels");
}

void CheckImageFile(const std::string& path) {
  try {
    RequireRegularFile(path);
  } catch (const InputFileError& error) {
    throw ImageError(path + ": " + error.what());
  }
}

namespace {

using OpenImage = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

// Returns `count` bytes from `from` on, or fewer at the end of the file.
std::string BytesOf(const std::string& path, std::FILE* file, long from, std::size_t count) {
  std::string bytes(count, '\0');
  if (std::fseek(file, from, SEEK_SET) != 0) throw ImageError(path + ": " + std::strerror(errno));
  bytes.resize(std::fread(bytes.data(), 1, count, file));
  if (std::ferror(file)) throw ImageError(path + ": " + std::strerror(errno));
  return bytes;
}

using ImageParser = Image (*)(const std::string& path, std::string_view bytes);

// Returns the parser of a format that has a mark at its beginning; null if there is none.
ImageParser ParserFor(std::string_view magic) {
  if (IsPfm(magic)) return ParsePfm;
  if (IsJpeg(magic)) return ParseJpeg;
  return IsRadiance(magic) ? ParseRadiance : nullptr;
}

// Reads the formats that are parsed from bytes in memory.
Image ReadFromMemory(const std::string& path, const std::string& magic, std::FILE* file) {
  std::fseek(file, 0, SEEK_END);
  const long size = std::ftell(file);
  ImageParser parse = ParserFor(magic);
  if (!parse && IsTga(path, BytesOf(path, file, std::max(size - 26, 0l), 26))) parse = ParseTga;
  if (!parse) throw ImageError(path + ": not an OpenEXR, PNG, JPEG, TGA, Radiance HDR or PFM file");
  constexpr long kMaxBytes = 1l << 33;  // above the size of kMaxImagePixels in any format
  if (size > kMaxBytes) throw ImageError(path + ": more than 8 GiB");
  try {
    return parse(path, BytesOf(path, file, 0, std::size_t(size)));
  } catch (const std::bad_alloc&) {
    throw Error(ExitStatus::Resource,
                "not enough memory for the picture \"" + path + "\"; " + MemoryLimit());
  }
}

}  // namespace

Image ReadImage(const std::string& path) {
  CheckImageFile(path);
  const OpenImage file(std::fopen(path.c_str(), "rb"), &std::fclose);
  if (!file) throw ImageError(path + ": " + std::strerror(errno));
  const std::string magic = BytesOf(path, file.get(), 0, 10);
  if (magic.empty()) throw ImageError(path + ": the file is empty");
  if (magic.starts_with("\x76\x2f\x31\x01")) return ReadExr(path);
  if (magic.starts_with("\x89PNG\r\n\x1a\n")) return ReadPng(path);
  return ReadFromMemory(path, magic, file.get());
}

}  // namespace exphoton
