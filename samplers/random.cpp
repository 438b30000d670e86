// SPDX-License-Identifier: BSD-2-Clause
// Sampler "random": independent uniform points. The slowest to converge, and the yardstick for the
// others.
#include "core/math/random.h"
#include "core/plugin.h"

namespace exphoton {
namespace {

struct Settings {
  int xSamples = 2, ySamples = 2;
};

const ParamTable<Settings>& Parameters() {
  static const ParamTable<Settings> table{
      Param("xsamples", &Settings::xSamples, "samples a pixel, together with ysamples")
          .Range(1, 32768),
      Param("ysamples", &Settings::ySamples, "samples a pixel are xsamples times ysamples")
          .Range(1, 32768)};
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

  void Generate(const SampleKey& key, CameraSamples* samples) const override {
    RandomStream random(HashKey({key.seed, std::uint64_t(key.pixel.x), std::uint64_t(key.pixel.y),
                                 std::uint64_t(key.index), 0x72616e64}));
    const auto point = [&random] {
      const Real x = random.Uniform();
      return Point2(x, random.Uniform());
    };
    samples->film = point();
    samples->lens = point();
    samples->time = random.Uniform();
    for (int i = 0; i < samples->Count1D(); ++i)
      for (Real& u : samples->Array1D(i)) u = random.Uniform();
    for (int i = 0; i < samples->Count2D(); ++i)
      for (Point2& u : samples->Array2D(i)) u = point();
  }

 private:
  std::int64_t count_;
};

std::unique_ptr<Sampler> Create(const Settings& settings, const SamplerContext&) {
  return std::make_unique<RandomSampler>(std::int64_t(settings.xSamples) * settings.ySamples);
}

}  // namespace
}  // namespace exphoton

EXPHOTON_PLUGIN("random", "independent uniform points",
                exphoton::MakeForm<exphoton::PluginKind::Sampler>(exphoton::Parameters(),
                                                                  exphoton::Create))
