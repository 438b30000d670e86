// SPDX-License-Identifier: BSD-2-Clause
// The "environment" camera sees all directions at once. The film's y is the angle from +y (up), and
// the film's x is the azimuth from +x to +z. hither and yon are distances. There is no lens.
#include "core/cameras/common/camera_base.h"

namespace exphoton {
namespace {

class EnvironmentCamera final : public CameraBase {
 public:
  using CameraBase::CameraBase;

  Real Depth(const Point3& p, Real time) const override {
    const Point3 local = ToCamera(p, time);
    return std::hypot(local.x, local.y, local.z);
  }

 private:
  CameraSpaceRay Generate(Point2 film, Point2) const override {
    const double theta = M_PI * double(film.y) / YResolution();
    const double phi = 2 * M_PI * double(film.x) / XResolution();
    const Vector3 d(Real(std::sin(theta) * std::cos(phi)), Real(std::cos(theta)),
                    Real(std::sin(theta) * std::sin(phi)));
    return {{}, d, Common().hither, Common().yon};
  }
};

const ParamTable<CameraSettings>& Parameters() {
  using S = CameraSettings;
  static const ParamTable<S> table{
      DepthAndShutterParameters(),
      Param("lensradius", &S::lensRadius, "there is no lens").Range(0, 1e15).Ignored(),
      Param("focaldistance", &S::focalDistance, "there is no lens").AtLeast(1e-15).Ignored(),
      Param("frameaspectratio", &S::frameAspectRatio, "the film shows every direction")
          .Range(1e-6, 1e6)
          .Ignored(),
      Param("screenwindow", &S::screenWindow, "the film shows every direction")
          .Range(-1e15, 1e15)
          .Ignored()};
  return table;
}

std::unique_ptr<Camera> Create(const CameraSettings& settings, const CameraContext& context) {
  return std::make_unique<EnvironmentCamera>(settings, context);
}

}  // namespace
}  // namespace exphoton

EXPHOTON_CAMERA("environment", "every direction, as a map of latitude and longitude")
