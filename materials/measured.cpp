// SPDX-License-Identifier: BSD-2-Clause
// The material "measured" of version 2 is an isotropic BRDF from a file of measurements: the binary
// tables of the MERL database, or text with samples at irregular directions (".brdf").
#include "materials/measured/measured_brdf.h"

#include "core/params/scene_path.h"
#include "core/scattering/lobes/local_frame.h"
#include "materials/common/surface_material.h"

namespace exphoton {
namespace {

struct Settings : SurfaceSettings {
  std::string fileName;
};

const ParamTable<Settings>& Parameters() {
  static const ParamTable<Settings> table{
      SurfaceParameters(),
      Param("filename", &Settings::fileName,
            "measurements: text if its name ends in .brdf, else a table of the MERL database")
          .As(ParamType::File)
          .Required()};
  return table;
}

class MeasuredLobe final : public Bxdf {
 public:
  // `brdf` must outlive the lobe.
  explicit MeasuredLobe(const MeasuredBrdf& brdf) : Bxdf(LobeSet::GlossyReflection), brdf_(brdf) {}

  Spectrum f(const Vector3& wo, const Vector3& wi) const override {
    return SameHemisphere(wo, wi) ? brdf_.f(Upwards(wo), Upwards(wi)) : Spectrum();
  }
  Real Pdf(const Vector3& wo, const Vector3& wi) const override {
    return SameHemisphere(wo, wi) ? brdf_.Pdf(Upwards(wo), Upwards(wi)) : 0;
  }
  std::optional<BxdfSample> Sample(const Vector3& wo, Point2 u) const override {
    if (wo.z == 0) return std::nullopt;
    const Vector3 up = Upwards(wo), wi = brdf_.Sample(up, u);
    if (!(wi.z > 0)) return std::nullopt;
    const Real pdf = brdf_.Pdf(up, wi);
    const Spectrum weight = brdf_.f(up, wi) * (wi.z / pdf);
    if (!(pdf > 0) || !std::isfinite(pdf) || !weight.IsFinite()) return std::nullopt;
    return BxdfSample{OnSideOf(wi, wo), weight, pdf};
  }
  Spectrum Rho() const override { return Clamp(brdf_.Rho(), 0, 1); }

 private:
  static Vector3 Upwards(const Vector3& w) { return {w.x, w.y, std::abs(w.z)}; }

  const MeasuredBrdf& brdf_;
};

class Measured final : public SurfaceMaterial {
 public:
  Measured(const Settings& settings, std::shared_ptr<const MeasuredBrdf> brdf)
      : SurfaceMaterial(settings), brdf_(std::move(brdf)) {
    MayHave(LobeSet::GlossyReflection);
  }

  Bsdf Evaluate(SurfaceInteraction* si, TransportMode, Arena* arena) const override {
    Bsdf bsdf = MakeBsdf(si);
    bsdf.Add(arena->Make<MeasuredLobe>(*brdf_));
    return bsdf;
  }

 private:
  std::shared_ptr<const MeasuredBrdf> brdf_;
};

// Above 1 by the error of Rho.
constexpr Real kMaxReflectance = Real(1.05);

std::unique_ptr<Material> Create(const Settings& settings, const MaterialContext& context) {
  const auto read = [&] { return MeasuredBrdf(ReadMeasuredValues(settings.fileName)); };
  SharedCache own;
  SharedCache& cache = context.shared ? *context.shared : own;
  std::shared_ptr<const MeasuredBrdf> brdf;
  try {
    brdf = cache.GetOrMake<MeasuredBrdf>(settings.fileName, read);
  } catch (const MeasurementError& error) {
    throw ParamError{"filename", UnreadableFileText(settings.fileName, error.what()), ""};
  }
  if (brdf->Rho().MaxComponent() > kMaxReflectance)
    context.log.Warning("\"" + settings.fileName +
                            "\": the surface scatters more light than it "
                            "receives",
                        context.where);
  return std::make_unique<Measured>(settings, std::move(brdf));
}

}  // namespace
}  // namespace exphoton

EXPHOTON_MATERIAL("measured", "reflection from a file of measurements")
