// SPDX-License-Identifier: BSD-2-Clause
// The shape "cone" is an open cone about z. Its base circle lies at z = 0 and its tip at
// z = height; it is swept by phimax degrees. u follows the azimuth, v runs from the base to the
// tip. As a light it is sampled by area.
#include "core/plugin.h"
#include "shapes/quadric/revolved_quadric.h"

namespace exphoton {
namespace {

struct Settings {
  Real radius = 1;
  Real height = 1;
  Real phiMaxDegrees = 360;
};

const ParamTable<Settings>& Parameters() {
  static const ParamTable<Settings> table{
      Param("radius", &Settings::radius, "radius of the base").Above(0).Unit("scene units"),
      Param("height", &Settings::height, "position of the tip along z")
          .Above(0)
          .Unit("scene units"),
      Param("phimax", &Settings::phiMaxDegrees, "angle swept about z")
          .Above(0)
          .AtMost(360)
          .Unit("degrees")};
  return table;
}

std::unique_ptr<ShapeGeometry> Create(const Settings& settings, const ShapeContext& context) {
  const Meridian side =
      Meridian::Line({double(settings.radius), 0, 0}, {0, 0, double(settings.height)});
  return std::make_unique<ShapeGeometry>(
      std::make_unique<RevolvedQuadric>(side, settings.phiMaxDegrees, context));
}

}  // namespace
}  // namespace exphoton

EXPHOTON_SHAPE("cone", "an open cone or a part of one")
