// SPDX-License-Identifier: BSD-2-Clause
// The shape "disk" is a flat disk or ring perpendicular to z, swept by phimax degrees. u follows
// the azimuth, v runs from the rim (0) to the inner edge (1). The normal is the same everywhere,
// also at the centre. Because the shape is flat, area sampling is uniform under any transformation.
#include "core/math/half_space.h"
#include "core/plugin.h"
#include "shapes/quadric/quadric.h"

namespace exphoton {
namespace {

struct Settings {
  Real height = 0;
  Real radius = 1;
  Real innerRadius = 0;
  Real phiMaxDegrees = 360;

  void Validate() const {
    if (innerRadius >= radius) throw ParamError{"innerradius", "must be below 'radius'", ""};
  }
};

const ParamTable<Settings>& Parameters() {
  static const ParamTable<Settings> table{
      Param("height", &Settings::height, "position along z").Unit("scene units"),
      Param("radius", &Settings::radius, "outer radius").Above(0).Unit("scene units"),
      Param("innerradius", &Settings::innerRadius, "radius of the hole")
          .AtLeast(0)
          .Unit("scene units"),
      Param("phimax", &Settings::phiMaxDegrees, "angle swept about z")
          .Above(0)
          .AtMost(360)
          .Unit("degrees")};
  return table;
}

class Disk final : public QuadricShape {
 public:
  Disk(const Settings& settings, const ShapeContext& context)
      : QuadricShape(context),
        height_(double(settings.height)),
        radius_(double(settings.radius)),
        innerRadius_(double(settings.innerRadius)),
        phiMax_(double(settings.phiMaxDegrees) * (3.14159265358979323846 / 180)),
        isRound_(settings.phiMaxDegrees == 360) {
    const auto& m = objectToWorld_.Matrix().m;
    const Vec3d x(m[0][0], m[1][0], m[2][0]), y(m[0][1], m[1][1], m[2][1]);
    area_ = Real(phiMax_ / 2 * (radius_ - innerRadius_) * (radius_ + innerRadius_) *
                 Length(Cross(x, y)));
  }

  Real Area() const override { return area_; }
  Bounds3 Bounds() const override {
    const Real r = Real(radius_), h = Real(height_);
    return objectToWorld_.ApplyBounds({{-r, -r, h}, {r, r, h}});
  }

  EmitterSample SamplePoint(Point2 u, Real, Real) const override {
    const double inner2 = innerRadius_ * innerRadius_, outer2 = radius_ * radius_;
    const double r = std::sqrt(inner2 + double(u.x) * (outer2 - inner2));
    const double phi = double(u.y) * phiMax_;
    return MakeSample(Describe({r * std::cos(phi), r * std::sin(phi), height_}), 1 / area_);
  }

  // The square round the disk is tested instead of the disk.
  bool MayFace(const Bounds3& box) const override {
    const auto corner = [this](double x, double y) {
      return PointToWorld({x * radius_, y * radius_, height_}, {0, 0, 1});
    };
    return !LiesBehind(box, corner(1, 1).ng,
                       {corner(1, 1).p, corner(1, -1).p, corner(-1, 1).p, corner(-1, -1).p});
  }

 protected:
  QuadricRoots Roots(const ObjectRay& ray) const override {
    if (ray.d.z == 0) return {};
    const double t = (height_ - ray.o.z) / ray.d.z;
    if (!std::isfinite(t)) return {};
    return {1, {t, 0}};
  }
  bool Has(const Vec3d& p) const override {
    const double r = std::hypot(p.x, p.y);
    return r <= radius_ && r >= innerRadius_ && (isRound_ || AzimuthOf(p.x, p.y) <= phiMax_);
  }
  QuadricPoint Describe(const Vec3d& p) const override {
    QuadricPoint point;
    point.p = {p.x, p.y, height_};
    point.n = {0, 0, 1};
    const double r = std::hypot(p.x, p.y), width = radius_ - innerRadius_;
    point.uv = {Real(std::min(AzimuthOf(p.x, p.y) / phiMax_, 1.0)), Real((radius_ - r) / width)};
    point.dpdu = Vec3d(-p.y, p.x, 0) * phiMax_;
    point.dpdv = r > 0 ? Vec3d(p.x, p.y, 0) * (-width / r) : Vec3d(-width, 0, 0);
    return point;
  }

 private:
  double height_, radius_, innerRadius_, phiMax_;
  bool isRound_;
  Real area_;
};

std::unique_ptr<ShapeGeometry> Create(const Settings& settings, const ShapeContext& context) {
  return std::make_unique<ShapeGeometry>(std::make_unique<Disk>(settings, context));
}

}  // namespace
}  // namespace exphoton

EXPHOTON_SHAPE("disk", "a flat disk, ring or sector of one")
