// SPDX-License-Identifier: BSD-2-Clause
// RevolvedQuadric is the base class of cone, paraboloid and hyperboloid. Their surfaces arise when
// a curve, the meridian, turns about the z axis. The squared distance of the meridian from the axis
// is a quadratic polynomial of z. As a light, such a shape is sampled uniformly by area.
#pragma once

#include <memory>
#include <vector>

#include "core/geometry/placed_emitter.h"
#include "shapes/quadric/quadric.h"

namespace exphoton {

// Meridian describes the curve by a parameter v in [0, 1], in object space:
//   z(v) = z0 + v dz,   x(v)^2 + y(v)^2 = a + 2 b v + c v^2.
// A straight meridian is (x0 + v dx, y0 + v dy). Any other lies in the plane y = 0 with x >= 0.
struct Meridian {
  double z0 = 0, dz = 1;  // dz is not 0
  double a = 0, b = 0, c = 0;
  bool isStraight = false;
  double x0 = 0, y0 = 0, dx = 0, dy = 0;

  // Returns the line from `start` to `end`, which must differ in z.
  static Meridian Line(const Vec3d& start, const Vec3d& end);

  double Z(double v) const { return z0 + v * dz; }
  double Radius2(double v) const { return std::max(a + v * (2 * b + v * c), 0.0); }
  double HalfSlope(double v) const { return b + v * c; }  // half the derivative of Radius2
  // Returns the azimuth of the meridian's point, which is 0 unless the meridian is a skew line.
  double Azimuth(double v) const;
  // Returns |dp/dphi x dp/dv|, the area that the surface has per radian and per unit of v.
  double AreaElement(double v) const {
    return std::sqrt(Radius2(v) * dz * dz + HalfSlope(v) * HalfSlope(v));
  }
};

// MeridianArea integrates AreaElement over v and inverts the integral.
class MeridianArea {
 public:
  explicit MeridianArea(const Meridian& meridian);

  double Total() const { return nodes_.back().area; }
  // Returns the v below which the share u, in [0, 1), of the area lies.
  double Invert(double u) const;

 private:
  struct Node {
    double v, area;  // the area below v
  };
  double Integrate(double from, double to) const;

  Meridian meridian_;
  std::vector<Node> nodes_;  // ascending in v, from 0 to 1
};

class RevolvedQuadric : public QuadricShape {
 public:
  // phiMax is the angle swept about z, in degrees.
  RevolvedQuadric(const Meridian& meridian, Real phiMaxDegrees, const ShapeContext& context);

  Real Area() const override { return uneven_ ? uneven_->Area() : area_; }
  Bounds3 Bounds() const override;
  bool IsSampledUniformly() const override { return !uneven_; }
  EmitterSample SamplePoint(Point2 u, Real uSubLight, Real time) const override;
  std::optional<EmitterSample> SampleToward(const SurfacePoint& ref, Point2 u,
                                            Real uSubLight) const override;
  Real PdfToward(const SurfacePoint& ref, const Vector3& wi, const SurfacePoint& on) const override;

 protected:
  QuadricRoots Roots(const ObjectRay& ray) const override;
  bool Has(const Vec3d& p) const override;
  QuadricPoint Describe(const Vec3d& p) const override;

 private:
  // Returns the angle, in [0, 2 pi], by which the meridian has turned at the azimuth of (x, y).
  double AngleSwept(double x, double y, double v) const;
  // Returns dp/dv at p.
  Vec3d AlongMeridian(const Vec3d& p, double angle, double v) const;

  Meridian meridian_;
  double phiMax_;
  bool isRound_;
  MeridianArea distribution_;
  Real area_;
  std::unique_ptr<const PlacedEmitter> uneven_;  // set if the axes are scaled differently
};

}  // namespace exphoton
