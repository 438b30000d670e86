// SPDX-License-Identifier: BSD-2-Clause
// Sampler "bunched" is wrong on purpose: it prefers small numbers.
#include "tests/plugin/wrong/wrong_sampler.h"

namespace exphoton {
namespace {

using Settings = NoSettings;

const ParamTable<Settings>& Parameters() {
  static const ParamTable<Settings> table{};
  return table;
}

struct Rule : PlainRule {
  Real Number(Real u) const { return u * u; }
};

std::unique_ptr<Sampler> Create(const Settings&, const SamplerContext&) {
  return std::make_unique<WrongSampler<Rule>>();
}

}  // namespace
}  // namespace exphoton

EXPHOTON_SAMPLER("bunched", "prefers small numbers")
