// SPDX-License-Identifier: BSD-2-Clause
// The shape "sphere" is the part of a sphere about the origin between the planes z = zmin and
// z = zmax, swept by phimax degrees about z. u follows the azimuth, v runs from zmin to zmax. As a
// light, a whole sphere is sampled by the cone that it subtends, a partial one by area. An
// ellipsoid (non-uniform scale) is sampled in object space, where it is a sphere.
#include "core/geometry/placed_emitter.h"
#include "core/math/sampling/sampling.h"
#include "core/plugin.h"
#include "shapes/quadric/quadric.h"

namespace exphoton {
namespace {

struct Settings {
  Real radius = 1;
  std::optional<Real> zMin, zMax;
  Real phiMaxDegrees = 360;

  Real Low() const { return std::clamp(zMin.value_or(-radius), -radius, radius); }
  Real High() const { return std::clamp(zMax.value_or(radius), -radius, radius); }
  void Validate() const {
    if (Low() == High()) {
      throw ParamError{zMin ? "zmin" : "zmax", "nothing of the sphere is between 'zmin' and 'zmax'",
                       ""};
    }
  }
};

const ParamTable<Settings>& Parameters() {
  static const ParamTable<Settings> table{
      Param("radius", &Settings::radius, "radius").Above(0).Unit("scene units"),
      Param("zmin", &Settings::zMin, "lower end; -radius if absent").Unit("scene units"),
      Param("zmax", &Settings::zMax, "upper end; radius if absent").Unit("scene units"),
      Param("phimax", &Settings::phiMaxDegrees, "angle swept about z")
          .Above(0)
          .AtMost(360)
          .Unit("degrees")};
  return table;
}

class Sphere final : public QuadricShape {
 public:
  Sphere(const Settings& settings, const ShapeContext& context)
      : QuadricShape(context),
        radius_(double(settings.radius)),
        zMin_(double(std::min(settings.Low(), settings.High()))),
        zMax_(double(std::max(settings.Low(), settings.High()))),
        phiMax_(double(settings.phiMaxDegrees) * (3.14159265358979323846 / 180)),
        thetaMin_(std::acos(std::clamp(zMin_ / radius_, -1.0, 1.0))),
        thetaMax_(std::acos(std::clamp(zMax_ / radius_, -1.0, 1.0))),
        isWhole_(zMin_ == -radius_ && zMax_ == radius_ && settings.phiMaxDegrees == 360) {
    const double scale2 = AreaScale().value_or(0);
    area_ = Real(phiMax_ * radius_ * (zMax_ - zMin_) * scale2);
    worldRadius_ = radius_ * std::sqrt(scale2);
    const auto& m = objectToWorld_.Matrix().m;
    worldCenter_ = {m[0][3], m[1][3], m[2][3]};
    if (!AreaScale()) {
      uneven_ = std::make_unique<PlacedEmitter>(
          std::make_unique<Sphere>(settings, InOwnSpace(context)), objectToWorld_);
    }
  }

  Real Area() const override { return uneven_ ? uneven_->Area() : area_; }

  Bounds3 Bounds() const override {
    if (!isWhole_) {
      const Real r = Real(radius_);
      return objectToWorld_.ApplyBounds({{-r, -r, Real(zMin_)}, {r, r, Real(zMax_)}});
    }
    // The ellipsoid's extent along an axis is the radius times the length of the matrix row.
    Bounds3 bounds;
    const auto& m = objectToWorld_.Matrix().m;
    for (int i = 0; i < 3; ++i) {
      const auto& row = m[std::size_t(i)];
      const double half = radius_ * std::hypot(row[0], row[1], row[2]);
      bounds.min[i] = NextDown(Real(row[3] - half));
      bounds.max[i] = NextUp(Real(row[3] + half));
    }
    return bounds;
  }

  bool IsSampledUniformly() const override { return !uneven_; }
  EmitterSample SamplePoint(Point2 u, Real uSubLight, Real time) const override {
    if (uneven_) return uneven_->SamplePoint(u, uSubLight, time);
    const double z = zMin_ + double(u.x) * (zMax_ - zMin_), phi = double(u.y) * phiMax_;
    const double r = std::sqrt(std::max((radius_ - z) * (radius_ + z), 0.0));
    return MakeSample(Describe({r * std::cos(phi), r * std::sin(phi), z}), 1 / area_);
  }

