// SPDX-License-Identifier: BSD-2-Clause
// Film: sums of the samples of each pixel, in double, in the order of the sample index. A pixel is
// filled by one thread at a time; its value never depends on its neighbours.
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

// What Film "image" says; its parameter table is in parser/.
struct FilmSettings {
  std::string filename = "pbrt.exr";
  bool premultiplyAlpha = true;
  int xResolution = 640, yResolution = 480;
  std::optional<std::vector<Real>> cropWindow;  // x0 x1 y0 y1 in [0,1]
  int writeFrequency = -1;

  PixelBounds Full() const { return {0, 0, xResolution, yResolution}; }
  PixelBounds Crop() const;  // pixels whose centre lies in the crop window, as v1: ceil to ceil
};

class Film {
 public:
  Film(PixelBounds full, PixelBounds crop);  // throws Error(Resource) where memory lacks

  const PixelBounds& Full() const { return full_; }
  const PixelBounds& Crop() const { return crop_; }

  // weight is the filter's (FilterSample). L must be finite. A sample that was dropped still counts
  // as one, as black.
  void AddSample(Point2i pixel, const Spectrum& L, Real alpha, Real weight);
  std::int64_t SampleCount(Point2i pixel) const;

  // Back to no samples.
  void Clear();
  // Adds the samples of another film with the same windows, as if they had come after its own.
  void Add(const Film& other);

  // sum(w L) and sum(w) of a pixel, for those who reckon with several films.
  struct Sums {
    double r = 0, g = 0, b = 0, weight = 0;
  };
  // Of the crop window's pixels, row by row.
  Sums SumsOf(std::size_t index) const {
    const Pixel& p = pixels_[index];
    return {p.r, p.g, p.b, p.weight};
  }
  std::size_t PixelCount() const { return pixels_.size(); }
  // r, g, b, alpha as ToImage starts from them: neither clamped nor premultiplied.
  std::array<double, 4> MeanOf(Point2i pixel) const { return pixels_[IndexOf(pixel)].Mean(); }

  // R, G, B, A: sum(w L) / sum(w) over each pixel's samples, never below 0, alpha at most 1; pixels
  // without a sample are 0. premultiplyAlpha, as v1 has it: R, G, B are multiplied by A.
  Image ToImage(bool premultiplyAlpha) const;

 private:
  // sum(w) is close to the number of samples, except by chance after the first few samples under a
  // filter with negative lobes. There the mean by |w| is used, which needs little precision.
  struct Pixel {
    double r = 0, g = 0, b = 0, alpha = 0, weight = 0;
    std::int64_t samples = 0;
    float absR = 0, absG = 0, absB = 0, absAlpha = 0, absWeight = 0;

    std::array<double, 4> Mean() const;
  };
  std::size_t IndexOf(Point2i pixel) const;

  PixelBounds full_, crop_;
  std::vector<Pixel> pixels_;
};

}  // namespace exphoton
