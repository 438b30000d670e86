// SPDX-License-Identifier: BSD-2-Clause
// CameraBase is the shared part of the camera plugins: their parameters, the film's window and the
// conversion of camera-space rays to world-space rays with neighbours. Camera space is left-handed:
// x to the right, y up, the view along +z.
#pragma once

#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "core/math/sampling/sampling.h"
#include "core/plugin.h"

namespace exphoton {

struct CameraSettings {
  Real hither = Real(1e-3), yon = Real(1e30);
  Real shutterOpen = 0, shutterClose = 1;
  Real lensRadius = 0, focalDistance = Real(1e30);
  std::optional<Real> frameAspectRatio;
  std::optional<std::vector<Real>> screenWindow;  // x0 x1 y0 y1

  void Validate() const {
    if (!(hither < yon)) throw ParamError{"hither", "must be less than 'yon'", ""};
    if (shutterClose < shutterOpen)
      throw ParamError{"shutterclose", "must not be before 'shutteropen'", ""};
    if (!screenWindow) return;
    const std::vector<Real>& w = *screenWindow;
    if (w.size() != 4) throw ParamError{"screenwindow", "takes four numbers: x0 x1 y0 y1", ""};
    if (w[0] == w[1] || w[2] == w[3])
      throw ParamError{"screenwindow", "must not be empty", "the order is x0 x1 y0 y1"};
  }
};

// The parameters that have an effect in every camera.
inline const ParamTable<CameraSettings>& DepthAndShutterParameters() {
  using S = CameraSettings;
  static const ParamTable<S> table{
      Param("hither", &S::hither, "nearer surfaces are not seen").AtLeast(0).Unit("camera units"),
      Param("yon", &S::yon, "farther surfaces are not seen").Above(0).Unit("camera units"),
      Param("shutteropen", &S::shutterOpen, "start of the exposure"),
      Param("shutterclose", &S::shutterClose, "end of the exposure")};
  return table;
}

// The parameters of cameras that have a lens and a screen.
inline const ParamTable<CameraSettings>& CameraParameters() {
  using S = CameraSettings;
  static const ParamTable<S> table{
      DepthAndShutterParameters(),
      Param("lensradius", &S::lensRadius, "radius of the thin lens; 0: a pinhole")
          .Range(0, 1e15)
          .Unit("camera units"),
      Param("focaldistance", &S::focalDistance, "distance of the plane in focus")
          .AtLeast(1e-15)
          .Unit("camera units"),
      Param("frameaspectratio", &S::frameAspectRatio, "width by height; the film's if absent")
          .Range(1e-6, 1e6),
      Param("screenwindow", &S::screenWindow,
            "part of the screen that the film shows, x0 x1 y0 y1; the shorter axis from -1 to 1 "
            "if absent")
          .Range(-1e15, 1e15)};
  return table;
}

// CameraSpaceRay is a ray in camera space. Only the part with start <= t <= end is seen.
struct CameraSpaceRay {
  Point3 o;
  Vector3 d;  // unit
  Real start, end;
};

class CameraBase : public Camera {
 public:
  CameraBase(const CameraSettings& settings, const CameraContext& context)
      : settings_(settings),
        motion_(context.cameraToWorld),
        cameraToWorld_(motion_.At(settings.shutterOpen)),
        xResolution_(context.xResolution),
        yResolution_(context.yResolution) {
    const double aspect = settings.frameAspectRatio
                              ? double(*settings.frameAspectRatio)
                              : double(context.xResolution) / double(context.yResolution);
    const double right = std::max(aspect, 1.), top = std::max(1 / aspect, 1.);
    window_ = {-right, right, -top, top};
    if (settings.screenWindow)
      for (std::size_t i = 0; i < 4; ++i) window_[i] = double((*settings.screenWindow)[i]);
  }

  RayDifferential GenerateRay(const CameraSample& sample, bool withDifferentials) const override {
    const Real time = std::clamp(Lerp(sample.time, settings_.shutterOpen, settings_.shutterClose),
                                 settings_.shutterOpen, settings_.shutterClose);
    return motion_.Moves() ? GenerateRay(sample, time, motion_.At(time), withDifferentials)
                           : GenerateRay(sample, time, cameraToWorld_, withDifferentials);
  }
  Interval Shutter() const override { return {settings_.shutterOpen, settings_.shutterClose}; }
  bool MovesWithin(Interval interval) const override { return motion_.MovesWithin(interval); }
  const Transform& CameraToWorld() const override { return cameraToWorld_; }
  Real Depth(const Point3& p, Real time) const override { return ToCamera(p, time).z; }

 protected:
  virtual CameraSpaceRay Generate(Point2 film, Point2 lens) const = 0;

