// SPDX-License-Identifier: BSD-2-Clause
// SplatBuffer accumulates the samples of one pass where each sample adds to all pixels within the
// filter's support. Sums are exact (WideExactSum), so the picture does not depend on tiles, threads
// or the crop window.
#pragma once

#include <mutex>
#include <vector>

#include "core/base/exact_sum.h"
#include "core/imaging/film/aov_film.h"
#include "core/imaging/film/film.h"
#include "core/render/splat_weights.h"

namespace exphoton {

// A camera sample that is not weighted yet.
struct SplatSample {
  Point2 place;  // within its pixel, in [0,1]^2
  Spectrum L;
  Real alpha = 1;
  const AovSample* aovs = nullptr;  // null: no AOVs
  Real share = 1;                   // of a sample; several may divide one
};

class SplatBuffer {
 public:
  // The film and the AOVs (null: none) receive the sums. All arguments must outlive this object.
  SplatBuffer(const SplatWeights& weights, Film* film, AovFilm* aovs);
  // Copies the sums of another buffer, for another film with the same windows.
  SplatBuffer(const SplatBuffer& other, Film* film, AovFilm* aovs);

  // Returns the pixels whose samples reach the film's crop window. It may exceed the full image.
  PixelBounds Window() const;

  // Splats the samples of one pixel. A thread reuses it for its pixels.
  class Pixel {
   public:
    void Begin(SplatBuffer* buffer, Point2i pixel);
    void Add(const SplatSample& sample);
    // Adds radiance to a sample that was added before with this place and share, also in another
    // object.
    void AddLight(Point2 place, Real share, const Spectrum& L, Aov lightAov);
    void End();  // adds the sums to the buffer

   private:
    void AddValues(Point2 place, Real share);

    SplatBuffer* buffer_ = nullptr;
    Point2i pixel_;
    int samples_ = 0;
    std::vector<double> weights_;           // of one sample, by pixel
    std::vector<double> values_, squares_;  // of one sample
    std::vector<double> sums_;              // by pixel, then by value: sums of w x, then of w^2 x
  };

  // Adds the sums to the film and to the AOVs. Must be called once, after all pixels.
  void Finish();
  void Transfer(ByteArchive* archive);  // saves or loads the sums
  // Saves the sums of the pixels of row y that have any. AddRow adds saved sums to the row.
  void SaveRow(ByteArchive* archive, int y) const;
  void AddRow(ByteArchive* archive, int y);

 private:
  std::size_t Stride() const { return valueCount_ + squareCount_; }

  const SplatWeights& weights_;
  Film* film_;
  AovFilm* aovs_;
  std::size_t valueCount_, squareCount_;
  std::vector<WideExactSum> sums_;
  std::vector<std::mutex> rows_;  // each protects a row of sums_
};

}  // namespace exphoton
