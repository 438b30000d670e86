// SPDX-License-Identifier: BSD-2-Clause
// Ashikhmin and Shirley's coated diffuse surface. Half vectors are sampled in proportion to
// cos^e(phi), with the azimuth by one stretched circle instead of four quadrants.
#include "core/scattering/fresnel_blend.h"

#include "core/math/sampling.h"
#include "core/scattering/albedo_tables.h"
#include "core/scattering/local_frame.h"

namespace exphoton {
namespace {

Real Power5(Real x) { return Square(Square(x)) * x; }

}  // namespace

FresnelBlend::FresnelBlend(const Spectrum& diffuse, const Spectrum& gloss, Real exponentX,
                           Real exponentY)
    : Bxdf(LobeSet::GlossyReflection),
      diffuse_(diffuse * (Spectrum(1) - Clamp(gloss, 0, 1)) * (28 / (23 * kPi))),
      gloss_(gloss),
      ex_(exponentX),
      ey_(exponentY),
      normD_(std::sqrt((ex_ + 2) * (ey_ + 2)) * kInv2Pi),
      normPdf_(std::sqrt((ex_ + 1) * (ey_ + 1)) * kInv2Pi) {}

// From x^2 + y^2, not 1 - z^2: at the peak the exponent is 0/0 but the power is 1.
Real FresnelBlend::PowH(const Vector3& h) const {
  const Real sin2 = h.x * h.x + h.y * h.y;
  if (!(sin2 > 0)) return 1;
  return std::pow(std::min(std::abs(h.z), Real(1)), (ex_ * h.x * h.x + ey_ * h.y * h.y) / sin2);
}

Spectrum FresnelBlend::f(const Vector3& wo, const Vector3& wi) const {
  if (!SameHemisphere(wo, wi)) return {};
  const Real cosO = std::abs(wo.z), cosI = std::abs(wi.z);
  Spectrum value = diffuse_ * ((1 - Power5(1 - cosI / 2)) * (1 - Power5(1 - cosO / 2)));
  if (const auto half = HalfVector::Of(wo, wi)) {
    const Spectrum schlick = gloss_ + (Spectrum(1) - gloss_) * Power5(1 - half->cosine);
    value += schlick * (normD_ * PowH(half->h) / (4 * half->cosine * std::max(cosI, cosO)));
  }
  return value.IsFinite() ? value : Spectrum();
}

Real FresnelBlend::Pdf(const Vector3& wo, const Vector3& wi) const {
  if (!SameHemisphere(wo, wi)) return 0;
  Real pdf = std::abs(wi.z) * kInvPi;
  if (const auto half = HalfVector::Of(wo, wi))
    pdf += normPdf_ * PowH(half->h) / (4 * half->cosine);
  return std::isfinite(pdf) ? pdf / 2 : 0;
}

std::optional<BxdfSample> FresnelBlend::Sample(const Vector3& wo, Point2 u) const {
  if (wo.z == 0) return std::nullopt;
  Vector3 wi;
  if (u.x < Real(.5)) {
    wi = OnSideOf(SampleCosineHemisphere({2 * u.x, u.y}), wo);
  } else {
    const Real angle = 2 * kPi * u.y;
    const Real x = std::sqrt(ey_ + 1) * std::cos(angle), y = std::sqrt(ex_ + 1) * std::sin(angle);
    const Real length2 = x * x + y * y;
    const Real exponent = (ex_ * x * x + ey_ * y * y) / length2;
    const Real cosH = std::pow(2 * (1 - u.x), 1 / (exponent + 1));
    const Real scale = SafeSqrt((1 - cosH) * (1 + cosH) / length2);
    const Vector3 h = OnSideOf({x * scale, y * scale, cosH}, wo);
    const Real oh = Dot(wo, h);
    if (!(oh > 0)) return std::nullopt;
    wi = h * (2 * oh) - wo;
    if (!SameHemisphere(wo, wi)) return std::nullopt;
  }
  const Real pdf = Pdf(wo, wi);
  if (!(pdf > 0)) return std::nullopt;
  const Spectrum weight = f(wo, wi) * (std::abs(wi.z) / pdf);
  if (!weight.IsFinite()) return std::nullopt;
  return BxdfSample{wi, weight, pdf};
}

// The diffuse part in closed form: 28/23 (2 * 23/56)^2 = 23/28 of Kd (1 - Ks). The gloss from a
// table at the exponent whose width is the mean of the two.
Spectrum FresnelBlend::Rho() const {
  const Real width = (1 / std::sqrt(ex_ + 1) + 1 / std::sqrt(ey_ + 1)) / 2;
  const AlbedoRow row = AlbedoRow::Of(1 / (width * width) - 1);
  const auto& low = kFresnelBlendAlbedo[row.index];
  const auto& high = kFresnelBlendAlbedo[row.index + 1];
  const Real all = Lerp(row.fraction, Real(low[0]), Real(high[0]));
  const Real grazing = Lerp(row.fraction, Real(low[1]), Real(high[1]));
  constexpr Real kDiffuse = kPi * Square(Real(23) / 28);  // diffuse_ holds 28 / (23 pi)
  return Clamp(diffuse_ * kDiffuse + gloss_ * (all - grazing) + Spectrum(grazing), 0, 1);
}

}  // namespace exphoton
