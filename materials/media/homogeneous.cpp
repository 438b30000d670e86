// SPDX-License-Identifier: BSD-2-Clause
// The medium "homogeneous" has constant density in its box (fog, smoke, clear liquids).
#include "materials/media/common/box_medium.h"

namespace exphoton {
namespace {

struct Uniform {
  double At(const Point3&) const { return 1; }
  double Integral(const Point3&, const Vector3&, Interval part) const {
    return double(part.max) - double(part.min);
  }
};

std::unique_ptr<Medium> Create(const MediumSettings& settings, const MediumContext& context) {
  return std::make_unique<BoxMedium<Uniform>>(settings, context, Uniform());
}

}  // namespace
}  // namespace exphoton

EXPHOTON_PLUGIN("homogeneous", "a medium of constant density",
                exphoton::MakeFactory<exphoton::PluginKind::Volume>(exphoton::MediumParameters(),
                                                                    exphoton::Create))
