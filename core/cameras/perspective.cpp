// SPDX-License-Identifier: BSD-2-Clause
// The "perspective" camera is a pinhole or a thin lens.
#include "core/cameras/common/camera_base.h"

namespace exphoton {
namespace {

struct Settings : CameraSettings {
  Real fov = 90;
  std::optional<Real> halfFov;

  double TangentOfHalf() const {
    return halfFov ? std::tan(double(*halfFov) * (M_PI / 180))
                   : std::tan(double(fov) * (M_PI / 360));
  }
};

const ParamTable<Settings>& Parameters() {
  static const ParamTable<Settings> table{
      CameraParameters(),
      Param("fov", &Settings::fov, "field of view of the image's shorter axis")
          .Above(0)
          .Below(180)
          .Unit("degrees"),
      Param("halffov", &Settings::halfFov, "half of 'fov', which it replaces")
          .Above(0)
          .Below(90)
          .Unit("degrees")};
  return table;
}

class PerspectiveCamera final : public CameraBase {
 public:
  PerspectiveCamera(const Settings& settings, const CameraContext& context)
      : CameraBase(settings, context), tan_(settings.TangentOfHalf()) {}

  bool HasLens() const override { return Common().lensRadius > 0; }
  Matrix4 WorldToNdc() const override {
    return WindowMatrix(tan_, true) * CameraToWorld().InverseMatrix();
  }
  std::optional<Matrix4> WorldToNdcThrough(Point2 point) const override {
    return WindowMatrix(tan_, true) * LensShear(point) * CameraToWorld().InverseMatrix();
  }

 private:
  CameraSpaceRay Generate(Point2 film, Point2 lens) const override {
    const auto [x, y] = Screen(film);
    return ThinLensRay({}, x * tan_, y * tan_, lens);
  }

  double tan_;  // tangent of half the field of view
};

std::unique_ptr<Camera> Create(const Settings& settings, const CameraContext& context) {
  return std::make_unique<PerspectiveCamera>(settings, context);
}

}  // namespace
}  // namespace exphoton

EXPHOTON_CAMERA("perspective", "pinhole or thin lens")
