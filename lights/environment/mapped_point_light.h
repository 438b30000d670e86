// SPDX-License-Identifier: BSD-2-Clause
// MappedPointLight is a light at a point whose intensity depends on direction, as the lights
// "goniometric" and "projection". An IntensityMap supplies the dependence.
#pragma once

#include "core/plugin.h"

namespace exphoton {

// IntensityMap is a factor on the intensity for each direction that leaves the light. Directions
// are unit vectors in the space of the light.
class IntensityMap {
 public:
  virtual ~IntensityMap() = default;

  virtual Spectrum Evaluate(const Vector3& w) const = 0;
  // Samples a direction with density Pdf per solid angle. The density is positive wherever the
  // factor is.
  virtual Vector3 Sample(Point2 u) const = 0;
  virtual Real Pdf(const Vector3& w) const = 0;
  virtual Spectrum Integral() const = 0;  // over the sphere
  // Returns the largest value of each channel. Unlike the integral, it cannot underflow to 0.
  virtual Spectrum Largest() const = 0;
  // Returns a bound on Evaluate / Pdf for each channel. The call may be slow.
  virtual Spectrum LargestWeight() const = 0;

  // A cone about an axis that contains every direction of Sample. The angle is in radians.
  struct Cone {
    Vector3 axis{0, 0, 1};
    double halfAngle = 4;  // more than pi: all directions
  };
  virtual Cone EmissionCone() const { return {}; }
};

struct MappedPointLightSettings {
  Spectrum intensity{1};
  Spectrum scale{1};
};
const ParamTable<MappedPointLightSettings>& MappedPointLightParameters();

// Returns the light at the origin of the light's space. Warns if the transformation stretches
// directions. The light's Power is then an estimate of 4096 samples, and exact otherwise.
std::unique_ptr<Light> MakeMappedPointLight(const MappedPointLightSettings& settings,
                                            std::unique_ptr<const IntensityMap> map,
                                            const LightContext& context);

}  // namespace exphoton
