// SPDX-License-Identifier: BSD-2-Clause
// Light "lopsided" is wrong on purpose: it emits in half of all directions, and states all.
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
    sample->ray.d.z = std::abs(sample->ray.d.z);
    return sample;
  }
};

std::unique_ptr<Light> Create(const Settings&, const LightContext&) {
  return std::make_unique<WrongLight>();
}

}  // namespace
}  // namespace exphoton

EXPHOTON_LIGHT("lopsided", "states another density than it emits")
