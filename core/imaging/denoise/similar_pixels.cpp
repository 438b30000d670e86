// SPDX-License-Identifier: BSD-2-Clause
#include "core/imaging/denoise/similar_pixels.h"

#include <algorithm>

namespace exphoton {
namespace {

constexpr int kPatch = 2;        // pixels in each direction
constexpr float kColor = .8f;    // differences below this many standard deviations count less
constexpr float kFeature = .6f;  // the same for features and their tolerance
// A pixel with little noise does not take over the outliers of a pixel with much noise.
constexpr float kMostVarianceRatio = 4;
constexpr float kNone = -1e30f;  // the pixel or its partner is outside or not valid

}  // namespace

SimilarPixels::SimilarPixels(const DenoiseLayers& layers, int y0, int y1)
    : layers_(layers), y0_(y0), y1_(y1) {
  const std::size_t rows = std::size_t(y1 - y0 + 2 * kPatch);
  for (auto& list : distances_) list.resize(rows * std::size_t(layers.width));
}

bool SimilarPixels::HasPair(int x, int y, int dx, int dy) const {
  const int u = x + dx, v = y + dy;
  return y >= 0 && y < layers_.height && u >= 0 && u < layers_.width && v >= 0 &&
         v < layers_.height && layers_.isValid[layers_.At(x, y)] &&
         layers_.isValid[layers_.At(u, v)];
}

void SimilarPixels::FindDistances(int dx, int dy) {
  std::size_t at = 0;
  for (int y = y0_ - kPatch; y < y1_ + kPatch; ++y)
    for (int x = 0; x < layers_.width; ++x, ++at) {
      const bool hasPair = HasPair(x, y, dx, dy);
      for (std::size_t half = 0; half < 2; ++half)
        distances_[half][at] =
            hasPair ? ColorDistance(half, layers_.At(x, y), layers_.At(x + dx, y + dy)) : kNone;
    }
}

// Returns the squared difference of colours in units of their variance, without the part that noise
// is expected to have (Rousselle et al. 2012, eq. 4).
float SimilarPixels::ColorDistance(std::size_t half, std::size_t p, std::size_t q) const {
  float sum = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    const float u = layers_.halves[half][3 * p + c], v = layers_.halves[half][3 * q + c];
    const float varU = layers_.variance[3 * p + c], varV = layers_.variance[3 * q + c];
    // Without noise, only equal colours are similar.
    const float least = 1e-10f * (u * u + v * v) + 1e-30f;
    sum += ((u - v) * (u - v) - (varU + std::min(varU, varV))) /
           (least + kColor * kColor * (varU + std::min(varV, kMostVarianceRatio * varU)));
  }
  return sum / 3;
}

// Returns the largest squared difference of a feature in units of its tolerance.
float SimilarPixels::FeatureDistance(std::size_t p, std::size_t q) const {
  float largest = 0;
  for (std::size_t f = 0; f < DenoiseLayers::kFeatures; ++f) {
    const std::size_t at = DenoiseLayers::kFeatures * p + f;
    const float difference =
        layers_.features[at] - layers_.features[DenoiseLayers::kFeatures * q + f];
    largest =
        std::max(largest, difference * difference / (kFeature * kFeature * layers_.tolerances[at]));
  }
  return largest;
}

float SimilarPixels::PatchDistance(int x, int y, std::size_t half) const {
  float sum = 0;
  int count = 0;
  for (int v = y - kPatch; v <= y + kPatch; ++v)
    for (int u = std::max(x - kPatch, 0); u <= std::min(x + kPatch, layers_.width - 1); ++u) {
      const std::size_t at =
          std::size_t(v - y0_ + kPatch) * std::size_t(layers_.width) + std::size_t(u);
      const float distance = distances_[half][at];
      if (distance == kNone) continue;
      sum += distance;
      ++count;
    }
  return std::max(0.f, sum / float(std::max(count, 1)));
}

}  // namespace exphoton
