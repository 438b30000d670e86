// SPDX-License-Identifier: BSD-2-Clause
// Film: sums of the samples of each pixel, in double, in the order of the sample index. A pixel is
// filled by one thread at a time; its value never depends on its neighbours.
#pragma once

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

  // weight is the filter's (FilterSample). L must be finite.
  void AddSample(Point2i pixel, const Spectrum& L, Real alpha, Real weight);
  // A sample that was dropped still counts as one, as black.
  std::int64_t SampleCount(Point2i pixel) const;

  // R, G, B, A: means over each pixel's samples; pixels without a sample are 0.
  Image ToImage(bool premultiplyAlpha) const;

 private:
  struct Pixel {
    double r = 0, g = 0, b = 0, alpha = 0;
    std::int64_t samples = 0;
  };
  Pixel& At(Point2i pixel);

  PixelBounds full_, crop_;
  std::vector<Pixel> pixels_;
};

}  // namespace exphoton
