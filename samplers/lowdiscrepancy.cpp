// SPDX-License-Identifier: BSD-2-Clause
// The sampler "lowdiscrepancy" distributes the samples of a pixel and of each request as a
// (0,2)-sequence (low_discrepancy_sampler.h). It is the default sampler.
#include "samplers/common/low_discrepancy_sampler.h"

namespace exphoton {
namespace {

struct Settings {
  int pixelSamples = 4;
};

const ParamTable<Settings>& Parameters() {
  static const ParamTable<Settings> table{Param("pixelsamples", &Settings::pixelSamples,
                                                "samples a pixel, rounded up to a power of two")
                                              .Range(1, low_discrepancy::kMaxCount)};
  return table;
}

std::unique_ptr<Sampler> Create(const Settings& settings, const SamplerContext& context) {
  const int rounded = int(std::bit_ceil(unsigned(settings.pixelSamples)));
  if (rounded != settings.pixelSamples) {
    context.log.Warning("sampler \"lowdiscrepancy\": \"pixelsamples\" " +
                            std::to_string(settings.pixelSamples) + " is rounded up to " +
                            std::to_string(rounded) + ", a power of two",
                        context.where);
  }
  return std::make_unique<low_discrepancy::LowDiscrepancySampler>(rounded);
}

}  // namespace
}  // namespace exphoton

EXPHOTON_SAMPLER("lowdiscrepancy", "scrambled (0,2)-sequences")
