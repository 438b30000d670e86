// SPDX-License-Identifier: BSD-2-Clause
// AovFilm: sums of the layers that were asked for, beside a Film and weighted as it is: a pixel
// of a layer is sum(w x) / sum(w) over the pixel's samples. Exists only where layers are wanted.
#pragma once

#include <vector>

#include "core/imaging/film/aovs.h"
#include "core/imaging/film/film.h"

namespace exphoton {

class AovFilm {
 public:
  AovFilm(const PixelBounds& crop, AovSet wanted);

  AovSet Wanted() const { return wanted_; }
  bool NeedsSurface() const { return !(wanted_ & kSurfaceLayers).IsEmpty(); }
  bool NeedsTime() const { return wanted_.Has(Aov::Time); }

  // One camera sample: its layers, the radiance L that the Film got, and the filter's weight. A
  // pixel is filled by one thread at a time.
  void AddSample(Point2i pixel, const AovSample& sample, const Spectrum& L, Real weight);
  void AddTime(Point2i pixel, double seconds);

  // Appends the channels to the film's picture. Light layers are scaled as the picture is, so that
  // they sum to it; a channel that the picture shows as 0 because it is negative is 0 in all.
  void AppendTo(const Film& film, bool premultiplyAlpha, Image* image) const;

 private:
  struct Weights {
    double sum = 0, sumOfSquares = 0;
    std::int64_t samples = 0;
    float absSum = 0;
  };
  // Sums of w x, and of |w| x for pixels whose weights nearly cancel (film.h).
  struct Value {
    double sum = 0;
    float absSum = 0;
  };
  struct Moments {  // for Variance, of one channel
    double wwLL = 0, wwL = 0, wL = 0;
  };

  std::size_t IndexOf(Point2i pixel) const;
  double MeanOf(std::size_t pixel, std::size_t value) const;
  double VarianceOf(std::size_t pixel, std::size_t channel) const;
  void Collect(std::size_t pixel, const std::array<double, 4>& beauty, double lightScale,
               float* out) const;

  PixelBounds crop_;
  AovSet wanted_;
  std::vector<Aov> aovs_, averaged_;
  std::size_t valueCount_ = 0;  // averaged channels a pixel
  std::vector<Weights> weights_;
  std::vector<Value> values_;
  std::vector<Moments> moments_;  // three a pixel
  std::vector<double> seconds_;
  std::vector<double> distances_;  // sums of radianceDistance
  std::vector<std::int64_t> reads_;
};

// The image with channels added; `values` holds them pixel by pixel.
void AppendChannels(const std::vector<std::string>& names, const std::vector<float>& values,
                    Image* image);

}  // namespace exphoton
