// SPDX-License-Identifier: BSD-2-Clause
// The "orthographic" camera has parallel rays from a window in the plane z = 0. With a lens radius,
// the rays of a film point meet in the plane of focus.
#include "core/cameras/common/camera_base.h"

namespace exphoton {
namespace {

class OrthographicCamera final : public CameraBase {
 public:
  using CameraBase::CameraBase;

  bool HasLens() const override { return Common().lensRadius > 0; }
  Matrix4 WorldToNdc() const override {
    return WindowMatrix(1, false) * CameraToWorld().InverseMatrix();
  }
  std::optional<Matrix4> WorldToNdcThrough(Point2 point) const override {
    return WindowMatrix(1, false) * LensShear(point) * CameraToWorld().InverseMatrix();
  }

 private:
  CameraSpaceRay Generate(Point2 film, Point2 lens) const override {
    const auto [x, y] = Screen(film);
    return ThinLensRay(Point3(Real(x), Real(y), 0), 0, 0, lens);
  }
};

const ParamTable<CameraSettings>& Parameters() { return CameraParameters(); }

std::unique_ptr<Camera> Create(const CameraSettings& settings, const CameraContext& context) {
  return std::make_unique<OrthographicCamera>(settings, context);
}

}  // namespace
}  // namespace exphoton

EXPHOTON_CAMERA("orthographic", "parallel rays")