  // Maps the film to the screen, where x runs to the right and y up. The film's y runs down.
  std::array<double, 2> Screen(Point2 film) const {
    const auto& [x0, x1, y0, y1] = window_;
    return {x0 + (x1 - x0) * (double(film.x) / xResolution_),
            y1 - (y1 - y0) * (double(film.y) / yResolution_)};
  }

  // Returns a ray through the thin lens at `point` (z = 0). It meets the ray without a lens, of
  // direction (slopeX, slopeY, 1), in the plane of focus. It is clipped at the planes of hither and
  // yon.
  CameraSpaceRay ThinLensRay(const Point3& point, double slopeX, double slopeY, Point2 lens) const {
    CameraSpaceRay ray{point, {}, 0, 0};
    if (settings_.lensRadius > 0) {
      const Point2 l = SampleDisk(lens) * settings_.lensRadius;
      ray.o += Vector3(l.x, l.y, 0);
      slopeX -= double(l.x) / double(settings_.focalDistance);
      slopeY -= double(l.y) / double(settings_.focalDistance);
    }
    const double length = std::sqrt(slopeX * slopeX + slopeY * slopeY + 1);
    ray.d = {Real(slopeX / length), Real(slopeY / length), Real(1 / length)};
    ray.start = Real(double(settings_.hither) * length);
    ray.end = Real(std::min(double(settings_.yon) * length, 1e38));
    return ray;
  }

  // Returns a projective matrix that maps the window to [-1,1]^2 and hither..yon to 0..1.
  Matrix4 WindowMatrix(double scale, bool isPerspective) const {
    const auto& [x0, x1, y0, y1] = window_;
    const double hither = settings_.hither, depth = double(settings_.yon) - hither;
    const std::size_t shift = isPerspective ? 2 : 3;
    Matrix4 matrix;
    auto& m = matrix.m;
    m = {};
    m[0][0] = 2 / (scale * (x1 - x0));
    m[0][shift] = -(x0 + x1) / (x1 - x0);
    m[1][1] = 2 / (scale * (y1 - y0));
    m[1][shift] = -(y0 + y1) / (y1 - y0);
    m[2][2] = (isPerspective ? double(settings_.yon) : 1) / depth;
    m[2][3] = -hither * m[2][2];
    m[3][shift] = 1;
    return matrix;
  }

  // Returns the matrix that moves a point of camera space to where the ray to it through the centre
  // of the lens has the film place of the ray through another point, which is in the unit disk.
  // Points in focus stay.
  Matrix4 LensShear(Point2 point) const {
    Matrix4 matrix;
    const Point2 l = point * settings_.lensRadius;
    const double distance = settings_.focalDistance;
    matrix.m[0][2] = double(l.x) / distance, matrix.m[0][3] = -double(l.x);
    matrix.m[1][2] = double(l.y) / distance, matrix.m[1][3] = -double(l.y);
    return matrix;
  }

  // Returns a point of world space in camera space.
  Point3 ToCamera(const Point3& p, Real time) const {
    const Transform toWorld = motion_.Moves() ? motion_.At(time) : cameraToWorld_;
    return toWorld.Inverted().ApplyPoint(p);
  }
  const CameraSettings& Common() const { return settings_; }
  int XResolution() const { return xResolution_; }
  int YResolution() const { return yResolution_; }

 private:
  RayDifferential GenerateRay(const CameraSample& sample, Real time, const Transform& toWorld,
                              bool withDifferentials) const {
    RayDifferential ray = ToWorld(toWorld, Generate(sample.film, sample.lens));
    ray.time = time;
    if (!withDifferentials) return ray;
    const Ray x = ToWorld(toWorld, Generate(sample.film + Point2(1, 0), sample.lens));
    const Ray y = ToWorld(toWorld, Generate(sample.film + Point2(0, 1), sample.lens));
    ray.hasDifferentials = true;
    ray.xOrigin = x.o, ray.xDirection = x.d;
    ray.yOrigin = y.o, ray.yDirection = y.d;
    return ray;
  }
  // A camera may be scaled. The direction is then normalised again, and tMax grows with the scale.
  static Ray ToWorld(const Transform& toWorld, const CameraSpaceRay& local) {
    Ray ray;
    ray.o = toWorld.ApplyPoint(local.o + local.d * local.start);
    const Vector3 d = toWorld.ApplyVector(local.d);
    ray.d = NormalizeOr(d, Vector3(0, 0, 1));
    ray.tMax = (local.end - local.start) * std::hypot(d.x, d.y, d.z);
    return ray;
  }

  CameraSettings settings_;
  AnimatedTransform motion_;
  Transform cameraToWorld_;  // when the shutter opens
  int xResolution_, yResolution_;
  std::array<double, 4> window_;  // x0 x1 y0 y1
};

}  // namespace exphoton
