// SPDX-License-Identifier: BSD-2-Clause
// Lafortune is reflection by generalised cosine lobes: for each lobe and channel
//   f = max(0, Cxy (wo.x wi.x + wo.y wi.y) + Cz wo.z wi.z)^n   per steradian.
// Cxy < 0 reflects as a mirror, Cxy > 0 backwards; Cz <= 0 leaves only grazing directions. The
// representation is fitted to measurements. It is reciprocal, but a fit may gain energy. Source:
// Lafortune, Foo, Torrance and Greenberg 1997, "Non-Linear Approximation of Reflectance Functions".
//
// Sampling: with q = (Cxy wo.x, Cxy wo.y, max(Cz, 0) |wo.z|), the function g(wi) = max(0, q.wi)^n
// is at least f above the surface. It is a cosine power about q, with the integral
// E = 2 pi |q|^n / (n + 1) over the sphere. Sample picks a lobe and channel in proportion to E,
// draws from its cosine power, and mirrors directions below the surface upwards. The density is
// the sum over lobes and channels of g(wi) + g(mirrored wi), divided by the sum of E.
#pragma once

#include <initializer_list>
#include <span>
#include <vector>

#include "core/scattering/bxdf.h"

namespace exphoton {

struct LafortuneLobe {
  Spectrum xy, z;     // Cxy and Cz
  Spectrum exponent;  // n >= 0
};

// LafortuneFit holds the lobes of one material, and their reflectance.
class LafortuneFit {
 public:
  explicit LafortuneFit(std::initializer_list<LafortuneLobe> lobes);

  std::span<const LafortuneLobe> Lobes() const { return lobes_; }
  // Returns the hemispherical-hemispherical reflectance, computed once with an error below 0.005.
  const Spectrum& Rho() const { return rho_; }

 private:
  std::vector<LafortuneLobe> lobes_;
  Spectrum rho_;
};

class Lafortune final : public Bxdf {
 public:
  // `fit` must outlive the lobe.
  explicit Lafortune(const LafortuneFit& fit)
      : Bxdf(LobeSet::GlossyReflection), lobes_(fit.Lobes()), rho_(fit.Rho()) {}
  Lafortune(std::span<const LafortuneLobe> lobes, const Spectrum& rho)
      : Bxdf(LobeSet::GlossyReflection), lobes_(lobes), rho_(rho) {}

  Spectrum f(const Vector3& wo, const Vector3& wi) const override;
  Real Pdf(const Vector3& wo, const Vector3& wi) const override;
  std::optional<BxdfSample> Sample(const Vector3& wo, Point2 u) const override;
  std::optional<Spectrum> ThroughputBound(const Vector3& wo) const override;
  Spectrum Rho() const override { return Clamp(rho_, 0, 1); }

 private:
  std::span<const LafortuneLobe> lobes_;
  Spectrum rho_;
};

}  // namespace exphoton
