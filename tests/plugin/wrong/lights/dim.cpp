// SPDX-License-Identifier: BSD-2-Clause
// Light "dim" is wrong on purpose: its photons carry half of its power.
#include "tests/plugin/wrong/wrong_light.h"

namespace exphoton {
namespace {

using Settings = NoSettings;

const ParamTable<Settings>& Parameters() {
  static const ParamTable<Settings> table{};
  return table;
}

class WrongLight final : public RightLight {
 public:
  std::optional<LightLeSample> SampleEmission(Point2 uPosition, Point2 uDirection, Real uSubLight,
                                              Real time) const override {
    auto sample = RightLight::SampleEmission(uPosition, uDirection, uSubLight, time);
    sample->power *= Real(.5);
    return sample;
  }
};

std::unique_ptr<Light> Create(const Settings&, const LightContext&) {
  return std::make_unique<WrongLight>();
}

}  // namespace
}  // namespace exphoton

EXPHOTON_LIGHT("dim", "its photons carry too little")
