// SPDX-License-Identifier: BSD-2-Clause
// The shape "paraboloid" is the part of x^2 + y^2 = (radius^2 / zmax) z between zmin and zmax,
// swept by phimax degrees. u follows the azimuth, v runs from zmin to zmax. As a light it is
// sampled by area.
#include "core/plugin.h"
#include "shapes/quadric/revolved_quadric.h"

namespace exphoton {
namespace {

struct Settings {
  Real radius = 1;
  Real zMin = 0, zMax = 1;
  Real phiMaxDegrees = 360;

  Real Low() const { return std::min(zMin, zMax); }
  Real High() const { return std::max(zMin, zMax); }
  void Validate() const {
    if (zMin == zMax) throw ParamError{"zmin", "must differ from 'zmax'", ""};
    if (Low() < 0) {
      throw ParamError{zMin < zMax ? "zmin" : "zmax", "must not be below 0",
                       "the tip of the paraboloid is at z = 0"};
    }
  }
};

const ParamTable<Settings>& Parameters() {
  static const ParamTable<Settings> table{
      Param("radius", &Settings::radius, "radius at zmax").Above(0).Unit("scene units"),
      Param("zmin", &Settings::zMin, "lower end").Unit("scene units"),
      Param("zmax", &Settings::zMax, "upper end").Unit("scene units"),
      Param("phimax", &Settings::phiMaxDegrees, "angle swept about z")
          .Above(0)
          .AtMost(360)
          .Unit("degrees")};
  return table;
}

std::unique_ptr<ShapeGeometry> Create(const Settings& settings, const ShapeContext& context) {
  const double low = double(settings.Low()), high = double(settings.High());
  const double radius = double(settings.radius);
  Meridian parabola;
  parabola.z0 = low, parabola.dz = high - low;
  parabola.a = radius * radius * (low / high);
  parabola.b = radius * radius * (parabola.dz / high) / 2;
  return std::make_unique<ShapeGeometry>(
      std::make_unique<RevolvedQuadric>(parabola, settings.phiMaxDegrees, context));
}

}  // namespace
}  // namespace exphoton

EXPHOTON_SHAPE("paraboloid", "a paraboloid of revolution or a part of one")
