// SPDX-License-Identifier: BSD-2-Clause
#include "core/imaging/denoise/outliers.h"

#include <algorithm>
#include <array>
#include <vector>

#include "core/imaging/denoise/similar_pixels.h"

namespace exphoton {
namespace {

// Two sets of some hundred values of one distribution rarely have largest values that differ by
// this factor, unless the distribution has outliers.
constexpr float kMostBrightness = 4;
constexpr int kFewestSimilar = 20;
constexpr float kSimilar = .1f;  // the weight of a similar pixel

// What a pixel of one half may be, by the other half.
struct Bound {
  std::array<float, 3> brightest{0, 0, 0};
  int similar = 0;
};
using Bounds = std::array<std::vector<Bound>, 2>;

void FindBounds(const DenoiseLayers& layers, int y0, int y1, Bounds* bounds) {
  // Weights from the other half are those in the mean of this one.
  const auto add = [&](std::size_t half, float weight, std::size_t p, std::size_t q) {
    if (weight < kSimilar) return;
    Bound& bound = (*bounds)[half][p];
    ++bound.similar;
    for (std::size_t c = 0; c < 3; ++c)
      bound.brightest[c] = std::max(bound.brightest[c], layers.halves[1 - half][3 * q + c]);
  };
  SimilarPixels(layers, y0, y1).ForEach(add);
}

}  // namespace

Outliers DimOutliers(DenoiseLayers* layers, ThreadPool& threads) {
  Bounds bounds;
  for (auto& list : bounds) list.resize(layers->isValid.size());
  ForBands(layers->height, threads, [&](int y0, int y1) { FindBounds(*layers, y0, y1, &bounds); });
  Outliers outliers;
  double all = 0, removed = 0;
  for (std::size_t half = 0; half < 2; ++half) {
    for (std::size_t p = 0; p < bounds[half].size(); ++p) {
      if (!layers->isValid[p]) continue;
      const Bound& bound = bounds[half][p];
      bool isOutlier = false;
      for (std::size_t c = 0; c < 3; ++c) {
        float& value = layers->halves[half][3 * p + c];
        const float most = kMostBrightness * bound.brightest[c];
        all += double(value);
        if (bound.similar < kFewestSimilar || !(value > most)) continue;
        removed += double(value) - double(most);
        value = most;
        isOutlier = true;
      }
      outliers.pixels += isOutlier ? 1 : 0;
    }
  }
  if (outliers.pixels > 0) EstimateVariance(layers);
  if (all > 0) outliers.light = std::min(removed / all, 1.);
  return outliers;
}

}  // namespace exphoton
