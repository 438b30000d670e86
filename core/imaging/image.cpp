// SPDX-License-Identifier: BSD-2-Clause
// Image: construction and access. ReadImage chooses the reader by the first bytes of the file.
#include "core/imaging/image.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

#include "core/files/input_file.h"
#include "core/imaging/files/exr.h"
#include "core/imaging/files/png.h"

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

void CheckImageFile(const std::string& path) {
  try {
    RequireRegularFile(path);
  } catch (const InputFileError& error) {
    throw ImageError(path + ": " + error.what());
  }
}

Image ReadImage(const std::string& path) {
  CheckImageFile(path);
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"),
                                                             &std::fclose);
  if (!file) throw ImageError(path + ": " + std::strerror(errno));
  unsigned char magic[8] = {};
  const std::size_t count = std::fread(magic, 1, sizeof magic, file.get());
  if (std::ferror(file.get())) throw ImageError(path + ": " + std::strerror(errno));
  if (count == 0) throw ImageError(path + ": the file is empty");
  constexpr unsigned char kExr[4] = {0x76, 0x2f, 0x31, 0x01};
  constexpr unsigned char kPng[8] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
  if (count >= sizeof kExr && std::memcmp(magic, kExr, sizeof kExr) == 0) return ReadExr(path);
  if (count >= sizeof kPng && std::memcmp(magic, kPng, sizeof kPng) == 0) return ReadPng(path);
  throw ImageError(path + ": neither an OpenEXR nor a PNG file");
}

}  // namespace exphoton
