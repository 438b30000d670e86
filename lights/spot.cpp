// SPDX-License-Identifier: BSD-2-Clause
// The light "spot" is a point light confined to a cone. It has full intensity within
// coneangle - conedeltaangle of the axis, and falls by a quartic to 0 at coneangle. Angles are
// compared by one minus cosine, which keeps narrow cones exact. Photons are sampled in proportion
// to the falloff, so all have the same weight.
#include "core/lights/emission_cone.h"
#include "core/lights/least_distance.h"
#include "core/math/sampling/sampling.h"
#include "core/plugin.h"

namespace exphoton {
namespace {

struct Settings {
  Spectrum intensity{1};
  Spectrum scale{1};
  Point3 from{0, 0, 0}, to{0, 0, 1};
  Real coneAngle = 30;  // degrees
  std::optional<Real> coneDeltaAngle;

  Real RimAngle() const { return coneDeltaAngle.value_or(std::min(Real(5), coneAngle)); }
  void Validate() const {
    if (from == to) throw ParamError{"to", "must differ from \"from\": there is no direction", ""};
    if (coneDeltaAngle > coneAngle)
      throw ParamError{"conedeltaangle", "must be at most \"coneangle\"", ""};
  }
};

const ParamTable<Settings>& Parameters() {
  static const ParamTable<Settings> table{
      Param("I", &Settings::intensity, "radiant intensity within the inner cone")
          .AtLeast(0)
          .Unit("W/sr"),
      Param("scale", &Settings::scale, "factor on I").AtLeast(0),
      Param("from", &Settings::from, "position").Unit("scene units"),
      Param("to", &Settings::to, "a point on the axis").Unit("scene units"),
      Param("coneangle", &Settings::coneAngle, "half-angle of the cone")
          .Above(0)
          .AtMost(180)
          .Unit("degrees"),
      Param("conedeltaangle", &Settings::coneDeltaAngle,
            "width of the rim where the light fades; 5, but at most coneangle, if absent")
          .Range(0, 180)
          .Unit("degrees")};
  return table;
}

class SpotLight final : public Light, public ConeEmitter {
 public:
  // totalAngle: half-angle of the cone; innerAngle: half-angle of full intensity. Both in radians.
  SpotLight(const Point3& position, const Vector3& axis, const Spectrum& intensity,
            double totalAngle, double innerAngle)
      : position_(position),
        axis_(axis),
        intensity_(intensity),
        totalAngle_(totalAngle),
        inner_(Real(2 * Squared(std::sin(innerAngle / 2)))),
        rim_(Real(2 * std::sin((totalAngle + innerAngle) / 2) *
                  std::sin((totalAngle - innerAngle) / 2))) {}

  void Prepare(const Sphere3& world) override { leastDistance_ = LeastDistance(world); }
  bool IsDelta() const override { return true; }
  std::optional<Bounds3> Bounds() const override { return Bounds3(position_); }
  bool IsProvablyBlack() const override { return intensity_.IsBlack(); }
  // Integral of the intensity: 2 pi I [(1 - cos inner) + (cos inner - cos total) / 5].
  Spectrum Power() const override { return intensity_ * EffectiveSolidAngle(); }

  std::optional<LightLiSample> SampleDirect(const SurfacePoint& ref, Point2, Real) const override {
    const Vector3 toLight = position_ - ref.p;
    const Vector3 wi = NormalizeOr(toLight, {});
    const Real distance2 =
        std::max(LengthSquared(toLight), leastDistance_.Squared(ref.p, position_));
    if (wi == Vector3{} || !(distance2 > 0)) return std::nullopt;
    const Real falloff = Falloff(-wi);
    if (falloff == 0) return std::nullopt;
    return LightLiSample{wi, intensity_ * (falloff / distance2), 1,
                         SpawnRayTo(ref, {position_, {}, {}})};
  }
  Real PdfDirect(const SurfacePoint&, const Vector3&, const SurfacePoint*) const override {
    return 0;
  }

  // The density per solid angle is the falloff over its integral.
  std::optional<LightLeSample> SampleEmission(Point2, Point2 u, Real, Real time) const override {
    const Real area = inner_ + rim_ / 5;  // effective solid angle / (2 pi)
    const Real inInner = u.x * area;
    Real oneMinusCos = inInner, falloff = 1;
    if (inInner >= inner_ && rim_ > 0) {
      // In the rim, delta = (cos - cos total) / (cos inner - cos total) has the density 5 delta^4.
      const Real fifth = std::clamp(1 - (inInner - inner_) * 5 / rim_, kMachineEpsilon, Real(1));
      const Real delta = std::pow(fifth, Real(.2));
      oneMinusCos = inner_ + rim_ * (1 - delta);
      falloff = Square(Square(delta));
    }
    const Real sinTheta = SafeSqrt(oneMinusCos * (2 - oneMinusCos));
    const Vector3 local = SphericalDirection(sinTheta, 1 - oneMinusCos, 2 * kPi * u.y);
    const Ray ray{position_, Frame::FromZ(axis_).ToWorld(local), kInfinity, time};
    return LightLeSample{ray, Power(), 1, falloff / EffectiveSolidAngle()};
  }
  std::optional<Real> EmissionBound() const override { return Power().Y(); }
  EmissionCone Cone() const override { return {position_, axis_, totalAngle_}; }
  EmissionPdf PdfEmission(const SurfacePoint&, const Vector3& w) const override {
    return {0, Falloff(w) / EffectiveSolidAngle()};
  }

 private:
  static double Squared(double x) { return x * x; }

  Real EffectiveSolidAngle() const { return 2 * kPi * (inner_ + rim_ / 5); }

  // Returns the share of the full intensity in direction w (unit, leaving the light).
  Real Falloff(const Vector3& w) const {
    const Real oneMinusCos = LengthSquared(w - axis_) / 2;
    if (oneMinusCos <= inner_) return 1;
    const Real left = inner_ + rim_ - oneMinusCos;
    return left > 0 ? Square(Square(left / rim_)) : 0;  // 0 also if the rim has no width
  }

  Point3 position_;
  Vector3 axis_;  // unit
  Spectrum intensity_;
  double totalAngle_;
  Real inner_;  // 1 - cos(inner angle)
  Real rim_;    // cos(inner angle) - cos(total angle)
  LeastDistance leastDistance_;
};

std::unique_ptr<Light> Create(const Settings& settings, const LightContext& context) {
  const Transform& toWorld = context.lightToWorld;
  const Vector3 axis = NormalizeOr(toWorld.ApplyVector(settings.to - settings.from), {});
  if (axis == Vector3{}) throw ParamError{"to", "gives no direction after transformation", ""};
  if (!toWorld.SimilarityScale())
    context.log.Warning(
        "light \"spot\": the transformation is not a similarity; the cone stays "
        "circular, with the angles given",
        context.where);
  constexpr double kRadiansPerDegree = 3.14159265358979323846 / 180;
  return std::make_unique<SpotLight>(
      toWorld.ApplyPoint(settings.from), axis, settings.intensity * settings.scale,
      double(settings.coneAngle) * kRadiansPerDegree,
      (double(settings.coneAngle) - double(settings.RimAngle())) * kRadiansPerDegree);
}

}  // namespace
}  // namespace exphoton

EXPHOTON_LIGHT("spot", "light from one point into a cone")