  std::optional<EmitterSample> SampleToward(const SurfacePoint& ref, Point2 u,
                                            Real uSubLight) const override {
    if (uneven_) return uneven_->SampleToward(ref, u, uSubLight);
    const View view = ViewFrom(ref);
    if (view.where == View::Near) return EmitterSurface::SampleToward(ref, u, uSubLight);
    const Frame frame = Frame::FromZ(view.axis.ToReal());
    Vec3d w;
    double alongRay;
    Real pdf;
    if (view.where == View::Inside) {
      // Every direction hits the sphere once.
      w = NormalizeOrZero(Vec3d(SampleUniformSphere(u)));
      const double b = Dot(w, view.axis) * view.distance;
      alongRay = b + std::sqrt(std::max(b * b - view.power, 0.0));
      pdf = kUniformSpherePdf;
    } else {
      const double t = double(u.x) * view.oneMinusCos, phi = 6.283185307179586 * double(u.y);
      const double sin = std::sqrt(std::max(t * (2 - t), 0.0));
      w = Vec3d(frame.x) * (sin * std::cos(phi)) + Vec3d(frame.y) * (sin * std::sin(phi)) +
          view.axis * (1 - t);
      const double across = view.distance * sin;
      alongRay = view.distance * (1 - t) -
                 std::sqrt(std::max((worldRadius_ - across) * (worldRadius_ + across), 0.0));
      pdf = UniformConePdf(Real(view.oneMinusCos));
    }
    if (!(pdf > 0) || !std::isfinite(pdf)) return std::nullopt;
    const Vec3d p = Vec3d(ref.p) + w * alongRay;
    return MakeSample(Describe(PointToObject(p)), pdf);
  }

  Real PdfToward(const SurfacePoint& ref, const Vector3& wi,
                 const SurfacePoint& on) const override {
    if (uneven_) return uneven_->PdfToward(ref, wi, on);
    const View view = ViewFrom(ref);
    switch (view.where) {
      case View::Inside:
        return kUniformSpherePdf;
      case View::Outside:
        return UniformConePdf(Real(view.oneMinusCos));
      case View::Near:
        break;
    }
    return EmitterSurface::PdfToward(ref, wi, on);
  }

 protected:
  QuadricRoots Roots(const ObjectRay& ray) const override {
    return IntersectRound(ray.o, ray.d, radius_);
  }
  bool Has(const Vec3d& p) const override {
    if (isWhole_) return true;
    const double z = p.z * (radius_ / Length(p));
    return z >= zMin_ && z <= zMax_ && AzimuthOf(p.x, p.y) <= phiMax_;
  }
  QuadricPoint Describe(const Vec3d& p) const override {
    QuadricPoint point;
    point.n = NormalizeOrZero(p);
    if (Dot(point.n, point.n) == 0) point.n = {0, 0, 1};
    const Vec3d q = point.n * radius_;
    point.p = q;
    const double phi = AzimuthOf(q.x, q.y), rho = std::hypot(q.x, q.y);
    const double theta = std::atan2(rho, q.z), span = thetaMax_ - thetaMin_;
    point.uv = {Real(std::min(phi / phiMax_, 1.0)), Real((theta - thetaMin_) / span)};
    point.dpdu = Vec3d(-q.y, q.x, 0) * phiMax_;
    const double cosPhi = rho > 0 ? q.x / rho : 1, sinPhi = rho > 0 ? q.y / rho : 0;
    point.dpdv = Vec3d(q.z * cosPhi, q.z * sinPhi, -rho) * span;
    point.dndu = point.dpdu * (1 / radius_);
    point.dndv = point.dpdv * (1 / radius_);
    return point;
  }

 private:
  // View describes the sphere as seen from a point. Near: the point is on the surface or very
  // close, or the shape is only part of a sphere.
  struct View {
    enum Where { Inside, Near, Outside } where = Near;
    Vec3d axis;              // unit, towards the centre
    double distance = 0;     // to the centre
    double power = 0;        // distance^2 - radius^2
    double oneMinusCos = 0;  // Outside: of the half-angle of the cone that it subtends
  };
  View ViewFrom(const SurfacePoint& ref) const {
    View view;
    if (!isWhole_) return view;
    const Vec3d toCenter = worldCenter_ - Vec3d(ref.p);
    view.distance = Length(toCenter);
    view.power = (view.distance - worldRadius_) * (view.distance + worldRadius_);
    const double relative = view.power / (worldRadius_ * worldRadius_);
    if (relative > 1e-6) {
      view.where = View::Outside;
      const double ratio = worldRadius_ / view.distance;
      const double sin2 = ratio * ratio;
      view.oneMinusCos = sin2 / (1 + std::sqrt(std::max(1 - sin2, 0.0)));
    } else if (relative < -1e-3) {
      view.where = View::Inside;
    }
    view.axis = NormalizeOrZero(toCenter);
    if (Dot(view.axis, view.axis) == 0) view.axis = {0, 0, 1};
    return view;
  }

  double radius_, zMin_, zMax_, phiMax_, thetaMin_, thetaMax_;
  bool isWhole_;
  Real area_;
  double worldRadius_;
  Vec3d worldCenter_;
  std::unique_ptr<const PlacedEmitter> uneven_;  // set if the axes are scaled differently
};

std::unique_ptr<ShapeGeometry> Create(const Settings& settings, const ShapeContext& context) {
  return std::make_unique<ShapeGeometry>(std::make_unique<Sphere>(settings, context));
}

}  // namespace
}  // namespace exphoton

EXPHOTON_SHAPE("sphere", "a sphere or a part of one")
