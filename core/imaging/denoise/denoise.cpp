// SPDX-License-Identifier: BSD-2-Clause
// Denoise goes through the window offset by offset. For each offset, the distance of two pixels is
// computed once, and the mean over a patch decides the weight. The window is processed in bands of
// rows, each by one thread, and each pixel adds its terms in the same order.
#include "core/imaging/denoise/denoise.h"

#include <algorithm>
#include <cmath>

#include "core/imaging/denoise/denoise_layers.h"

namespace exphoton {
namespace {

constexpr int kWindow = 7;       // pixels in each direction
constexpr int kPatch = 2;        // the same for the patch
constexpr float kColor = .8f;    // differences below this many standard deviations count less
constexpr float kFeature = .6f;  // the same for features and their tolerance
// A pixel with little noise does not take over the outliers of a pixel with much noise.
constexpr float kMostVarianceRatio = 4;
constexpr int kBandRows = 16;

// Sums of one pixel, three channels for each half.
struct Sums {
  double weights[2] = {0, 0};
  double changes[2][3] = {{0, 0, 0}, {0, 0, 0}};  // of weight times difference to the pixel itself
};

// Returns the squared difference of colours in units of their variance, without the part that noise
// is expected to have (Rousselle et al. 2012, eq. 4).
float ColorDistance(const DenoiseLayers& layers, std::size_t half, std::size_t p, std::size_t q) {
  float sum = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    const float u = layers.halves[half][3 * p + c], v = layers.halves[half][3 * q + c];
    const float varU = layers.variance[3 * p + c], varV = layers.variance[3 * q + c];
    // Without noise, only equal colours are similar.
    const float least = 1e-10f * (u * u + v * v) + 1e-30f;
    sum += ((u - v) * (u - v) - (varU + std::min(varU, varV))) /
           (least + kColor * kColor * (varU + std::min(varV, kMostVarianceRatio * varU)));
  }
  return sum / 3;
}

// Returns the largest squared difference of a feature in units of its tolerance.
float FeatureDistance(const DenoiseLayers& layers, std::size_t p, std::size_t q) {
  float largest = 0;
  for (std::size_t f = 0; f < DenoiseLayers::kFeatures; ++f) {
    const std::size_t at = DenoiseLayers::kFeatures * p + f;
    const float difference =
        layers.features[at] - layers.features[DenoiseLayers::kFeatures * q + f];
    largest =
        std::max(largest, difference * difference / (kFeature * kFeature * layers.tolerances[at]));
  }
  return largest;
}

// One band of rows, with its scratch memory.
class Band {
 public:
  Band(const DenoiseLayers& layers, int y0, int y1)
      : layers_(layers), y0_(y0), y1_(y1), sums_(std::size_t((y1 - y0) * layers.width)) {
    const std::size_t rows = std::size_t(y1 - y0 + 2 * kPatch);
    for (auto& list : distances_) list.resize(rows * std::size_t(layers.width));
  }

  // Returns the filtered change of each pixel and half, six numbers a pixel.
  std::vector<float> Filter() {
    for (int dy = -kWindow; dy <= kWindow; ++dy)
      for (int dx = -kWindow; dx <= kWindow; ++dx) AddOffset(dx, dy);
    std::vector<float> changes;
    for (const Sums& sums : sums_)
      for (int half = 0; half < 2; ++half)
        for (const double change : sums.changes[half])
          changes.push_back(sums.weights[half] > 0 ? float(change / sums.weights[half]) : 0);
    return changes;
  }

 private:
  static constexpr float kNone = -1e30f;  // the pixel or its partner is outside or not valid

