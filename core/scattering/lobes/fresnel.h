// SPDX-License-Identifier: BSD-2-Clause
// Fresnel computes the reflectance of unpolarised light at dielectrics and conductors. It is a
// small value instead of a class hierarchy, because the innermost loops evaluate it. Sources: Born
// and Wolf, "Principles of Optics", section 1.5; for conductors the classic approximation of Cook
// and Torrance 1982 (R perpendicular and parallel for large eta^2 + k^2).
#pragma once

#include <optional>

#include "core/math/spectrum.h"

namespace exphoton {

// Returns |cos| of the refracted direction, or nullopt at total internal reflection (and exactly at
// the critical angle). relativeEta is eta of the incident side / eta of the other side. The formula
// avoids sin^2, which would lose grazing cosines.
inline std::optional<Real> RefractedCosine(Real cosIncident, Real relativeEta) {
  const Real cos2 =
      (1 - relativeEta) * (1 + relativeEta) + Square(relativeEta) * Square(cosIncident);
  if (!(cos2 > 0)) return std::nullopt;
  return std::min(std::sqrt(cos2), Real(1));
}

// Returns the reflectance of a dielectric boundary. If cosIncident < 0, light comes from the
// inside, and the indices change places. The result is 1 at total internal reflection.
inline Real FresnelDielectric(Real cosIncident, Real etaOutside, Real etaInside) {
  if (etaOutside == etaInside) return 0;
  if (cosIncident < 0) std::swap(etaOutside, etaInside);
  const Real cosI = std::min(std::abs(cosIncident), Real(1));
  const std::optional<Real> cosT = RefractedCosine(cosI, etaOutside / etaInside);
  if (!cosT) return 1;
  const Real parallel =
      (etaInside * cosI - etaOutside * *cosT) / (etaInside * cosI + etaOutside * *cosT);
  const Real perpendicular =
      (etaOutside * cosI - etaInside * *cosT) / (etaOutside * cosI + etaInside * *cosT);
  return (Square(parallel) + Square(perpendicular)) / 2;
}

// Returns the reflectance of a conductor with index eta and absorption k (relative to the outside).
// Pictures made with pbrt 1 and 2 depend on this approximation.
inline Real FresnelConductor(Real cosIncident, Real eta, Real k) {
  const Real c = std::min(std::abs(cosIncident), Real(1)), c2 = c * c;
  const Real norm = eta * eta + k * k, cross = 2 * eta * c;
  const Real denominatorParallel = norm * c2 + cross + 1;
  const Real denominatorPerpendicular = norm + cross + c2;
  const Real parallel = (norm * c2 - cross + 1) / denominatorParallel;
  const Real perpendicular =
      denominatorPerpendicular > 0 ? (norm - cross + c2) / denominatorPerpendicular : 1;
  return (parallel + perpendicular) / 2;
}

// Returns the index of refraction of a dielectric with this reflectance at normal incidence. The
// reflectance is limited to .999.
inline Real EtaFromReflectance(Real reflectance) {
  const Real root = std::sqrt(std::clamp(reflectance, Real(0), Real(.999)));
  return (1 + root) / (1 - root);
}

class Fresnel {
 public:
  static Fresnel None() { return {}; }  // 1 at every angle
  static Fresnel Dielectric(Real etaOutside, Real etaInside) {
    Fresnel f;
    f.kind_ = Kind::Dielectric;
    f.eta_ = Spectrum(etaOutside, etaInside, 0);
    return f;
  }
  static Fresnel Conductor(const Spectrum& eta, const Spectrum& k) {
    Fresnel f;
    f.kind_ = Kind::Conductor;
    f.eta_ = eta;
    f.k_ = k;
    return f;
  }

  // cosIncident is the cosine of the angle between the incident direction and the (micro)facet's
  // normal. Its sign gives the side.
  Spectrum operator()(Real cosIncident) const {
    switch (kind_) {
      case Kind::Dielectric:
        return Spectrum(FresnelDielectric(cosIncident, eta_.r, eta_.g));
      case Kind::Conductor:
        return {FresnelConductor(cosIncident, eta_.r, k_.r),
                FresnelConductor(cosIncident, eta_.g, k_.g),
                FresnelConductor(cosIncident, eta_.b, k_.b)};
      case Kind::None:
        break;
    }
    return Spectrum(1);
  }

 private:
  enum class Kind { None, Dielectric, Conductor };
  Kind kind_ = Kind::None;
  Spectrum eta_;  // for a dielectric: outside and inside index in r and g
  Spectrum k_;
};

}  // namespace exphoton
