// SPDX-License-Identifier: BSD-2-Clause
// Material "velvet": fibres that stand on a dark ground and scatter light at grazing angles.
// f = 6 / pi Kd (1 - |cos wo|)^2 (1 - |cos wi|)^2, which scatters Kd (1 - |cos wo|)^2.
#include "core/math/sampling/sampling.h"
#include "core/plugin.h"
#include "core/scattering/lobes/local_frame.h"

namespace exphoton {
namespace {

struct Settings {
  TexturePtr<Spectrum> kd = Uniform(Spectrum(Real(.5)));
};

const ParamTable<Settings>& Parameters() {
  static const ParamTable<Settings> table{
      Param("Kd", &Settings::kd, "share of grazing light that the fibres scatter").Range(0, 1)};
  return table;
}

// The local frame has z along the shading normal.
class FibreLobe final : public Bxdf {
 public:
  explicit FibreLobe(const Spectrum& kd) : Bxdf(LobeSet::DiffuseReflection), kd_(kd) {}

  Spectrum f(const Vector3& wo, const Vector3& wi) const override {
    if (!SameHemisphere(wo, wi)) return {};
    return kd_ * (6 * kInvPi * Grazing(wo) * Grazing(wi));
  }
  Real Pdf(const Vector3& wo, const Vector3& wi) const override {
    return SameHemisphere(wo, wi) ? std::abs(wi.z) * kInvPi : 0;
  }
  std::optional<BxdfSample> Sample(const Vector3& wo, Point2 u) const override {
    const Vector3 wi = OnSideOf(SampleCosineHemisphere(u), wo);
    const Real pdf = Pdf(wo, wi);
    if (!(pdf > 0)) return std::nullopt;
    return BxdfSample{wi, f(wo, wi) * (std::abs(wi.z) / pdf), pdf};
  }
  std::optional<Spectrum> ThroughputBound(const Vector3& wo) const override {
    return kd_ * (6 * Grazing(wo));
  }
  Spectrum Rho() const override { return kd_ / 6; }

 private:
  static Real Grazing(const Vector3& w) { return (1 - std::abs(w.z)) * (1 - std::abs(w.z)); }

  Spectrum kd_;
};

class Velvet final : public Material {
 public:
  explicit Velvet(const Settings& settings) : kd_(settings.kd) {}

  Bsdf Evaluate(SurfaceInteraction* si, TransportMode, Arena* arena) const override {
    Bsdf bsdf(*si);
    bsdf.Add(arena->Make<FibreLobe>(Clamp(kd_->Evaluate(*si), 0, 1)));
    return bsdf;
  }
  LobeSet PossibleLobes() const override { return LobeSet::DiffuseReflection; }
  bool NeedsDifferentials() const override { return kd_->IsFiltered(); }

 private:
  TexturePtr<Spectrum> kd_;
};

std::unique_ptr<Material> Create(const Settings& settings, const MaterialContext&) {
  return std::make_unique<Velvet>(settings);
}

}  // namespace
}  // namespace exphoton

EXPHOTON_MATERIAL("velvet", "fibres that shine at grazing angles")
