// SPDX-License-Identifier: BSD-2-Clause
// Sampler "moody" is wrong on purpose: its numbers depend on the samples before.
#include "tests/plugin/wrong/wrong_sampler.h"

namespace exphoton {
namespace {

using Settings = NoSettings;

const ParamTable<Settings>& Parameters() {
  static const ParamTable<Settings> table{};
  return table;
}

struct Rule {
  std::uint64_t Key(const SampleKey& key) const {
    return HashKey({key.seed, std::uint64_t(key.pixel.x), std::uint64_t(key.pixel.y),
                    std::uint64_t(key.index), ++count});
  }
  Real Number(Real u) const { return u; }
  mutable std::uint64_t count = 0;
};

std::unique_ptr<Sampler> Create(const Settings&, const SamplerContext&) {
  return std::make_unique<WrongSampler<Rule>>();
}

}  // namespace
}  // namespace exphoton

EXPHOTON_SAMPLER("moody", "depends on the order of samples")
