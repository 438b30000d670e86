// SPDX-License-Identifier: BSD-2-Clause
// Film accumulates the samples of each pixel in double precision, in the order of the sample index.
// Only one thread at a time may fill a pixel.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/imaging/image.h"
#include "core/math/spectrum.h"
#include "core/math/vec.h"

namespace exphoton {

class ByteArchive;

// The parameters of Film "image". Their table is in core/parser/film_parameters.h.
struct FilmSettings {
  std::string filename = "pbrt.exr";
  bool premultiplyAlpha = true;
  int xResolution = 640, yResolution = 480;
  std::optional<std::vector<Real>> cropWindow;  // x0 x1 y0 y1 in [0,1]
  int writeFrequency = -1;

  PixelBounds Full() const { return {0, 0, xResolution, yResolution}; }
  PixelBounds Crop()
      const;  // pixels whose upper left corners are in the crop window, as in pbrt v1
};

class Film {
 public:
  Film(PixelBounds full, PixelBounds crop);  // throws Error(Resource) if memory is insufficient

  const PixelBounds& Full() const { return full_; }
  const PixelBounds& Crop() const { return crop_; }

  // Adds one sample. `weight` is the filter weight (FilterSample). L must be finite. A dropped
  // sample counts as a black sample.
  void AddSample(Point2i pixel, const Spectrum& L, Real alpha, Real weight);
  // Adds radiance to a sample that was added before with this weight.
  void AddLight(Point2i pixel, const Spectrum& L, Real weight);
  std::int64_t SampleCount(Point2i pixel) const;
  bool HasSamples() const;  // in any pixel
  // For samples that are splatted (core/render/splat_buffer.h): adds a sample to its own pixel, and
  // light to such a sample. `share` is 1 for a whole sample and smaller for a part of one. The
  // pixel shows their mean only if AddSums adds too small a weight.
  void AddOwn(Point2i pixel, const Spectrum& L, Real alpha, Real share);
  void AddOwnLight(Point2i pixel, const Spectrum& L, Real share);

  // Removes all samples.
  void Clear();
  void ClearPixel(Point2i pixel) { pixels_[IndexOf(pixel)] = Pixel(); }
  // Adds the samples of another film with the same windows, as if they followed this film's
  // samples.
  void Add(const Film& other);
  // Removes the radiance of another film, which has no samples of its own.
  void SubtractLight(const Film& other);

  // sum(w L) and sum(w) of a pixel, for computations with several films.
  struct Sums {
    double r = 0, g = 0, b = 0, weight = 0;
  };
  // `index` counts the crop window's pixels row by row.
  Sums SumsOf(std::size_t index) const {
    const Pixel& p = pixels_[index];
    return {p.r, p.g, p.b, p.weight};
  }
  // Adds the sums of splatted samples. `alpha` is sum(w alpha).
  void AddSums(std::size_t index, const Sums& sums, double alpha);
  std::size_t PixelCount() const { return pixels_.size(); }
  // Returns r, g, b, alpha before ToImage clamps and premultiplies them.
  std::array<double, 4> MeanOf(Point2i pixel) const { return pixels_[IndexOf(pixel)].Mean(); }

  // Returns R, G, B, A: sum(w L) / sum(w) over each pixel's samples. Values are at least 0, and
  // alpha is at most 1. Pixels without samples are 0. premultiplyAlpha multiplies R, G, B by A, as
  // in pbrt v1.
  Image ToImage(bool premultiplyAlpha) const;

  // Saves or loads the sums of all pixels. Throws ArchiveError if the saved film had another size.
  void Transfer(ByteArchive* archive);
  // Saves or loads the sums of one pixel.
  void TransferPixel(ByteArchive* archive, Point2i pixel) {
    TransferSums(archive, &pixels_[IndexOf(pixel)]);
  }

 private:
  // Most filters with negative values splat their samples. sum(w) is then close to the number of
  // whole samples, absWeight, except by chance after the first few samples. Such pixels use the
  // mean of their own samples, which needs little precision. Filters without negative values have
  // positive weights, so that both sums and both means are the same.
  struct Pixel {
    double r = 0, g = 0, b = 0, alpha = 0, weight = 0;
    std::int64_t samples = 0;
    float absR = 0, absG = 0, absB = 0, absAlpha = 0, absWeight = 0;

    std::array<double, 4> Mean() const;
  };
  std::size_t IndexOf(Point2i pixel) const;
  static void TransferSums(ByteArchive* archive, Pixel* p);

  PixelBounds full_, crop_;
  std::vector<Pixel> pixels_;
};

}  // namespace exphoton
