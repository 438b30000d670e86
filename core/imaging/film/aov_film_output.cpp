// SPDX-License-Identifier: BSD-2-Clause
// AovFilm: output of the sums as channels, in the order of the AOVs.
#include <algorithm>
#include <cmath>

#include "core/imaging/film/aov_film.h"

namespace exphoton {

double AovFilm::MeanOf(std::size_t pixel, std::size_t value) const {
  const Weights& weights = weights_[pixel];
  const Value& v = values_[pixel * valueCount_ + value];
  if (weights.samples == 0) return 0;
  if (std::abs(weights.sum) >= .5 * double(weights.absSum) && weights.sum != 0)
    return v.sum / weights.sum;
  return weights.absSum > 0 ? double(v.absSum) / double(weights.absSum) : 0;
}

// Returns the variance of the quotient R = sum(w L) / sum(w), to first order: the sum of (w (L -
// R))^2, divided by sum(w)^2. The samples are assumed to be independent. Splatted samples come with
// covariances that are unbiased already.
double AovFilm::VarianceOf(std::size_t pixel, std::size_t channel) const {
  const Weights& weights = weights_[pixel];
  const double n = double(weights.samples);
  const double sum = std::max(std::abs(weights.sum), .5 * double(weights.absSum));
  if (weights.samples < 2 && !isSplatted_) return 0;
  const Moments& m = moments_[pixel * 3 + channel];
  if (!(sum > 0)) return 0;
  const double mean = m.wL / sum;
  const double squares = m.wwLL - 2 * mean * m.wwL + mean * mean * weights.sumOfSquares;
  if (isSplatted_) return std::max(squares, 0.) / (sum * sum);
  return std::max(squares, 0.) * n / ((n - 1) * sum * sum);
}

double AovFilm::SharingBiasOf(std::size_t pixel, std::size_t channel) const {
  const Bias& bias = biases_[pixel];
  return bias.samples > 0 ? bias.sums[channel] / bias.samples : 0;
}

// Normals are averaged to a direction. Properties of a surface are means over the samples that hit
// one.
void AovFilm::CollectSurface(Aov aov, std::size_t pixel, const double* sums, float* out) const {
  const std::size_t count = GetAovInfo(aov).channels.size();
  double weight = surfaceWeights_[pixel].hit;
  if (aov == Aov::Albedo || aov == Aov::PhotonDensity) weight = surfaceWeights_[pixel].all;
  if (aov == Aov::Normal || aov == Aov::GeometricNormal)
    weight = std::hypot(sums[0], sums[1], sums[2]);
  for (std::size_t c = 0; c < count; ++c) out[c] = weight > 0 ? float(sums[c] / weight) : 0;
}

// Returns a value that is neither of a surface nor light.
double AovFilm::OtherValue(Aov aov, std::size_t pixel, std::size_t channel,
                           double lightScale) const {
  switch (aov) {
    case Aov::ObjectId:
      return objects_[pixel].id;
    case Aov::MaterialId:
      return materials_[pixel].id;
    case Aov::Variance:
      return VarianceOf(pixel, channel) * lightScale * lightScale;
    case Aov::Time:
      return 1e3 * seconds_[pixel];
    case Aov::Samples:
      return double(weights_[pixel].samples);
    case Aov::SharingBias:
      return SharingBiasOf(pixel, channel) * lightScale;
    default:
      return reads_[pixel] > 0 ? distances_[pixel] / double(reads_[pixel]) : 0;
  }
}

void AovFilm::Collect(std::size_t pixel, const std::array<double, 4>& beauty, double lightScale,
                      float* out) const {
  std::size_t value = 0;
  const double* sums = surfaceValues_.data() + pixel * surfaceCount_;
  for (const Aov aov : aovs_) {
    const std::size_t channels = GetAovInfo(aov).channels.size();
    if (kOwn.Without(kIds).Has(aov)) {
      CollectSurface(aov, pixel, sums, out);
      sums += channels;
      out += channels;
      continue;
    }
    if (kCryptomatte.Has(aov)) {
      (aov == Aov::CryptoObject ? objectShares_ : materialShares_).Rank(pixel, out);
      out += channels;
      continue;
    }
    for (std::size_t c = 0; c < channels; ++c) {
      const double x = kLightAovs.Has(aov)
                           ? MeanOf(pixel, value++) * (beauty[c] < 0 ? 0 : lightScale)
                           : OtherValue(aov, pixel, c, lightScale);
      *out++ = float(x);
    }
  }
}

void AovFilm::AppendTo(const Film& film, bool premultiplyAlpha, Image* image) const {
  std::vector<std::string> names;
  for (const Aov aov : aovs_) {
    const auto& channels = GetAovInfo(aov).channels;
    names.insert(names.end(), channels.begin(), channels.end());
    if (GetAovInfo(aov).isExact) image->exactChannels.insert(channels.begin(), channels.end());
  }
  std::vector<float> values(names.size() * weights_.size());
  std::size_t at = 0;
  for (int y = crop_.y0; y < crop_.y1; ++y) {
    for (int x = crop_.x0; x < crop_.x1; ++x, ++at) {
      const std::array<double, 4> beauty = film.MeanOf({x, y});
      const double scale = premultiplyAlpha ? std::clamp(beauty[3], 0., 1.) : 1;
      Collect(at, beauty, scale, values.data() + at * names.size());
    }
  }
  AppendChannels(names, values, image);
}

void AppendChannels(const std::vector<std::string>& names, const std::vector<float>& values,
                    Image* image) {
  const std::size_t before = image->channels.size(), added = names.size();
  const std::size_t pixels = added == 0 ? 0 : values.size() / added;
  std::vector<float> all;
  all.reserve(image->pixels.size() + values.size());
  for (std::size_t i = 0; i < pixels; ++i) {
    const auto old = image->pixels.begin() + std::ptrdiff_t(i * before);
    const auto own = values.begin() + std::ptrdiff_t(i * added);
    all.insert(all.end(), old, old + std::ptrdiff_t(before));
    all.insert(all.end(), own, own + std::ptrdiff_t(added));
  }
  if (added == 0) return;
  image->pixels = std::move(all);
  image->channels.insert(image->channels.end(), names.begin(), names.end());
}

}  // namespace exphoton
