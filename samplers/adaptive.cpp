// SPDX-License-Identifier: BSD-2-Clause
// The sampler "adaptive" of version 2 takes few samples where a pixel looks even. Here it takes the
// most samples in every pixel, because the choice from the samples themselves would make edges
// darker or brighter than they are (docs/decisions/0028-version-2-parameters.md).
#include <bit>

#include "samplers/common/low_discrepancy_sampler.h"

namespace exphoton {
namespace {

struct Settings {
  int minSamples = 4, maxSamples = 32;
  std::string method = "contrast";
};

const ParamTable<Settings>& Parameters() {
  static const ParamTable<Settings> table{
      Param("maxsamples", &Settings::maxSamples, "samples a pixel, rounded up to a power of two")
          .Range(1, low_discrepancy::kMaxCount),
      Param("minsamples", &Settings::minSamples, "all pixels take \"maxsamples\"")
          .Range(1, low_discrepancy::kMaxCount)
          .Ignored(),
      Param("method", &Settings::method, "all pixels take \"maxsamples\"").Ignored()};
  return table;
}

std::unique_ptr<Sampler> Create(const Settings& settings, const SamplerContext& context) {
  const int rounded = int(std::bit_ceil(unsigned(settings.maxSamples)));
  context.log.Warning("sampler \"adaptive\" takes the largest number of samples, " +
                          std::to_string(rounded) + ", in every pixel",
                      context.where);
  return std::make_unique<low_discrepancy::LowDiscrepancySampler>(rounded);
}

}  // namespace
}  // namespace exphoton

EXPHOTON_SAMPLER("adaptive", "version 2's adaptive sampler, with the most samples in every pixel")
