// SPDX-License-Identifier: BSD-2-Clause
// SimilarPixels finds the pixels of a window that probably show the same light as its centre, by
// the distance of non-local means (Rousselle, Knaus and Zwicker 2012) and by the layers of the
// first surface (Rousselle, Manzi and Zwicker 2013). It works on one band of rows, offset by
// offset, because the distances of all pixels at one offset are shared by their patches.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/base/parallel.h"
#include "core/imaging/denoise/denoise_layers.h"

namespace exphoton {

class SimilarPixels {
 public:
  // Rows [y0, y1).
  SimilarPixels(const DenoiseLayers& layers, int y0, int y1);

  // Calls visit(half, weight, p, q) for each pixel p of the band and each similar pixel q of its
  // window. The weight of q in the mean of `half` is in (0, 1]. It comes from the other half, so
  // that an outlier does not choose its own weight. The order does not depend on other bands.
  template <class Visit>
  void ForEach(const Visit& visit) {
    for (int dy = -kWindow; dy <= kWindow; ++dy)
      for (int dx = -kWindow; dx <= kWindow; ++dx) VisitOffset(dx, dy, visit);
  }

 private:
  static constexpr int kWindow = 7;              // pixels in each direction
  static constexpr float kLargestDistance = 12;  // exp(-12) is less than 1e-5

  template <class Visit>
  void VisitOffset(int dx, int dy, const Visit& visit) {
    FindDistances(dx, dy);
    for (int y = y0_; y < y1_; ++y)
      for (int x = 0; x < layers_.width; ++x) {
        if (!HasPair(x, y, dx, dy)) continue;
        const std::size_t p = layers_.At(x, y), q = layers_.At(x + dx, y + dy);
        const float feature = FeatureDistance(p, q);
        if (feature > kLargestDistance) continue;
        for (std::size_t half = 0; half < 2; ++half) {
          const float distance = std::max(PatchDistance(x, y, 1 - half), feature);
          if (distance <= kLargestDistance) visit(half, std::exp(-distance), p, q);
        }
      }
  }

  bool HasPair(int x, int y, int dx, int dy) const;
  void FindDistances(int dx, int dy);
  float ColorDistance(std::size_t half, std::size_t p, std::size_t q) const;
  float FeatureDistance(std::size_t p, std::size_t q) const;
  // Returns the mean distance over the patch, at least 0.
  float PatchDistance(int x, int y, std::size_t half) const;

  const DenoiseLayers& layers_;
  int y0_, y1_;
  std::vector<float> distances_[2];  // of the colours at the current offset
};

// Calls run(y0, y1) for bands of rows [y0, y1), each by one thread.
template <class Run>
void ForBands(int height, ThreadPool& threads, const Run& run) {
  constexpr int kRows = 16;
  threads.For((height + kRows - 1) / kRows, [&](std::int64_t band, int) {
    const int y0 = int(band) * kRows;
    run(y0, std::min(y0 + kRows, height));
  });
}

}  // namespace exphoton
