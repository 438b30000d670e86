// SPDX-License-Identifier: BSD-2-Clause
// Image is a rectangle of float pixels with named channels, in memory. exr.h and png.h read and
// write files; tga.h, pfm.h, jpeg.h and radiance.h read them. ReadImage detects the format.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

namespace exphoton {

// Pixels with x in [x0, x1) and y in [y0, y1).
struct PixelBounds {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  int Width() const { return x1 - x0; }
  int Height() const { return y1 - y0; }
  bool IsEmpty() const { return x1 <= x0 || y1 <= y0; }
  bool Contains(int x, int y) const { return x >= x0 && x < x1 && y >= y0 && y < y1; }
  friend bool operator==(const PixelBounds&, const PixelBounds&) = default;
};

// 16 floats are a matrix. The eight of "chromaticities" are the x and y of red, green, blue, white.
using ImageAttribute = std::variant<std::string, float, int, std::vector<float>>;

struct Image {
  PixelBounds data;                   // position of the pixels in the full frame
  PixelBounds display;                // the full frame
  std::vector<std::string> channels;  // for example "R", "G", "B", "A", "albedo.R"
  std::vector<float> pixels;          // row by row, with the channels of a pixel adjacent
  std::map<std::string, ImageAttribute> attributes;
  std::set<std::string> exactChannels;  // written with 32 bits to every EXR file; see ReadExr
  bool isFromSrgb = false;  // whether the values were decoded from sRGB when the file was read
  // Whether R, G and B are not multiplied by A. PNG and TGA files have such colours. EXR files and
  // rendered pictures do not.
  bool hasStraightAlpha = false;

  Image() = default;
  Image(PixelBounds dataWindow, PixelBounds displayWindow, std::vector<std::string> channelNames);
  Image(int width, int height, std::vector<std::string> channelNames);

  int Width() const { return data.Width(); }
  int Height() const { return data.Height(); }
  int ChannelCount() const { return int(channels.size()); }
  int FindChannel(const std::string& name) const;  // -1 if absent
  // x and y are relative to the data window's corner.
  float& At(int x, int y, int channel);
  float At(int x, int y, int channel) const;
};

// An error in an image file. The message names the file.
class ImageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Pictures that are read have at most 2^28 pixels. Throws ImageError for larger ones.
inline constexpr std::int64_t kMaxImagePixels = std::int64_t(1) << 28;
void CheckPixelCount(const std::string& path, std::int64_t width, std::int64_t height);

// EXR files that are read have at most this number of channels. A picture of this program with all
// AOVs and two halves has 76.
inline constexpr int kMaxImageChannels = 256;

// Reads EXR, PFM and Radiance HDR files (linear), and PNG (8 or 16 bit), JPEG and TGA files, which
// are decoded from sRGB to linear. All but EXR have the channels R, G, B, and A if present; grey
// becomes R, G, B. EXR channels keep their names; Y alone becomes R, G, B. Throws ImageError, also
// for more than kMaxImagePixels or kMaxImageChannels, which are checked before allocation.
Image ReadImage(const std::string& path);

// Multiplies R, G and B by A if the image has straight alpha.
void PremultiplyAlpha(Image* image);
// Returns the factor that turns R, G and B of a pixel with this alpha into straight colours. A
// pixel with alpha 0 keeps its colours. They are light without a surface, such as glow, which a
// straight picture cannot add to a background. Viewers that ignore alpha still show it.
double StraightFactor(const Image& image, double alpha);

// Throws ImageError if `path` is not a readable regular file.
void CheckImageFile(const std::string& path);

}  // namespace exphoton
