// SPDX-License-Identifier: BSD-2-Clause
// Light "misguided" is wrong on purpose: it states twice the density of the directions to it.
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
  Real PdfDirect(const SurfacePoint&, const Vector3&, const SurfacePoint*) const override {
    return 2 * kUniformSpherePdf;
  }
};

std::unique_ptr<Light> Create(const Settings&, const LightContext&) {
  return std::make_unique<WrongLight>();
}

}  // namespace
}  // namespace exphoton

EXPHOTON_LIGHT("misguided", "states another density of directions to it")
