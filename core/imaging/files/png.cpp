// SPDX-License-Identifier: BSD-2-Clause
// PNG by libpng's simplified interface. This file decodes 8-bit samples exactly. The library treats
// 16-bit samples as sRGB and decodes them to 16 linear bits.
#include "core/imaging/files/png.h"

#include <png.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <new>

#include "core/base/error.h"
#include "core/base/fp_traps.h"
#include "core/base/memory.h"
#include "core/files/atomic_file.h"
#include "core/imaging/files/srgb.h"

namespace exphoton {
namespace {

std::uint8_t ToByte(double v) { return std::uint8_t(std::lround(std::clamp(v, 0., 1.) * 255)); }

// Frees the library's memory whenever the scope ends.
struct PngImage {
  png_image image{};
  PngImage() { image.version = PNG_IMAGE_VERSION; }
  ~PngImage() { png_image_free(&image); }
};

[[noreturn]] void Fail(const std::string& path, const png_image& image) {
  throw ImageError(path + ": " + image.message);
}

Image Read8(const std::string& path, png_image* png, int channels, Image result) {
  png->format = channels == 4 ? PNG_FORMAT_RGBA : PNG_FORMAT_RGB;
  std::vector<std::uint8_t> bytes(result.pixels.size());
  if (!png_image_finish_read(png, nullptr, bytes.data(), 0, nullptr)) Fail(path, *png);
  const std::array<float, 256> linear = SrgbTable();
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    const bool isAlpha = channels == 4 && i % 4 == 3;
    result.pixels[i] = isAlpha ? float(bytes[i]) / 255.f : linear[bytes[i]];
  }
  return result;
}

// The library's linear formats premultiply colours by alpha. This function divides by alpha again.
Image Read16(const std::string& path, png_image* png, int channels, Image result) {
  png->format = channels == 4 ? PNG_FORMAT_LINEAR_RGB_ALPHA : PNG_FORMAT_LINEAR_RGB;
  png->flags |= PNG_IMAGE_FLAG_16BIT_sRGB;
  std::vector<std::uint16_t> values(result.pixels.size());
  if (!png_image_finish_read(png, nullptr, values.data(), 0, nullptr)) Fail(path, *png);
  for (std::size_t i = 0; i < values.size(); i += std::size_t(channels)) {
    const float alpha = channels == 4 ? float(values[i + 3]) : 65535.f;
    for (std::size_t c = 0; c < 3; ++c)
      result.pixels[i + c] = alpha > 0 ? float(values[i + c]) / alpha : 0;
    if (channels == 4) result.pixels[i + 3] = alpha / 65535.f;
  }
  return result;
}

Image ReadPngFile(const std::string& path) {
  CheckImageFile(path);
  PngImage png;
  if (!png_image_begin_read_from_file(&png.image, path.c_str())) Fail(path, png.image);
  CheckPixelCount(path, png.image.width, png.image.height);
  const bool hasAlpha = png.image.format & PNG_FORMAT_FLAG_ALPHA;
  std::vector<std::string> names = {"R", "G", "B"};
  if (hasAlpha) names.push_back("A");
  const int channels = int(names.size());
  Image result(int(png.image.width), int(png.image.height), names);
  result.isFromSrgb = true;
  result.hasStraightAlpha = hasAlpha;
  const bool is16 = png.image.format & PNG_FORMAT_FLAG_LINEAR;
  return is16 ? Read16(path, &png.image, channels, std::move(result))
              : Read8(path, &png.image, channels, std::move(result));
}

std::vector<std::uint8_t> ToneMap(const Image& image, const std::array<int, 4>& from,
                                  std::size_t channels, const ToneMapping& tone) {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(std::size_t(image.Width()) * std::size_t(image.Height()) * channels);
  for (int y = 0; y < image.Height(); ++y) {
    for (int x = 0; x < image.Width(); ++x) {
      const double alpha = channels == 4 ? double(image.At(x, y, from[3])) : 1;
      const double factor = StraightFactor(image, alpha);
      for (std::size_t c = 0; c < channels; ++c) {
        const double v = c == 3 ? alpha : factor * double(image.At(x, y, from[c]));
        bytes.push_back(ToByte(c == 3 ? (v > 0 ? v : 0) : EncodeSrgb(tone.Apply(v))));
      }
    }
  }
  return bytes;
}

}  // namespace

std::string EncodePng(const Image& image, const ToneMapping& tone) {
  const UntrappedLibraryCall guard;
  const std::array<int, 4> from = {image.FindChannel("R"), image.FindChannel("G"),
                                   image.FindChannel("B"), image.FindChannel("A")};
  if (from[0] < 0 || from[1] < 0 || from[2] < 0)
    throw Error(ExitStatus::File, "no channels R, G, B for a PNG");
  const std::size_t channels = from[3] >= 0 ? 4 : 3;
  const std::vector<std::uint8_t> bytes = ToneMap(image, from, channels, tone);

  PngImage png;
  png.image.width = png_uint_32(image.Width());
  png.image.height = png_uint_32(image.Height());
  png.image.format = channels == 4 ? PNG_FORMAT_RGBA : PNG_FORMAT_RGB;
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(png.image);
  std::string encoded(size, '\0');
  if (!png_image_write_to_memory(&png.image, encoded.data(), &size, 0, bytes.data(), 0, nullptr))
    throw Error(ExitStatus::File, std::string("cannot encode a PNG: ") + png.image.message);
  encoded.resize(size);
  return encoded;
}

void WritePng(const std::string& path, const Image& image, const ToneMapping& tone) {
  std::string encoded;
  try {
    encoded = EncodePng(image, tone);
  } catch (const Error& error) {
    throw Error(error.Status(), "cannot write \"" + path + "\": " + error.what());
  }
  AtomicFile file(path);
  file.Write(encoded.data(), encoded.size());
  file.Commit();
}

Image ReadPng(const std::string& path) {
  const UntrappedLibraryCall guard;
  try {
    return ReadPngFile(path);
  } catch (const std::bad_alloc&) {
    throw Error(ExitStatus::Resource,
                "not enough memory for the picture \"" + path + "\"; " + MemoryLimit());
  }
}

}  // namespace exphoton
