// SPDX-License-Identifier: BSD-2-Clause
// The area light "area" ("diffuse" in version 2 of the scene language) emits the same radiance from
// every point into the hemisphere about the normal, and nothing on the back.
#include "core/lights/emission_cone.h"
#include "core/math/sampling/sampling.h"
#include "core/plugin.h"

namespace exphoton {
namespace {

struct Settings {
  Spectrum radiance{1};
  Spectrum scale{1};
  int sampleCount = 1;
};

const ParamTable<Settings>& Parameters() {
  static const ParamTable<Settings> table{
      Param("L", &Settings::radiance, "emitted radiance").AtLeast(0).Unit("W/(m^2 sr)"),
      Param("scale", &Settings::scale, "factor on L").AtLeast(0),
      Param("nsamples", &Settings::sampleCount, "shadow rays at a shading point")
          .Range(1, 1 << 20)};
  return table;
}

class DiffuseAreaLight final : public AreaLight, public OneSided {
 public:
  DiffuseAreaLight(std::shared_ptr<const EmitterSurface> surface, const Spectrum& radiance,
                   int sampleCount)
      : surface_(std::move(surface)),
        area_(surface_->Area()),
        bounds_(surface_->Bounds()),
        radiance_(radiance),
        sampleCount_(sampleCount) {}

  bool IsProvablyBlack() const override { return radiance_.IsBlack(); }
  int SampleCount() const override { return sampleCount_; }
  std::optional<Bounds3> Bounds() const override { return bounds_; }
  Spectrum Power() const override { return radiance_ * (kPi * area_); }
  bool MayMeet(const Ray& ray) const override {
    return IntersectBox(bounds_, ray.o, ray.d, ray.tMax).has_value();
  }

  Spectrum L(const SurfacePoint& on, Point2, const Vector3& w) const override {
    return Dot(on.ng, w) > 0 ? radiance_ : Spectrum{};
  }

  std::optional<LightLiSample> SampleDirect(const SurfacePoint& ref, Point2 u,
                                            Real uSubLight) const override {
    const auto sample = surface_->SampleToward(ref, u, uSubLight);
    if (!sample || !(sample->pdf > 0)) return std::nullopt;
    const Vector3 wi = NormalizeOr(sample->point.p - ref.p, {});
    if (!(Dot(sample->point.ng, -wi) > 0)) return std::nullopt;
    return LightLiSample{wi, radiance_, sample->pdf, SpawnRayTo(ref, sample->point)};
  }
  Real PdfDirect(const SurfacePoint& ref, const Vector3& wi,
                 const SurfacePoint* on) const override {
    return on ? surface_->PdfToward(ref, wi, *on) : 0;
  }

  // Samples the position by area and the direction by cosine, so that at one time every ray carries
  // the same power.
  std::optional<LightLeSample> SampleEmission(Point2 uPosition, Point2 uDirection, Real uSubLight,
                                              Real time) const override {
    EmitterSample sample = surface_->SamplePoint(uPosition, uSubLight, time);
    sample.point.time = time;
    const Vector3 local = SampleCosineHemisphere(uDirection);
    const Vector3 w = Frame::FromZ(sample.point.ng).ToWorld(local);
    // 1 unless the surface is scaled non-uniformly, or stretched by its motion.
    const Real stretched = 1 / area_ / sample.pdf;
    return LightLeSample{SpawnRay(sample.point, w), Power() * stretched, sample.pdf,
                         CosineHemispherePdf(local.z)};
  }
  std::optional<Real> EmissionBound() const override {
    if (!surface_->IsSampledUniformly()) return std::nullopt;
    return Power().Y();
  }
  EmissionPdf PdfEmission(const SurfacePoint& from, const Vector3& w) const override {
    return {1 / area_, CosineHemispherePdf(Dot(from.ng, w))};
  }

  bool MayFace(const Bounds3& box) const override { return surface_->MayFace(box); }

 private:
  std::shared_ptr<const EmitterSurface> surface_;
  Real area_;
  Bounds3 bounds_;
  Spectrum radiance_;
  int sampleCount_;
};

std::unique_ptr<AreaLight> Create(const Settings& settings, const AreaLightContext& context) {
  if (const char* problem = context.surface->EmitterProblem())
    throw Error(ExitStatus::Scene, problem, context.where);
  Spectrum radiance = settings.radiance * settings.scale;
  const Real area = context.surface->Area();
  if (!(area > 0) || !std::isfinite(1 / area)) {
    context.log.Warning("area light on a surface without area: it emits nothing", context.where);
    radiance = {};
  }
  return std::make_unique<DiffuseAreaLight>(context.surface, radiance, settings.sampleCount);
}

}  // namespace
}  // namespace exphoton

EXPHOTON_AREA_LIGHT("area", "a surface that emits light on the side of its normal")
