// SPDX-License-Identifier: BSD-2-Clause
// MappedPointLight samples photons by its map, so that their weights are nearly constant.
#include "lights/environment/mapped_point_light.h"

#include "core/lights/emission_cone.h"
#include "core/lights/least_distance.h"
#include "lights/environment/light_directions.h"

namespace exphoton {
namespace {

class MappedPointLight final : public Light, public ConeEmitter {
 public:
  MappedPointLight(const Transform& lightToWorld, const Spectrum& intensity,
                   std::unique_ptr<const IntensityMap> map)
      : position_(lightToWorld.ApplyPoint({0, 0, 0})),
        directions_(lightToWorld),
        intensity_(intensity),
        map_(std::move(map)),
        integral_(lightToWorld.SimilarityScale() ? map_->Integral() : StretchedIntegral()) {}

  void Prepare(const Sphere3& world) override { leastDistance_ = LeastDistance(world); }
  bool IsDelta() const override { return true; }
  std::optional<Bounds3> Bounds() const override { return Bounds3(position_); }
  bool IsProvablyBlack() const override { return (intensity_ * map_->Largest()).IsBlack(); }
  Spectrum Power() const override { return intensity_ * integral_; }

  std::optional<LightLiSample> SampleDirect(const SurfacePoint& ref, Point2, Real) const override {
    const Vector3 toLight = position_ - ref.p;
    const Vector3 wi = NormalizeOr(toLight, {});
    const Real distance2 =
        std::max(LengthSquared(toLight), leastDistance_.Squared(ref.p, position_));
    if (wi == Vector3{} || !(distance2 > 0)) return std::nullopt;
    const Spectrum intensity = Intensity(-wi);
    if (intensity.IsBlack()) return std::nullopt;
    return LightLiSample{wi, intensity / distance2, 1, SpawnRayTo(ref, {position_, {}, {}})};
  }
  Real PdfDirect(const SurfacePoint&, const Vector3&, const SurfacePoint*) const override {
    return 0;
  }

  std::optional<LightLeSample> SampleEmission(Point2, Point2 uDirection, Real,
                                              Real time) const override {
    const Vector3 w = directions_.ToWorld(map_->Sample(uDirection));
    const Real pdf = DirectionPdf(w);
    if (!(pdf > 0 && pdf < kInfinity)) return std::nullopt;
    return LightLeSample{Ray{position_, w, kInfinity, time}, Intensity(w) / pdf, 1, pdf};
  }
  std::optional<Real> EmissionBound() const override {
    if (!directions_.KeepsSolidAngles()) return std::nullopt;
    return (intensity_ * map_->LargestWeight()).Y();
  }
  EmissionPdf PdfEmission(const SurfacePoint&, const Vector3& w) const override {
    return {0, DirectionPdf(w)};
  }

  // A transformation that stretches directions has no bound.
  EmissionCone Cone() const override {
    constexpr double kAll = 4;  // more than pi
    const IntensityMap::Cone cone = map_->EmissionCone();
    const bool isKnown = directions_.KeepsSolidAngles();
    return {position_, directions_.ToWorld(cone.axis), isKnown ? cone.halfAngle : kAll};
  }

 private:
  // Returns an estimate of the map's integral over world directions, from 4096 samples.
  Spectrum StretchedIntegral() const {
    constexpr int kSide = 64;
    Spectrum sum;
    for (int i = 0; i < kSide * kSide; ++i) {
      const Vector3 local = map_->Sample(
          {(Real(i % kSide) + Real(.5)) / kSide, (Real(i / kSide) + Real(.5)) / kSide});
      const Real pdf = map_->Pdf(local) * directions_.DensityFactor(local);
      if (pdf > 0 && pdf < kInfinity) sum += map_->Evaluate(local) / pdf;
    }
    return sum / Real(kSide * kSide);
  }
  // w leaves the light.
  Spectrum Intensity(const Vector3& w) const {
    return intensity_ * map_->Evaluate(directions_.ToLight(w));
  }
  Real DirectionPdf(const Vector3& w) const {
    const Vector3 local = directions_.ToLight(w);
    return map_->Pdf(local) * directions_.DensityFactor(local);
  }

  Point3 position_;
  LightDirections directions_;
  Spectrum intensity_;
  std::unique_ptr<const IntensityMap> map_;
  Spectrum integral_;  // of the map over world directions
  LeastDistance leastDistance_;
};

}  // namespace

const ParamTable<MappedPointLightSettings>& MappedPointLightParameters() {
  using Settings = MappedPointLightSettings;
  static const ParamTable<Settings> table{
      Param("I", &Settings::intensity, "radiant intensity, or factor on the map")
          .AtLeast(0)
          .Unit("W/sr"),
      Param("scale", &Settings::scale, "factor on I").AtLeast(0)};
  return table;
}

std::unique_ptr<Light> MakeMappedPointLight(const MappedPointLightSettings& settings,
                                            std::unique_ptr<const IntensityMap> map,
                                            const LightContext& context) {
  if (!context.lightToWorld.SimilarityScale())
    context.log.Warning("the light's transformation is not a similarity; the map is stretched",
                        context.where);
  if (map->Largest().IsBlack())
    context.log.Warning("the light's map is black: the light is off", context.where);
  return std::make_unique<MappedPointLight>(context.lightToWorld,
                                            settings.intensity * settings.scale, std::move(map));
}

}  // namespace exphoton
