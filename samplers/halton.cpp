// SPDX-License-Identifier: BSD-2-Clause
// The sampler "halton" takes the points of a pixel from the Halton sequence in the bases 2 and 3,
// scrambled for each pixel and request. Any number of samples is well distributed.
#include "core/plugin.h"
#include "samplers/common/halton_points.h"

namespace exphoton {
namespace {

constexpr std::uint64_t kGolden = 0x9e3779b97f4a7c15ull;
constexpr int kMaxCount = 1 << 30;

struct Settings {
  int pixelSamples = 4;
};

const ParamTable<Settings>& Parameters() {
  static const ParamTable<Settings> table{
      Param("pixelsamples", &Settings::pixelSamples, "samples a pixel").Range(1, kMaxCount)};
  return table;
}

class HaltonSampler final : public Sampler {
 public:
  explicit HaltonSampler(std::int64_t count) : count_(count) {}

  std::int64_t SamplesPerPixel() const override { return count_; }
  std::unique_ptr<Sampler> WithSamplesPerPixel(std::int64_t count) const override {
    return std::make_unique<HaltonSampler>(std::clamp<std::int64_t>(count, 1, kMaxCount));
  }

  std::uint64_t FillCamera(const SampleKey& key, CameraSamples* samples) const override {
    const std::uint64_t pixelKey =
        HashKey({key.seed, std::uint64_t(key.pixel.x), std::uint64_t(key.pixel.y), 0x68616c74});
    samples->film = Points(pixelKey, key.index, 1).Both();
    if (samples->NeedsLens()) samples->lens = Points(pixelKey, key.index, 2).Both();
    if (samples->NeedsTime()) samples->time = Points(pixelKey, key.index, 3).First();
    return pixelKey;
  }
  void Fill(std::uint64_t pixelKey, std::int64_t index, int request,
            std::span<Real> values) const override {
    Points(pixelKey, index, kFirstArray + request).Fill(values);
  }
  void Fill(std::uint64_t pixelKey, std::int64_t index, int request,
            std::span<Point2> values) const override {
    Points(pixelKey, index, kFirstArray + request).Fill(values);
  }

 private:
  static constexpr int kFirstArray = 4;  // after film, lens and time

  HaltonPoints Points(std::uint64_t pixelKey, std::int64_t sample, int request) const {
    return {pixelKey + kGolden * std::uint64_t(request), sample, count_};
  }

  std::int64_t count_;
};

std::unique_ptr<Sampler> Create(const Settings& settings, const SamplerContext&) {
  return std::make_unique<HaltonSampler>(settings.pixelSamples);
}

}  // namespace
}  // namespace exphoton

EXPHOTON_SAMPLER("halton", "scrambled Halton points")
