// SPDX-License-Identifier: BSD-2-Clause
// fuzz_pictures checks that the parsers of PFM, JPEG, Radiance HDR and TGA make any bytes an image
// or throw an ImageError.
#include <string_view>

#include "core/imaging/files/jpeg.h"
#include "core/imaging/files/pfm.h"
#include "core/imaging/files/radiance.h"
#include "core/imaging/files/tga.h"
#include "tests/fuzz/input.h"

using namespace exphoton;

namespace {

template <class Parse>
void Check(const Parse& parse, std::string_view bytes) {
  try {
    const Image image = parse("picture", bytes);
    fuzz::Require(image.pixels.size() == std::size_t(image.Width()) * std::size_t(image.Height()) *
                                             image.channels.size(),
                  "as many values as the header says");
  } catch (const ImageError&) {
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  if (IsPfm(bytes))
    Check(ParsePfm, bytes);
  else if (IsJpeg(bytes))
    Check(ParseJpeg, bytes);
  else if (IsRadiance(bytes))
    Check(ParseRadiance, bytes);
  else
    Check(ParseTga, bytes);
  return 0;
}
