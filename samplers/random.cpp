// SPDX-License-Identifier: BSD-2-Clause
// The sampler "random" generates independent uniform points. It converges slowest, and is the
// baseline for the other samplers.
#include "core/math/sampling/random.h"
#include "core/plugin.h"

namespace exphoton {
namespace {

struct Settings {
  int xSamples = 2, ySamples = 2;
  std::optional<int> pixelSamples;
};

const ParamTable<Settings>& Parameters() {
  static const ParamTable<Settings> table{
      Param("xsamples", &Settings::xSamples, "samples a pixel, together with ysamples")
          .Range(1, 32768),
      Param("ysamples", &Settings::ySamples, "samples a pixel are xsamples times ysamples")
          .Range(1, 32768),
      Param("pixelsamples", &Settings::pixelSamples,
            "version 2's number of samples a pixel, in place of the other two")
          .Range(1, 1 << 30)};
  return table;
}

class RandomSampler final : public Sampler {
 public:
  explicit RandomSampler(std::int64_t count) : count_(count) {}

  std::int64_t SamplesPerPixel() const override { return count_; }
  bool IsProgressive() const override { return true; }
  std::unique_ptr<Sampler> WithSamplesPerPixel(std::int64_t count) const override {
    return std::make_unique<RandomSampler>(count);
  }

  std::uint64_t FillCamera(const SampleKey& key, CameraSamples* samples) const override {
    const std::uint64_t sampleKey =
        HashKey({key.seed, std::uint64_t(key.pixel.x), std::uint64_t(key.pixel.y),
                 std::uint64_t(key.index), 0x72616e64});
    RandomStream random(sampleKey);
    samples->film = NextPoint(&random);
    samples->lens = NextPoint(&random);
    samples->time = random.Uniform();
    return sampleKey;
  }
  void Fill(std::uint64_t sampleKey, std::int64_t, int request,
            std::span<Real> values) const override {
    RandomStream random = StreamOf(sampleKey, request);
    for (Real& u : values) u = random.Uniform();
  }
  void Fill(std::uint64_t sampleKey, std::int64_t, int request,
            std::span<Point2> values) const override {
    RandomStream random = StreamOf(sampleKey, request);
    for (Point2& u : values) u = NextPoint(&random);
  }

 private:
  static RandomStream StreamOf(std::uint64_t sampleKey, int request) {
    return RandomStream(HashKey({sampleKey, std::uint64_t(request)}));
  }
  static Point2 NextPoint(RandomStream* random) {
    const Real x = random->Uniform();
    return Point2(x, random->Uniform());
  }

  std::int64_t count_;
};

std::unique_ptr<Sampler> Create(const Settings& settings, const SamplerContext&) {
  return std::make_unique<RandomSampler>(
      settings.pixelSamples.value_or(std::int64_t(settings.xSamples) * settings.ySamples));
}

}  // namespace
}  // namespace exphoton

EXPHOTON_SAMPLER("random", "independent uniform points")
