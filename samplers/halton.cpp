// SPDX-License-Identifier: BSD-2-Clause
// The sampler "halton" takes the points of a pixel from the Halton sequence in the bases 2 and 3,
// scrambled for each pixel and request. Any number of samples is well distributed.
#include "samplers/common/halton_sampler.h"

namespace exphoton {
namespace {

using Settings = PixelSamplesSettings;

const ParamTable<Settings>& Parameters() { return PixelSamplesParameters(); }

class HaltonSampler final : public HaltonArraySampler<HaltonSampler> {
 public:
  using HaltonArraySampler::HaltonArraySampler;

  std::uint64_t FillCamera(const SampleKey& key, CameraSamples* samples) const override {
    const std::uint64_t pixelKey =
        HashKey({key.seed, std::uint64_t(key.pixel.x), std::uint64_t(key.pixel.y), 0x68616c74});
    samples->film = Points(pixelKey, key.index, kFilm).Both();
    if (samples->NeedsLens()) samples->lens = Points(pixelKey, key.index, kLens).Both();
    if (samples->NeedsTime()) samples->time = Points(pixelKey, key.index, kTime).First();
    return pixelKey;
  }
};

std::unique_ptr<Sampler> Create(const Settings& settings, const SamplerContext&) {
  return std::make_unique<HaltonSampler>(settings.pixelSamples);
}

}  // namespace
}  // namespace exphoton

EXPHOTON_SAMPLER("halton", "scrambled Halton points")
