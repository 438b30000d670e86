// SPDX-License-Identifier: BSD-2-Clause
// Material "misstated" is wrong on purpose: its samples have another density than it states.
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
    const Vector3 wi = OnSideOf(SampleUniformHemisphere(u), wo);
    const Real pdf = Pdf(wo, wi);
    if (!(pdf > 0)) return std::nullopt;
    return BxdfSample{wi, f(wo, wi) * (std::abs(wi.z) / pdf), pdf};
  }
};

std::unique_ptr<Material> Create(const Settings&, const MaterialContext&) {
  return std::make_unique<WrongMaterial<Lobe>>();
}

}  // namespace
}  // namespace exphoton

EXPHOTON_MATERIAL("misstated", "states another density than it samples")
