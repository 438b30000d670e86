// SPDX-License-Identifier: BSD-2-Clause
// fuzz_exr checks that ReadExr makes any file an image or throws an ImageError. ReadExr opens files
// by name, so the bytes are passed as a file in memory.
#include <sys/mman.h>
#include <unistd.h>

#include <string>

#include "core/imaging/files/exr.h"
#include "tests/fuzz/input.h"

using namespace exphoton;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const int file = memfd_create("picture", 0);
  if (file < 0) return 0;
  const std::string path = "/proc/self/fd/" + std::to_string(file);
  if (write(file, data, size) == ssize_t(size)) {
    try {
      const Image image = ReadExr(path);
      fuzz::Require(image.pixels.size() == std::size_t(image.Width()) *
                                               std::size_t(image.Height()) * image.channels.size(),
                    "as many values as the windows say");
    } catch (const ImageError&) {
    }
  }
  close(file);
  return 0;
}
