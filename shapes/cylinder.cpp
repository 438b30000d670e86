// SPDX-License-Identifier: BSD-2-Clause
// The shape "cylinder" is an open tube about z between zmin and zmax, swept by phimax degrees. u
// follows the azimuth, v runs from zmin to zmax. As a light it is sampled by area.
#include "core/geometry/placed_emitter.h"
#include "core/plugin.h"
#include "shapes/quadric/quadric.h"

namespace exphoton {
namespace {

struct Settings {
  Real radius = 1;
  Real zMin = -1, zMax = 1;
  Real phiMaxDegrees = 360;

  void Validate() const {
    if (zMin == zMax) throw ParamError{"zmin", "must differ from 'zmax'", ""};
  }
};

const ParamTable<Settings>& Parameters() {
  static const ParamTable<Settings> table{
      Param("radius", &Settings::radius, "radius").Above(0).Unit("scene units"),
      Param("zmin", &Settings::zMin, "lower end").Unit("scene units"),
      Param("zmax", &Settings::zMax, "upper end").Unit("scene units"),
      Param("phimax", &Settings::phiMaxDegrees, "angle swept about z")
          .Above(0)
          .AtMost(360)
          .Unit("degrees")};
  return table;
}

class Cylinder final : public QuadricShape {
 public:
  Cylinder(const Settings& settings, const ShapeContext& context)
      : QuadricShape(context),
        radius_(double(settings.radius)),
        zMin_(double(std::min(settings.zMin, settings.zMax))),
        zMax_(double(std::max(settings.zMin, settings.zMax))),
        phiMax_(double(settings.phiMaxDegrees) * (3.14159265358979323846 / 180)),
        isRound_(settings.phiMaxDegrees == 360),
        area_(Real(phiMax_ * radius_ * (zMax_ - zMin_) * AreaScale().value_or(0))) {
    if (!AreaScale()) {
      uneven_ = std::make_unique<PlacedEmitter>(
          std::make_unique<Cylinder>(settings, InOwnSpace(context)), objectToWorld_);
    }
  }

  Real Area() const override { return uneven_ ? uneven_->Area() : area_; }
  Bounds3 Bounds() const override {
    const Real r = Real(radius_);
    return objectToWorld_.ApplyBounds({{-r, -r, Real(zMin_)}, {r, r, Real(zMax_)}});
  }

  bool IsSampledUniformly() const override { return !uneven_; }
  EmitterSample SamplePoint(Point2 u, Real uSubLight, Real time) const override {
    if (uneven_) return uneven_->SamplePoint(u, uSubLight, time);
    const double phi = double(u.y) * phiMax_, z = zMin_ + double(u.x) * (zMax_ - zMin_);
    return MakeSample(Describe({radius_ * std::cos(phi), radius_ * std::sin(phi), z}), 1 / area_);
  }
  std::optional<EmitterSample> SampleToward(const SurfacePoint& ref, Point2 u,
                                            Real uSubLight) const override {
    if (uneven_) return uneven_->SampleToward(ref, u, uSubLight);
    return EmitterSurface::SampleToward(ref, u, uSubLight);
  }
  Real PdfToward(const SurfacePoint& ref, const Vector3& wi,
                 const SurfacePoint& on) const override {
    if (uneven_) return uneven_->PdfToward(ref, wi, on);
    return EmitterSurface::PdfToward(ref, wi, on);
  }

 protected:
  QuadricRoots Roots(const ObjectRay& ray) const override {
    return IntersectRound({ray.o.x, ray.o.y, 0}, {ray.d.x, ray.d.y, 0}, radius_);
  }
  bool Has(const Vec3d& p) const override {
    return p.z >= zMin_ && p.z <= zMax_ && (isRound_ || AzimuthOf(p.x, p.y) <= phiMax_);
  }
  QuadricPoint Describe(const Vec3d& p) const override {
    QuadricPoint point;
    point.n = NormalizeOrZero({p.x, p.y, 0});
    if (Dot(point.n, point.n) == 0) point.n = {1, 0, 0};
    const Vec3d q(point.n.x * radius_, point.n.y * radius_, p.z);
    point.p = q;
    point.uv = {Real(std::min(AzimuthOf(q.x, q.y) / phiMax_, 1.0)),
                Real((q.z - zMin_) / (zMax_ - zMin_))};
    point.dpdu = Vec3d(-q.y, q.x, 0) * phiMax_;
    point.dpdv = {0, 0, zMax_ - zMin_};
    point.dndu = point.dpdu * (1 / radius_);
    return point;
  }

 private:
  double radius_, zMin_, zMax_, phiMax_;
  bool isRound_;
  Real area_;
  std::unique_ptr<const PlacedEmitter> uneven_;  // set if the axes are scaled differently
};

std::unique_ptr<ShapeGeometry> Create(const Settings& settings, const ShapeContext& context) {
  return std::make_unique<ShapeGeometry>(std::make_unique<Cylinder>(settings, context));
}

}  // namespace
}  // namespace exphoton

EXPHOTON_SHAPE("cylinder", "an open tube or a part of one")
