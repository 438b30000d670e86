// SPDX-License-Identifier: BSD-2-Clause
// Denoise goes through the picture in bands of rows, each by one thread. It first dims outliers,
// then averages similar pixels.
#include "core/imaging/denoise/denoise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/imaging/denoise/denoise_layers.h"
#include "core/imaging/denoise/outliers.h"
#include "core/imaging/denoise/similar_pixels.h"

namespace exphoton {
namespace {

// Sums of one pixel, three channels for each half.
struct Sums {
  double weights[2] = {0, 0};
  double changes[2][3] = {{0, 0, 0}, {0, 0, 0}};  // of weight times difference to the pixel itself
};

// Sets the change of each pixel and half in rows [y0, y1), six numbers a pixel.
void FilterBand(const DenoiseLayers& layers, int y0, int y1, std::vector<float>* changes) {
  const std::size_t first = layers.At(0, y0);
  std::vector<Sums> sums(layers.At(0, y1) - first);
  const auto add = [&](std::size_t half, float weight, std::size_t p, std::size_t q) {
    Sums& sum = sums[p - first];
    sum.weights[half] += double(weight);
    for (std::size_t c = 0; c < 3; ++c)
      sum.changes[half][c] += double(weight) * (double(layers.halves[half][3 * q + c]) -
                                                double(layers.halves[half][3 * p + c]));
  };
  SimilarPixels(layers, y0, y1).ForEach(add);
  auto change = changes->begin() + std::ptrdiff_t(6 * first);
  for (const Sums& sum : sums)
    for (std::size_t half = 0; half < 2; ++half)
      for (const double ofChannel : sum.changes[half])
        *change++ = sum.weights[half] > 0 ? float(ofChannel / sum.weights[half]) : 0;
}

// Adds up noise as part of relMSE: variance of the mean of two halves over squared radiance.
class NoiseSum {
 public:
  void Add(double a, double b) {
    const double mean = (a + b) / 2, difference = a - b;
    sum_ += difference * difference / 4 / (mean * mean + .01);
    ++count_;
  }
  double Mean() const { return count_ > 0 ? sum_ / double(count_) : 0; }

 private:
  double sum_ = 0;
  long long count_ = 0;
};

// Returns the picture without the layers that no longer describe it.
Image KeptLayers(const Image& picture) {
  std::vector<int> kept;
  std::vector<std::string> names;
  for (int c = 0; c < picture.ChannelCount(); ++c) {
    const std::string& name = picture.channels[std::size_t(c)];
    if (name.starts_with("half1.") || name.starts_with("half2.") || name.starts_with("variance."))
      continue;
    kept.push_back(c);
    names.push_back(name);
  }
  Image result(picture.data, picture.display, names);
  result.attributes = picture.attributes;
  for (const std::string& name : names)
    if (picture.exactChannels.contains(name)) result.exactChannels.insert(name);
  for (int y = 0; y < picture.Height(); ++y)
    for (int x = 0; x < picture.Width(); ++x)
      for (std::size_t c = 0; c < kept.size(); ++c)
        result.At(x, y, int(c)) = picture.At(x, y, kept[c]);
  return result;
}

// Returns the share of the first half in a pixel of the picture, from three channels. Splatted
// samples give the halves of a pixel different weights. Halves that hardly differ say little about
// the share, which is then near 1/2.
double ShareOfFirst(const std::array<double, 3>& picture, const float* first, const float* second) {
  constexpr double kRounding = 1e-6;  // of the squares: a picture of 16 bits has 3 digits
  double products = 0, squares = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    const double a = double(first[c]), b = double(second[c]), mean = (a + b) / 2;
    products += (picture[c] - mean) * (a - b);
    squares += (a - b) * (a - b) + kRounding * mean * mean;
  }
  return squares > 0 ? std::clamp(.5 + products / squares, 0., 1.) : .5;
}

// Adds the changes of the halves to each pixel, weighted by their shares in it. `halves` are those
// of the picture, and `layers` those that were filtered.
void Apply(const std::array<std::vector<float>, 2>& halves, const DenoiseLayers& layers,
           const std::vector<float>& changes, DenoiseResult* result) {
  NoiseSum before, after;
  const int channels[3] = {result->picture.FindChannel("R"), result->picture.FindChannel("G"),
                           result->picture.FindChannel("B")};
  for (std::size_t p = 0; p < layers.isValid.size(); ++p) {
    if (!layers.isValid[p]) {
      ++result->nonFinite;
      continue;
    }
    const int x = int(p % std::size_t(layers.width)), y = int(p / std::size_t(layers.width));
    const auto at = [&](std::size_t c) -> float& { return result->picture.At(x, y, channels[c]); };
    const double share = ShareOfFirst({double(at(0)), double(at(1)), double(at(2))},
                                      halves[0].data() + 3 * p, halves[1].data() + 3 * p);
    for (std::size_t c = 0; c < 3; ++c) {
      double was[2], is[2];
      for (std::size_t half = 0; half < 2; ++half) {
        was[half] = double(halves[half][3 * p + c]);
        is[half] = double(layers.halves[half][3 * p + c]) + double(changes[6 * p + 3 * half + c]);
      }
      before.Add(was[0], was[1]);
      after.Add(is[0], is[1]);
      const double change = share * (is[0] - was[0]) + (1 - share) * (is[1] - was[1]);
      if (change != 0) at(c) = float(std::max(double(at(c)) + change, 0.));
    }
  }
  result->noise = before.Mean();
  result->residualNoise = after.Mean();
}

}  // namespace

DenoiseResult Denoise(const Image& picture, ThreadPool& threads) {
  for (const char* channel : {"R", "G", "B"})
    if (picture.FindChannel(channel) < 0)
      throw ImageError("the picture has no channels R, G and B");
  DenoiseLayers layers = ReadDenoiseLayers(picture);
  const auto halves = layers.halves;
  DenoiseResult result;
  result.outliers = DimOutliers(&layers, threads);
  std::vector<float> changes(layers.isValid.size() * 6);
  ForBands(layers.height, threads, [&](int y0, int y1) { FilterBand(layers, y0, y1, &changes); });
  result.picture = KeptLayers(picture);
  Apply(halves, layers, changes, &result);
  return result;
}

}  // namespace exphoton
