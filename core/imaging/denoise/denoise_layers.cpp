// SPDX-License-Identifier: BSD-2-Clause
// The variance of a half is estimated from the difference of both. One difference is a poor
// estimate, so it is averaged over neighbouring pixels.
#include "core/imaging/denoise/denoise_layers.h"

#include <algorithm>
#include <cmath>

#include "core/imaging/denoise/denoise.h"

namespace exphoton {
namespace {

constexpr int kVarianceRadius = 2;
// Smallest tolerance of a feature: the square of a difference. Larger ones follow the feature's own
// change from pixel to pixel.
constexpr float kLeastTolerance = 1e-2f;

using Channels = std::vector<int>;

Channels Find(const Image& picture, const std::string& layer, const char* names) {
  Channels channels;
  for (const char* name = names; *name; ++name)
    channels.push_back(
        picture.FindChannel(layer.empty() ? std::string(1, *name) : layer + "." + *name));
  return channels;
}

bool IsWhole(const Channels& channels) {
  return std::find(channels.begin(), channels.end(), -1) == channels.end();
}

// Reads the channels of all pixels. Clears isValid where a value is not finite.
std::vector<float> Read(const Image& picture, const Channels& channels,
                        std::vector<char>* isValid) {
  std::vector<float> values;
  values.reserve(std::size_t(picture.Width()) * std::size_t(picture.Height()) * channels.size());
  for (int y = 0; y < picture.Height(); ++y)
    for (int x = 0; x < picture.Width(); ++x)
      for (const int channel : channels) {
        const float value = picture.At(x, y, channel);
        if (!std::isfinite(value))
          (*isValid)[std::size_t(y) * std::size_t(picture.Width()) + std::size_t(x)] = 0;
        values.push_back(std::isfinite(value) ? value : 0);
      }
  return values;
}

// Calls visit(pixel) for the valid pixels within `radius` of (x, y).
template <class Visit>
void VisitWindow(const DenoiseLayers& layers, int x, int y, int radius, const Visit& visit) {
  for (int v = std::max(y - radius, 0); v <= std::min(y + radius, layers.height - 1); ++v)
    for (int u = std::max(x - radius, 0); u <= std::min(x + radius, layers.width - 1); ++u)
      if (layers.isValid[layers.At(u, v)]) visit(layers.At(u, v));
}

// A feature that changes smoothly may differ from pixel to pixel by its gradient.
void FindTolerances(DenoiseLayers* layers) {
  constexpr std::size_t kCount = DenoiseLayers::kFeatures;
  layers->tolerances.assign(layers->features.size(), kLeastTolerance);
  const auto at = [&](int x, int y, std::size_t f) {
    const int u = std::clamp(x, 0, layers->width - 1), v = std::clamp(y, 0, layers->height - 1);
    return layers->features[kCount * layers->At(u, v) + f];
  };
  for (int y = 0; y < layers->height; ++y)
    for (int x = 0; x < layers->width; ++x)
      for (std::size_t f = 0; f < kCount; ++f) {
        // The smaller of the two one-sided differences: an edge is no gradient.
        const auto least = [&](int dx, int dy) {
          const float here = at(x, y, f);
          return std::min(std::abs(at(x + dx, y + dy, f) - here),
                          std::abs(at(x - dx, y - dy, f) - here));
        };
        const float across = least(1, 0), down = least(0, 1);
        float& tolerance = layers->tolerances[kCount * layers->At(x, y) + f];
        tolerance = std::max(tolerance, across * across + down * down);
      }
}

// Joins albedo, normal and the logarithm of the depth. A picture without depth has 0.
std::vector<float> ReadFeatures(const Image& picture, std::vector<char>* isValid) {
  const auto albedo = Read(picture, Find(picture, "albedo", "RGB"), isValid);
  const auto normal = Read(picture, Find(picture, "N", "XYZ"), isValid);
  const Channels z = Find(picture, "", "Z");
  const auto depth = IsWhole(z) ? Read(picture, z, isValid) : std::vector<float>();
  std::vector<float> features;
  for (std::size_t pixel = 0; pixel < albedo.size() / 3; ++pixel) {
    for (std::size_t c = 0; c < 3; ++c) features.push_back(albedo[3 * pixel + c]);
    for (std::size_t c = 0; c < 3; ++c) features.push_back(normal[3 * pixel + c]);
    features.push_back(depth.empty() ? 0 : std::log(std::max(std::abs(depth[pixel]), 1e-20f)));
  }
  return features;
}

}  // namespace

std::vector<std::string> MissingDenoiseLayers(const Image& picture) {
  std::vector<std::string> missing;
  for (const char* half : {"half1", "half2", "albedo"})
    if (!IsWhole(Find(picture, half, "RGB"))) missing.emplace_back(half);
  if (!IsWhole(Find(picture, "N", "XYZ"))) missing.emplace_back("N");
  return missing;
}

void EstimateVariance(DenoiseLayers* layers) {
  layers->variance.assign(layers->halves[0].size(), 0);
  for (int y = 0; y < layers->height; ++y)
    for (int x = 0; x < layers->width; ++x) {
      double sums[3] = {0, 0, 0};
      int count = 0;
      VisitWindow(*layers, x, y, kVarianceRadius, [&](std::size_t pixel) {
        ++count;
        for (std::size_t c = 0; c < 3; ++c) {
          const double difference =
              double(layers->halves[0][3 * pixel + c]) - double(layers->halves[1][3 * pixel + c]);
          sums[c] += difference * difference / 2;
        }
      });
      for (std::size_t c = 0; c < 3 && count > 0; ++c)
        layers->variance[3 * layers->At(x, y) + c] = float(sums[c] / count);
    }
}

DenoiseLayers ReadDenoiseLayers(const Image& picture) {
  DenoiseLayers layers;
  layers.width = picture.Width();
  layers.height = picture.Height();
  layers.isValid.assign(std::size_t(layers.width) * std::size_t(layers.height), 1);
  Read(picture, Find(picture, "", "RGB"), &layers.isValid);
  layers.halves[0] = Read(picture, Find(picture, "half1", "RGB"), &layers.isValid);
  layers.halves[1] = Read(picture, Find(picture, "half2", "RGB"), &layers.isValid);
  layers.features = ReadFeatures(picture, &layers.isValid);
  EstimateVariance(&layers);
  FindTolerances(&layers);
  return layers;
}

}  // namespace exphoton
