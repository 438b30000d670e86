// SPDX-License-Identifier: BSD-2-Clause
// BlinnDistribution is Blinn's distribution of microfacet normals, D(h) = (e+2)/(2 pi) cos^e h,
// with its sampling. Source: Blinn 1977, "Models of Light Reflection for Computer Synthesized
// Pictures".
#pragma once

#include "core/math/sampling/sampling.h"

namespace exphoton {

// Returns the exponent of a roughness: its inverse, at most 1000. A roughness of 0, below 0 or NaN
// gives 1000.
inline constexpr Real kMaxBlinnExponent = 1000;
inline Real BlinnExponent(Real roughness) {
  return roughness > 1 / kMaxBlinnExponent ? 1 / roughness : kMaxBlinnExponent;
}

class BlinnDistribution {
 public:
  explicit BlinnDistribution(Real exponent)
      : exponent_(exponent), norm_((exponent + 2) * kInv2Pi) {}

  Real Exponent() const { return exponent_; }
  // Returns the facet area per unit area and steradian. The integral of D cos over the hemisphere
  // is 1.
  Real D(Real cosH) const { return norm_ * std::pow(cosH, exponent_); }
  // Samples a half vector about +z with density D cos per solid angle.
  Vector3 Sample(Point2 u) const {
    const PolarAngle angle = SampleCosinePower(u.x, exponent_ + 2);
    return SphericalDirection(angle.sine, angle.cosine, 2 * kPi * u.y);
  }
  Real Pdf(Real cosH) const { return D(cosH) * cosH; }

 private:
  Real exponent_, norm_;
};

}  // namespace exphoton
