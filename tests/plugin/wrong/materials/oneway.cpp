// SPDX-License-Identifier: BSD-2-Clause
// Material "oneway" is wrong on purpose: it is not reciprocal.
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
    return RightLobe::f(wo, wi) * (Real(.5) + std::abs(wi.z) / 2);
  }
};

std::unique_ptr<Material> Create(const Settings&, const MaterialContext&) {
  return std::make_unique<WrongMaterial<Lobe>>();
}

}  // namespace
}  // namespace exphoton

EXPHOTON_MATERIAL("oneway", "is not reciprocal")
