// SPDX-License-Identifier: BSD-2-Clause
// The light "distant" emits parallel light, like the sun. L is its irradiance on a plane
// perpendicular to the light. Photons start on a disk that covers the bounding sphere of the scene.
#include "core/math/sampling/sampling.h"
#include "core/plugin.h"

namespace exphoton {
namespace {

struct Settings {
  Spectrum radiance{1};
  Spectrum scale{1};
  Point3 from{0, 0, 0}, to{0, 0, 1};

  void Validate() const {
    if (from == to) throw ParamError{"to", "must differ from \"from\": there is no direction", ""};
  }
};

const ParamTable<Settings>& Parameters() {
  static const ParamTable<Settings> table{
      Param("L", &Settings::radiance, "irradiance on a plane perpendicular to the light")
          .AtLeast(0)
          .Unit("W/m^2"),
      Param("scale", &Settings::scale, "factor on L").AtLeast(0),
      Param("from", &Settings::from, "with \"to\": the direction in which the light travels"),
      Param("to", &Settings::to, "see \"from\"")};
  return table;
}

class DistantLight final : public Light {
 public:
  DistantLight(const Vector3& toLight, const Spectrum& radiance)
      : toLight_(toLight), radiance_(radiance) {}

  void Prepare(const Sphere3& world) override { world_ = world; }
  bool IsDelta() const override { return true; }
  bool IsDistant() const override { return true; }
  bool IsProvablyBlack() const override { return radiance_.IsBlack(); }
  Spectrum Power() const override { return radiance_ * (kPi * world_.radius * world_.radius); }

  std::optional<LightLiSample> SampleDirect(const SurfacePoint& ref, Point2, Real) const override {
    return LightLiSample{toLight_, radiance_, 1, SpawnRay(ref, toLight_)};
  }
  Real PdfDirect(const SurfacePoint&, const Vector3&, const SurfacePoint*) const override {
    return 0;
  }

  // The density per area is 1 / (pi r^2).
  std::optional<LightLeSample> SampleEmission(Point2 uPosition, Point2, Real,
                                              Real time) const override {
    if (!(world_.radius > 0)) return std::nullopt;
    const Point2 d = SampleDisk(uPosition);
    const Frame frame = Frame::FromZ(toLight_);
    // Start slightly outside the sphere, so that rounding never starts a photon inside a wall that
    // touches the sphere.
    const Vector3 offset = frame.x * d.x + frame.y * d.y + toLight_ * Real(1.001);
    const Ray ray{world_.center + offset * world_.radius, -toLight_, kInfinity, time};
    return LightLeSample{ray, Power(), DiskPdf(), 1};
  }
  std::optional<Real> EmissionBound() const override { return Power().Y(); }
  EmissionPdf PdfEmission(const SurfacePoint&, const Vector3&) const override {
    return {world_.radius > 0 ? DiskPdf() : 0, 0};
  }

 private:
  Real DiskPdf() const { return 1 / (kPi * world_.radius * world_.radius); }

  Vector3 toLight_;  // unit
  Spectrum radiance_;
  Sphere3 world_;
};

std::unique_ptr<Light> Create(const Settings& settings, const LightContext& context) {
  const Vector3 toLight =
      NormalizeOr(context.lightToWorld.ApplyVector(settings.from - settings.to), {});
  if (toLight == Vector3{}) throw ParamError{"to", "gives no direction after transformation", ""};
  return std::make_unique<DistantLight>(toLight, settings.radiance * settings.scale);
}

}  // namespace
}  // namespace exphoton

EXPHOTON_LIGHT("distant", "parallel light from far away, as the sun's")
