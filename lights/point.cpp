// SPDX-License-Identifier: BSD-2-Clause
// The light "point" has the same intensity in every direction from one point. Smaller distances
// than a minimum (core/lights/least_distance.h) count as the minimum, so that a light on a surface
// stays finite.
#include "core/lights/least_distance.h"
#include "core/math/sampling/sampling.h"
#include "core/plugin.h"

namespace exphoton {
namespace {

struct Settings {
  Spectrum intensity{1};
  Spectrum scale{1};
  Point3 from;
};

const ParamTable<Settings>& Parameters() {
  static const ParamTable<Settings> table{
      Param("I", &Settings::intensity, "radiant intensity").AtLeast(0).Unit("W/sr"),
      Param("scale", &Settings::scale, "factor on I").AtLeast(0),
      Param("from", &Settings::from, "position").Unit("scene units")};
  return table;
}

class PointLight final : public Light {
 public:
  PointLight(const Point3& position, const Spectrum& intensity)
      : position_(position), intensity_(intensity) {}

  void Prepare(const Sphere3& world) override { leastDistance_ = LeastDistance(world); }
  bool IsDelta() const override { return true; }
  std::optional<Bounds3> Bounds() const override { return Bounds3(position_); }
  bool IsProvablyBlack() const override { return intensity_.IsBlack(); }
  Spectrum Power() const override { return intensity_ * (4 * kPi); }

  std::optional<LightLiSample> SampleDirect(const SurfacePoint& ref, Point2, Real) const override {
    const Vector3 toLight = position_ - ref.p;
    const Vector3 wi = NormalizeOr(toLight, {});
    const Real distance2 =
        std::max(LengthSquared(toLight), leastDistance_.Squared(ref.p, position_));
    if (wi == Vector3{} || !(distance2 > 0)) return std::nullopt;
    return LightLiSample{wi, intensity_ / distance2, 1, SpawnRayTo(ref, {position_, {}, {}})};
  }
  Real PdfDirect(const SurfacePoint&, const Vector3&, const SurfacePoint*) const override {
    return 0;
  }

  std::optional<LightLeSample> SampleEmission(Point2, Point2 uDirection, Real,
                                              Real time) const override {
    const Ray ray{position_, SampleUniformSphere(uDirection), kInfinity, time};
    return LightLeSample{ray, Power(), 1, kUniformSpherePdf};
  }
  std::optional<Real> EmissionBound() const override { return Power().Y(); }
  EmissionPdf PdfEmission(const SurfacePoint&, const Vector3&) const override {
    return {0, kUniformSpherePdf};
  }

 private:
  Point3 position_;
  Spectrum intensity_;
  LeastDistance leastDistance_;
};

std::unique_ptr<Light> Create(const Settings& settings, const LightContext& context) {
  return std::make_unique<PointLight>(context.lightToWorld.ApplyPoint(settings.from),
                                      settings.intensity * settings.scale);
}

}  // namespace
}  // namespace exphoton

EXPHOTON_LIGHT("point", "light from one point, equal in all directions")