  void AddOffset(int dx, int dy) {
    FindDistances(dx, dy);
    for (int y = y0_; y < y1_; ++y)
      for (int x = 0; x < layers_.width; ++x) {
        if (!HasPair(x, y, dx, dy)) continue;
        const std::size_t p = layers_.At(x, y), q = layers_.At(x + dx, y + dy);
        const float feature = FeatureDistance(layers_, p, q);
        if (feature > kLargestDistance) continue;
        for (std::size_t half = 0; half < 2; ++half) {
          const float distance = std::max(PatchDistance(x, y, half), feature);
          if (distance > kLargestDistance) continue;
          // The weights of one half average the other half.
          Add(std::exp(-distance), 1 - half, p, q);
        }
      }
  }

  void Add(float weight, std::size_t half, std::size_t p, std::size_t q) {
    Sums& sums = sums_[p - layers_.At(0, y0_)];
    sums.weights[half] += double(weight);
    for (std::size_t c = 0; c < 3; ++c)
      sums.changes[half][c] += double(weight) * (double(layers_.halves[half][3 * q + c]) -
                                                 double(layers_.halves[half][3 * p + c]));
  }

  bool HasPair(int x, int y, int dx, int dy) const {
    const int u = x + dx, v = y + dy;
    return y >= 0 && y < layers_.height && u >= 0 && u < layers_.width && v >= 0 &&
           v < layers_.height && layers_.isValid[layers_.At(x, y)] &&
           layers_.isValid[layers_.At(u, v)];
  }

  void FindDistances(int dx, int dy) {
    std::size_t at = 0;
    for (int y = y0_ - kPatch; y < y1_ + kPatch; ++y)
      for (int x = 0; x < layers_.width; ++x, ++at) {
        const bool hasPair = HasPair(x, y, dx, dy);
        for (std::size_t half = 0; half < 2; ++half)
          distances_[half][at] =
              hasPair ? ColorDistance(layers_, half, layers_.At(x, y), layers_.At(x + dx, y + dy))
                      : kNone;
      }
  }

  // Returns the mean distance over the patch, at least 0.
  float PatchDistance(int x, int y, std::size_t half) const {
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

  static constexpr float kLargestDistance = 12;  // exp(-12) is less than 1e-5

  const DenoiseLayers& layers_;
  int y0_, y1_;
  std::vector<Sums> sums_;
  std::vector<float> distances_[2];
};

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

// Adds the mean change of the halves to each pixel.
void Apply(const DenoiseLayers& layers, const std::vector<float>& changes, DenoiseResult* result) {
  NoiseSum before, after;
  const int channels[3] = {result->picture.FindChannel("R"), result->picture.FindChannel("G"),
                           result->picture.FindChannel("B")};
  for (std::size_t p = 0; p < layers.isValid.size(); ++p) {
    if (!layers.isValid[p]) {
      ++result->nonFinite;
      continue;
    }
    const int x = int(p % std::size_t(layers.width)), y = int(p / std::size_t(layers.width));
    for (std::size_t c = 0; c < 3; ++c) {
      const double a = double(layers.halves[0][3 * p + c]), b = double(layers.halves[1][3 * p + c]);
      const double changeA = double(changes[6 * p + c]), changeB = double(changes[6 * p + 3 + c]);
      before.Add(a, b);
      after.Add(a + changeA, b + changeB);
      result->picture.At(x, y, channels[c]) += float((changeA + changeB) / 2);
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
  const DenoiseLayers layers = ReadDenoiseLayers(picture);
  std::vector<float> changes(layers.isValid.size() * 6);
  threads.For((layers.height + kBandRows - 1) / kBandRows, [&](std::int64_t index, int) {
    const int y0 = int(index) * kBandRows, y1 = std::min(y0 + kBandRows, layers.height);
    const std::vector<float> part = Band(layers, y0, y1).Filter();
    std::copy(part.begin(), part.end(), changes.begin() + std::ptrdiff_t(6 * layers.At(0, y0)));
  });
  DenoiseResult result;
  result.picture = KeptLayers(picture);
  Apply(layers, changes, &result);
  return result;
}

}  // namespace exphoton
