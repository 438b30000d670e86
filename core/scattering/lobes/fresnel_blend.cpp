// SPDX-License-Identifier: BSD-2-Clause
// The coated diffuse surface of Ashikhmin and Shirley samples half vectors in proportion to
// cos^e(phi). The azimuth comes from one stretched circle instead of four quadrants.
#include "core/scattering/lobes/fresnel_blend.h"

#include "core/math/sampling/sampling.h"
#include "core/scattering/lobes/albedo_tables.h"
#include "core/scattering/lobes/local_frame.h"

namespace exphoton {
namespace {

Real Power5(Real x) { return Square(Square(x)) * x; }

}  // namespace

// f = 28 / (23 pi) Kd (1 - Ks) (1 - (1 - cos wi / 2)^5) (1 - (1 - cos wo / 2)^5). Its
// hemispherical-hemispherical reflectance is 23 / 28 Kd (1 - Ks).
BlendedDiffuse::BlendedDiffuse(const Spectrum& diffuse, const Spectrum& gloss)
    : Bxdf(LobeSet::DiffuseReflection),
      rho_(diffuse * (Spectrum(1) - Clamp(gloss, 0, 1)) * (Real(23) / 28)) {}

Spectrum BlendedDiffuse::f(const Vector3& wo, const Vector3& wi) const {
  if (!SameHemisphere(wo, wi)) return {};
  return rho_ * (kInvPi * CoatTransmission(std::abs(wo.z)) * CoatTransmission(std::abs(wi.z)));
}

Real BlendedDiffuse::Pdf(const Vector3& wo, const Vector3& wi) const {
  return SameHemisphere(wo, wi) ? std::abs(wi.z) * kInvPi : 0;
}

std::optional<BxdfSample> BlendedDiffuse::Sample(const Vector3& wo, Point2 u) const {
  if (wo.z == 0) return std::nullopt;
  const Vector3 wi = OnSideOf(SampleCosineHemisphere(u), wo);
  const Real pdf = std::abs(wi.z) * kInvPi;
  return BxdfSample{wi, f(wo, wi) * kPi, pdf};
}

// The coat transmits most along the normal.
std::optional<Spectrum> BlendedDiffuse::ThroughputBound(const Vector3& wo) const {
  return rho_ * (CoatTransmission(std::abs(wo.z)) * CoatTransmission(1));
}

Spectrum BlendedDiffuse::Rho() const { return rho_; }

BlendedGloss::BlendedGloss(const Spectrum& gloss, Real exponentX, Real exponentY)
    : Bxdf(LobeSet::GlossyReflection),
      gloss_(gloss),
      ex_(exponentX),
      ey_(exponentY),
      normD_(std::sqrt((ex_ + 2) * (ey_ + 2)) * kInv2Pi),
      normPdf_(std::sqrt((ex_ + 1) * (ey_ + 1)) * kInv2Pi) {}

// The exponent uses x^2 + y^2 instead of 1 - z^2. At the peak the exponent is 0/0, but the power is
// 1.
Real BlendedGloss::PowH(const Vector3& h) const {
  const Real sin2 = h.x * h.x + h.y * h.y;
  if (!(sin2 > 0)) return 1;
  return std::pow(std::min(std::abs(h.z), Real(1)), (ex_ * h.x * h.x + ey_ * h.y * h.y) / sin2);
}

Spectrum BlendedGloss::f(const Vector3& wo, const Vector3& wi) const {
  const auto half = SameHemisphere(wo, wi) ? HalfVector::Of(wo, wi) : std::nullopt;
  if (!half) return {};
  const Spectrum schlick = gloss_ + (Spectrum(1) - gloss_) * Power5(1 - half->cosine);
  const Real larger = std::max(std::abs(wi.z), std::abs(wo.z));
  const Spectrum value = schlick * (normD_ * PowH(half->h) / (4 * half->cosine * larger));
  return value.IsFinite() ? value : Spectrum();
}

Real BlendedGloss::Pdf(const Vector3& wo, const Vector3& wi) const {
  const auto half = SameHemisphere(wo, wi) ? HalfVector::Of(wo, wi) : std::nullopt;
  if (!half) return 0;
  const Real pdf = normPdf_ * PowH(half->h) / (4 * half->cosine);
  return std::isfinite(pdf) ? pdf : 0;
}

std::optional<BxdfSample> BlendedGloss::Sample(const Vector3& wo, Point2 u) const {
  const Real angle = 2 * kPi * u.y;
  const Real x = std::sqrt(ey_ + 1) * std::cos(angle), y = std::sqrt(ex_ + 1) * std::sin(angle);
  const Real length2 = x * x + y * y;
  const Real exponent = (ex_ * x * x + ey_ * y * y) / length2;
  const PolarAngle polar = SampleCosinePower(u.x, exponent + 1);
  const Real scale = polar.sine / std::sqrt(length2);
  const Vector3 h = OnSideOf({x * scale, y * scale, polar.cosine}, wo);
  const Real oh = Dot(wo, h);
  if (!(oh > 0)) return std::nullopt;
  const Vector3 wi = h * (2 * oh) - wo;
  if (!SameHemisphere(wo, wi)) return std::nullopt;
  const Real pdf = Pdf(wo, wi);
  if (!(pdf > 0)) return std::nullopt;
  const Spectrum weight = f(wo, wi) * (std::abs(wi.z) / pdf);
  if (!weight.IsFinite()) return std::nullopt;
  return BxdfSample{wi, weight, pdf};
}

// f cos / pdf is Schlick's term times a ratio of two norms and cos_i / max(cos_i, cos_o) <= 1. The
// half vector is farthest from wo where wi is on the opposite horizon: cos^2 = (1 - sin wo) / 2.
std::optional<Spectrum> BlendedGloss::ThroughputBound(const Vector3& wo) const {
  const Real sine = std::min(std::sqrt(wo.x * wo.x + wo.y * wo.y), Real(1));
  const Real fresnel = Power5(1 - SafeSqrt((1 - sine) / 2));
  Spectrum schlick;
  for (int c = 0; c < Spectrum::kChannels; ++c)
    schlick[c] = std::max(gloss_[c], gloss_[c] + (1 - gloss_[c]) * fresnel);
  return schlick * (normD_ / normPdf_);
}

// The table is read at the exponent whose lobe width is the mean of the two widths.
Spectrum BlendedGloss::Rho() const {
  const Real width = (1 / std::sqrt(ex_ + 1) + 1 / std::sqrt(ey_ + 1)) / 2;
  const AlbedoRow row = AlbedoRow::Of(1 / (width * width) - 1);
  const auto& low = kFresnelBlendAlbedo[row.index];
  const auto& high = kFresnelBlendAlbedo[row.index + 1];
  const Real all = Lerp(row.fraction, Real(low[0]), Real(high[0]));
  const Real grazing = Lerp(row.fraction, Real(low[1]), Real(high[1]));
  return Clamp(gloss_ * (all - grazing) + Spectrum(grazing), 0, 1);
}

}  // namespace exphoton
