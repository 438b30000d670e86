// SPDX-License-Identifier: BSD-2-Clause
// Material "unweighted" is wrong on purpose: the throughput of its samples lacks a factor.
#include "tests/plugin/wrong/wrong_material.h"

namespace exphoton {
namespace {

using Settings = NoSettings;

const ParamTable<Settings>& Parameters() {
  static const ParamTable<Settings> table{};
  return table;
}

class Lobe final : public RightLobe {
 public:
  std::optional<BxdfSample> Sample(const Vector3& wo, Point2 u) const override {
    auto sample = RightLobe::Sample(wo, u);
    if (sample) sample->throughput *= std::abs(sample->wi.z);
    return sample;
  }
};

std::unique_ptr<Material> Create(const Settings&, const MaterialContext&) {
  return std::make_unique<WrongMaterial<Lobe>>();
}

}  // namespace
}  // namespace exphoton

EXPHOTON_MATERIAL("unweighted", "leaves the cosine out of its throughput")
