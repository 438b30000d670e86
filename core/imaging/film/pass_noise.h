// SPDX-License-Identifier: BSD-2-Clause
// PassNoise estimates the noise of the mean of several independent passes from their differences.
// Passes are collected into a few groups, which count as independent. The errors of groups that
// continue one sequence partly cancel, so the estimate is then rather too high. Bias, which all
// groups share, does not show. Derivation: docs/decisions/0007-stopping-rules.md.
#pragma once

#include <vector>

#include "core/imaging/film/film.h"

namespace exphoton {

class PassNoise {
 public:
  PassNoise(const PixelBounds& crop, int groups);

  // Adds a pass with samplesPerPixel samples per pixel to a group.
  void Add(int group, const Film& pass, std::int64_t samplesPerPixel);
  int Places() const { return int(samples_.size()); }  // for groups
  std::int64_t SamplesOf(int group) const { return samples_[std::size_t(group)]; }
  std::size_t Width() const { return width_; }  // of the picture
  // Takes r^2 (Levels) from another picture of the same passes, which must outlive this object.
  void UseLevelsOf(const PassNoise* other) { levelsFrom_ = other; }
  // Moves the samples of all groups to the first one.
  void Join();
  // Saves or loads the samples. Throws ArchiveError if the saved pixels or groups were others.
  void Transfer(ByteArchive* archive);

  // Estimates the mean over pixels and channels of var / (r^2 + 0.01), the noise part of relMSE.
  // var is the variance of the picture of all passes, and r is the true picture. SquaredLevels
  // replaces r^2, because a single pixel is as noisy as the error it would divide. Returns infinity
  // if fewer than two groups have samples.
  double RelativeVariance() const;
  // Returns the degrees of freedom of that estimate, which spreads about as a chi-square variate
  // with this number; at least 1. Needs two groups.
  double RelativeVarianceFreedom() const;
  // Returns the standard error of that estimate; infinity with fewer than two groups.
  double RelativeVarianceError() const;
  // Returns the estimated variance of each pixel of that picture, three channels per pixel.
  std::vector<float> Variances() const;
  // Returns the estimated r^2 (SquaredLevels) of each pixel of that picture, three channels per
  // pixel. Needs two groups with samples. The result is valid until samples are added, joined or
  // loaded.
  const std::vector<double>& Levels() const;
  // Returns the mean of groups that have samples, three channels per pixel. Filters with negative
  // lobes may make it negative.
  std::vector<double> MeansOf(const std::vector<int>& groups) const;

 private:
  struct Sums {
    float rgb[3] = {}, weight = 0;  // sum(w L), sum(w)
  };
  struct Group {  // a group that has samples
    const Sums* pixels;
    double share;  // of all samples
  };
  std::vector<Group> Groups() const;
  static double DegreesOfCell(const std::vector<Group>& groups);
  // Returns for each pixel how many standard deviations (Variances) its value has at most if only
  // one group sees light in it; empty with fewer than two groups.
  std::vector<float> DeviationsOfOneGroup() const;
  Sums TotalOf(const std::vector<Group>& groups, std::size_t pixel) const;

  double SampleCount() const;        // per pixel, over all groups
  std::vector<float> Means() const;  // the picture, three channels
  // Returns the terms whose mean is RelativeVariance, for each pixel the mean of three channels.
  std::vector<double> RelativeVariances() const;

  std::size_t width_, pixelCount_;
  std::vector<std::vector<Sums>> sums_;  // by group, then by pixel
  std::vector<std::int64_t> samples_;
  const PassNoise* levelsFrom_ = nullptr;  // null: this picture
  mutable std::vector<double> levels_;     // of the samples so far; empty: computed when needed
};

}  // namespace exphoton
