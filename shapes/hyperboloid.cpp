// SPDX-License-Identifier: BSD-2-Clause
// The shape "hyperboloid" arises when the line from p1 to p2 turns about z by phimax degrees. u
// follows the angle, v runs from p1 to p2. Where p2 is higher than p1, the normal points away from
// the axis. As a light it is sampled by area.
#include "core/plugin.h"
#include "shapes/quadric/revolved_quadric.h"

namespace exphoton {
namespace {

struct Settings {
  Point3 p1{0, 0, 0}, p2{1, 1, 1};
  Real phiMaxDegrees = 360;

  void Validate() const {
    if (p1.z == p2.z) {
      throw ParamError{"p2", "must differ from 'p1' in z", "a flat ring is a \"disk\""};
    }
    if (p1.x == 0 && p1.y == 0 && p2.x == 0 && p2.y == 0)
      throw ParamError{"p2", "the line from 'p1' to 'p2' must not lie on the z axis", ""};
  }
};

const ParamTable<Settings>& Parameters() {
  static const ParamTable<Settings> table{
      Param("p1", &Settings::p1, "first end of the line").Unit("scene units"),
      Param("p2", &Settings::p2, "second end of the line").Unit("scene units"),
      Param("phimax", &Settings::phiMaxDegrees, "angle swept about z")
          .Above(0)
          .AtMost(360)
          .Unit("degrees")};
  return table;
}

std::unique_ptr<ShapeGeometry> Create(const Settings& settings, const ShapeContext& context) {
  Vec3d start(settings.p1), end(settings.p2);
  // pbrt-v1 exchanges the ends if the second lies in the plane z = 0. Scenes depend on the side
  // that the normal then has.
  if (end.z == 0) std::swap(start, end);
  return std::make_unique<ShapeGeometry>(std::make_unique<RevolvedQuadric>(
      Meridian::Line(start, end), settings.phiMaxDegrees, context));
}

}  // namespace
}  // namespace exphoton

EXPHOTON_SHAPE("hyperboloid", "a line turned about the z axis")
