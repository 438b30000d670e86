// SPDX-License-Identifier: BSD-2-Clause
// The medium "homogeneous" has constant density in its box (fog, smoke, clear liquids).
#include "materials/volumes/common/box_medium.h"

namespace exphoton {
namespace {

struct Uniform {
  bool IsZero() const { return false; }
  double At(const Point3&) const { return 1; }
  double Integral(const Point3&, const Vector3&, Interval part) const {
    return double(part.max) - double(part.min);
  }
};

const ParamTable<MediumSettings>& Parameters() { return MediumParameters(); }

std::unique_ptr<Medium> Create(const MediumSettings& settings, const MediumContext& context) {
  return std::make_unique<BoxMedium<Uniform>>(settings, context, Uniform());
}

}  // namespace
}  // namespace exphoton

EXPHOTON_VOLUME("homogeneous", "a medium of constant density")
