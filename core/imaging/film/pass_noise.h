// SPDX-License-Identifier: BSD-2-Clause
// PassNoise: how noisy the mean of several independent passes over an image is, from how far they
// lie apart. Passes are collected into a few groups, each independent of the others; what is common
// to all (bias) does not show. docs/decisions/0007-stopping-rules.md derives it.
#pragma once

#include <vector>

#include "core/imaging/film/film.h"

namespace exphoton {

class PassNoise {
 public:
  PassNoise(const PixelBounds& crop, int groups);

  // Adds a pass of so many samples a pixel to one of the groups.
  void Add(int group, const Film& pass, std::int64_t samplesPerPixel);
  std::int64_t SamplesOf(int group) const { return samples_[std::size_t(group)]; }
  // The group with the fewest samples, of those the first.
  int SmallestGroup() const;

  // Estimate of the mean over pixels and channels of var / (r^2 + 0.01), where var is the variance
  // of the picture of all passes together and r the true picture: the noise part of relMSE. For r
  // it takes the mean of 5 x 5 pixels: a pixel's own value is as noisy as what it would divide.
  // Infinite with less than two groups that have samples.
  double RelativeVariance() const;
  // Estimated variance of each pixel of that picture, three channels a pixel.
  std::vector<float> Variances() const;

 private:
  struct Sums {
    float rgb[3] = {}, weight = 0;  // sum(w L), sum(w)
  };
  struct Group {  // one that has samples
    const Sums* pixels;
    double share;  // of the samples
  };
  std::vector<Group> Groups() const;
  Sums TotalOf(const std::vector<Group>& groups, std::size_t pixel) const;

  double SampleCount() const;        // a pixel, of all groups
  std::vector<float> Means() const;  // the picture, three channels

  std::size_t width_, pixelCount_;
  std::vector<std::vector<Sums>> sums_;  // a group, a pixel
  std::vector<std::int64_t> samples_;
};

}  // namespace exphoton
