// SPDX-License-Identifier: BSD-2-Clause
// ParseJpeg: the library's warnings, which stand for damaged data, are errors here. The number of
// pixels is compared with the length of the file before memory is allocated for them.
#include "core/imaging/files/jpeg.h"

#include <turbojpeg.h>

#include <array>
#include <cstdint>
#include <memory>
#include <new>

#include "core/imaging/files/srgb.h"

namespace exphoton {
namespace {

// A block of 8 x 8 values takes at least one bit of a file.
constexpr std::int64_t kMaxPixelsPerByte = 512;

[[noreturn]] void FailJpeg(const std::string& path, const std::string& text) {
  throw ImageError(path + ": " + text);
}

[[noreturn]] void FailJpegDecoder(const std::string& path, tjhandle decoder) {
  const std::string reason = tjGetErrorStr2(decoder);
  if (reason.find("nsufficient memory") != std::string::npos) throw std::bad_alloc();
  if (reason.find("remature end") != std::string::npos)
    FailJpeg(path, "the file ends before its last pixel");
  FailJpeg(path,
           "the JPEG picture is damaged or of an unknown kind; expected 8 bits, baseline or "
           "progressive (" +
               reason + ")");
}

}  // namespace

bool IsJpeg(std::string_view bytes) { return bytes.starts_with("\xff\xd8\xff"); }

Image ParseJpeg(const std::string& path, std::string_view bytes) {
  const std::unique_ptr<void, int (*)(tjhandle)> decoder(tjInitDecompress(), &tjDestroy);
  if (!decoder) throw std::bad_alloc();
  const auto* const data = reinterpret_cast<const unsigned char*>(bytes.data());
  int width = 0, height = 0, subsampling = 0, colors = 0;
  if (tjDecompressHeader3(decoder.get(), data, bytes.size(), &width, &height, &subsampling,
                          &colors) != 0)
    FailJpegDecoder(path, decoder.get());
  if (colors == TJCS_CMYK || colors == TJCS_YCCK)
    FailJpeg(path, "JPEG pictures in CMYK are not read; convert the picture to RGB");
  if (width < 1 || height < 1) FailJpeg(path, "the JPEG picture has no pixels");
  CheckPixelCount(path, width, height);
  if (std::int64_t(width) * height > kMaxPixelsPerByte * std::int64_t(bytes.size()))
    FailJpeg(path, "the file ends before its last pixel");
  Image image(width, height, {"R", "G", "B"});
  image.isFromSrgb = true;
  std::vector<std::uint8_t> values(image.pixels.size());
  if (tjDecompress2(decoder.get(), data, bytes.size(), values.data(), width, 0, height, TJPF_RGB,
                    TJFLAG_STOPONWARNING | TJFLAG_LIMITSCANS | TJFLAG_ACCURATEDCT) != 0)
    FailJpegDecoder(path, decoder.get());
  const std::array<float, 256> linear = SrgbTable();
  for (std::size_t i = 0; i < values.size(); ++i) image.pixels[i] = linear[values[i]];
  return image;
}

}  // namespace exphoton
