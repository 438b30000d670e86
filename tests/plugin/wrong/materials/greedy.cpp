// SPDX-License-Identifier: BSD-2-Clause
// Material "greedy" is wrong on purpose: it scatters more light than it receives.
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
  Spectrum f(const Vector3& wo, const Vector3& wi) const override {
    return Spectrum(SameHemisphere(wo, wi) ? Real(1.05) * kInvPi : 0);
  }
};

std::unique_ptr<Material> Create(const Settings&, const MaterialContext&) {
  return std::make_unique<WrongMaterial<Lobe>>();
}

}  // namespace
}  // namespace exphoton

EXPHOTON_MATERIAL("greedy", "scatters more than it receives")
