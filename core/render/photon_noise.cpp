// SPDX-License-Identifier: BSD-2-Clause
#include "core/render/photon_noise.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/files/byte_archive.h"
#include "core/imaging/metrics/metrics.h"

namespace exphoton {

PhotonNoise::PhotonNoise(const PixelBounds& crop)
    : crop_(crop),
      current_(3 * std::size_t(crop.Width()) * std::size_t(crop.Height())),
      sums_(current_.size()),
      squares_(current_.size()) {}

void PhotonNoise::Add(Point2i pixel, const Spectrum& signedLight, Real weight) {
  if (!crop_.Contains(pixel.x, pixel.y) || !signedLight.IsFinite()) return;
  float* const sums = current_.data() + 3 * IndexOf(pixel);
  for (int c = 0; c < Spectrum::kChannels; ++c) sums[c] += float(signedLight[c] * weight);
}

void PhotonNoise::ClearPixel(Point2i pixel) {
  if (!crop_.Contains(pixel.x, pixel.y)) return;
  std::fill_n(current_.begin() + std::ptrdiff_t(3 * IndexOf(pixel)), 3, 0.F);
}

void PhotonNoise::EndPass(std::int64_t samplesPerPixel) {
  for (std::size_t i = 0; i < current_.size(); ++i) {
    sums_[i] += current_[i];
    squares_[i] += current_[i] * current_[i];
  }
  std::fill(current_.begin(), current_.end(), 0.F);
  ++passes_;
  samples_ += double(samplesPerPixel);
  squaredSamples_ += double(samplesPerPixel) * double(samplesPerPixel);
}

// The sum of the products of all pairs of different passes is the square of the sum minus the sum
// of the squares.
double PhotonNoise::RelativeVariance(const std::vector<double>& levels) const {
  double sum = 0;
  for (std::size_t i = 0; i < levels.size(); ++i) {
    const double products = double(sums_[i]) * double(sums_[i]) - double(squares_[i]);
    sum += products / (levels[i] + kRelMseOffset);
  }
  const double pairs = samples_ * samples_ - squaredSamples_;
  const double mean = sum / (pairs * double(levels.size()));
  return std::isfinite(mean) ? std::max(mean, 0.) : std::numeric_limits<double>::infinity();
}

void PhotonNoise::Transfer(ByteArchive* archive) {
  archive->Values(&passes_, &samples_, &squaredSamples_);
  for (auto* values : {&current_, &sums_, &squares_})
    for (float& value : *values) archive->Values(&value);
  const bool hasPairs = passes_ < 2 || samples_ * samples_ > squaredSamples_;
  if (passes_ < 0 || !(samples_ >= double(passes_)) || !std::isfinite(samples_) || !hasPairs)
    throw ArchiveError("its counts of passes contradict each other");
}

}  // namespace exphoton
