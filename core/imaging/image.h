// SPDX-License-Identifier: BSD-2-Clause
// Image: a rectangle of float pixels with named channels, in memory. Reading and writing files is
// in exr.h and png.h; ReadImage tells the format by content.
#pragma once

#include <map>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

namespace exphoton {

// Pixels x in [x0, x1), y in [y0, y1).
struct PixelBounds {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  int Width() const { return x1 - x0; }
  int Height() const { return y1 - y0; }
  bool IsEmpty() const { return x1 <= x0 || y1 <= y0; }
  friend bool operator==(const PixelBounds&, const PixelBounds&) = default;
};

using ImageAttribute =
    std::variant<std::string, float, int, std::vector<float>>;  // 16 floats: m44f

struct Image {
  PixelBounds data;                   // where the pixels lie in the full frame
  PixelBounds display;                // the full frame
  std::vector<std::string> channels;  // "R", "G", "B", "A", "Albedo.R" ...
  std::vector<float> pixels;          // row by row, the channels of a pixel together
  std::map<std::string, ImageAttribute> attributes;

  Image() = default;
  Image(PixelBounds dataWindow, PixelBounds displayWindow, std::vector<std::string> channelNames);
  Image(int width, int height, std::vector<std::string> channelNames);

  int Width() const { return data.Width(); }
  int Height() const { return data.Height(); }
  int ChannelCount() const { return int(channels.size()); }
  int FindChannel(const std::string& name) const;  // -1 if absent
  // x and y count from the data window's corner.
  float& At(int x, int y, int channel);
  float At(int x, int y, int channel) const;
};

// What is wrong with an image file, in words that name the file.
class ImageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// EXR (linear) or PNG (8 or 16 bit; sRGB decoded to linear, channels R,G,B and A if present; grey
// becomes R,G,B). EXR channels are kept by name; Y alone becomes R,G,B. Throws ImageError, also for
// more than 2^28 pixels or 64 channels (checked before allocating).
Image ReadImage(const std::string& path);

// Throws ImageError where `path` is no regular file that can be read.
void CheckImageFile(const std::string& path);

}  // namespace exphoton
