// SPDX-License-Identifier: BSD-2-Clause
// The light "goniometric" emits from one point with an intensity that an image gives for each
// direction, as measured for luminaires. The transformation alone places it.
//
// The image is a latitude-longitude map about the y axis of the light: with the direction (x, y, z)
// that leaves the light, the polar angle theta is measured from +y and the azimuth phi = atan2(z,
// x). The column is phi / (2 pi) of the width, and the row is theta / pi of the height, from the
// top. EnvironmentMap is about the z axis, so y and z change places.
#include <algorithm>

#include "core/math/sampling/sampling.h"
#include "lights/environment/environment_map.h"
#include "lights/environment/map_texels.h"
#include "lights/environment/mapped_point_light.h"

namespace exphoton {
namespace {

struct Settings : MappedPointLightSettings {
  std::string mapName;
};

const ParamTable<Settings>& Parameters() {
  static const ParamTable<Settings> table{
      MappedPointLightParameters(), Param("mapname", &Settings::mapName,
                                          "latitude-longitude map of the intensity (an image file, "
                                          "as for imagemap); top row is +y of the light; 1 "
                                          "everywhere if absent")
                                        .As(ParamType::File)};
  return table;
}

class UniformIntensity final : public IntensityMap {
 public:
  explicit UniformIntensity(const Spectrum& value) : value_(value) {}
  Spectrum Evaluate(const Vector3&) const override { return value_; }
  Vector3 Sample(Point2 u) const override { return SampleUniformSphere(u); }
  Real Pdf(const Vector3&) const override { return kUniformSpherePdf; }
  Spectrum Integral() const override { return value_ * (4 * kPi); }
  Spectrum Largest() const override { return value_; }
  Spectrum LargestWeight() const override { return value_ / kUniformSpherePdf; }

 private:
  Spectrum value_;
};

// Returns a cone about +y or -y that contains all directions with light. Interpolation spreads a
// texel over its neighbours, and another row is a margin.
IntensityMap::Cone ConeOf(const MapTexels& map) {
  constexpr double kHeight = 3.14159265358979323846;
  constexpr int kMargin = 2;  // rows
  int first = map.height, last = -1;
  for (int row = 0; row < map.height; ++row)
    for (int column = 0; column < map.width; ++column) {
      if (map.texels[std::size_t(row) * std::size_t(map.width) + std::size_t(column)].IsBlack())
        continue;
      first = std::min(first, row), last = row;
    }
  const double fromTop = kHeight * (last + 1 + kMargin) / map.height;
  const double fromBottom = kHeight * (map.height - first + kMargin) / map.height;
  if (fromTop < fromBottom) return {{0, 1, 0}, fromTop};
  return {{0, -1, 0}, fromBottom};
}

class GoniometricMap final : public IntensityMap {
 public:
  explicit GoniometricMap(MapTexels texels)
      : cone_(ConeOf(texels)), map_(std::move(texels.texels), texels.width, texels.height) {}
  Cone EmissionCone() const override { return cone_; }
  Spectrum Evaluate(const Vector3& w) const override { return map_.Evaluate(SwapYZ(w)); }
  Vector3 Sample(Point2 u) const override { return SwapYZ(map_.Sample(u)); }
  Real Pdf(const Vector3& w) const override { return map_.Pdf(SwapYZ(w)); }
  Spectrum Integral() const override { return map_.Integral(); }
  Spectrum Largest() const override { return map_.Largest(); }
  Spectrum LargestWeight() const override { return map_.LargestWeight(); }

 private:
  static Vector3 SwapYZ(const Vector3& w) { return {w.x, w.z, w.y}; }

  Cone cone_;
  EnvironmentMap map_;
};

std::unique_ptr<const IntensityMap> MakeMap(const Settings& settings, const LightContext& context) {
  if (settings.mapName.empty()) return std::make_unique<UniformIntensity>(Spectrum(1));
  MapTexels texels = ReadMapTexels(settings.mapName, context);
  if (texels.IsUniform()) return std::make_unique<UniformIntensity>(texels.texels.front());
  return std::make_unique<GoniometricMap>(std::move(texels));
}

std::unique_ptr<Light> Create(const Settings& settings, const LightContext& context) {
  return MakeMappedPointLight(settings, MakeMap(settings, context), context);
}

}  // namespace
}  // namespace exphoton

EXPHOTON_LIGHT("goniometric", "light from one point, with an intensity map over all directions")
