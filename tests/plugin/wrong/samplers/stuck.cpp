// SPDX-License-Identifier: BSD-2-Clause
// Sampler "stuck" is wrong on purpose: it ignores the seed.
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
    return HashKey(
        {std::uint64_t(key.pixel.x), std::uint64_t(key.pixel.y), std::uint64_t(key.index)});
  }
  Real Number(Real u) const { return u; }
};

std::unique_ptr<Sampler> Create(const Settings&, const SamplerContext&) {
  return std::make_unique<WrongSampler<Rule>>();
}

}  // namespace
}  // namespace exphoton

EXPHOTON_SAMPLER("stuck", "ignores the seed")
