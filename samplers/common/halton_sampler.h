// SPDX-License-Identifier: BSD-2-Clause
// HaltonArraySampler is the shared part of the samplers whose arrays and times are scrambled Halton
// points: their parameter, the number of samples and the arrays.
#pragma once

#include "core/plugin.h"
#include "samplers/common/halton_points.h"

namespace exphoton {

struct PixelSamplesSettings {
  int pixelSamples = 4;
};

inline constexpr int kMaxPixelSamples = 1 << 30;

inline const ParamTable<PixelSamplesSettings>& PixelSamplesParameters() {
  static const ParamTable<PixelSamplesSettings> table{
      Param("pixelsamples", &PixelSamplesSettings::pixelSamples, "samples a pixel")
          .Range(1, kMaxPixelSamples)};
  return table;
}

// S is the sampler that derives from this class. Its constructor takes the number of samples.
template <class S>
class HaltonArraySampler : public Sampler {
 public:
  explicit HaltonArraySampler(std::int64_t count) : count_(count) {}

  std::int64_t SamplesPerPixel() const final { return count_; }
  std::unique_ptr<Sampler> WithSamplesPerPixel(std::int64_t count) const final {
    return std::make_unique<S>(std::clamp<std::int64_t>(count, 1, kMaxPixelSamples));
  }
  void Fill(std::uint64_t pixelKey, std::int64_t index, int request,
            std::span<Real> values) const final {
    Points(pixelKey, index, kFirstArray + request).Fill(values);
  }
  void Fill(std::uint64_t pixelKey, std::int64_t index, int request,
            std::span<Point2> values) const final {
    Points(pixelKey, index, kFirstArray + request).Fill(values);
  }

 protected:
  // The requests of a camera sample. Arrays follow them.
  enum { kFilm = 1, kLens, kTime, kFirstArray };

  HaltonPoints Points(std::uint64_t pixelKey, std::int64_t sample, int request) const {
    constexpr std::uint64_t kGolden = 0x9e3779b97f4a7c15ull;
    return {pixelKey + kGolden * std::uint64_t(request), sample, count_};
  }

 private:
  std::int64_t count_;
};

}  // namespace exphoton
