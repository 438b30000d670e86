// SPDX-License-Identifier: BSD-2-Clause
// RevolvedQuadric solves a quadratic about the point of the ray that is nearest to the shape, so
// that rays from far away lose no digits.
#include "shapes/quadric/revolved_quadric.h"

#include <algorithm>
#include <array>

namespace exphoton {
namespace {

constexpr double kTwoPi = 6.283185307179586;

// The abscissae and weights of Gauss-Legendre quadrature with five points on [-1, 1].
struct GaussPoint {
  double x, weight;
};
const std::array<GaussPoint, 5>& GaussPoints() {
  static const std::array<GaussPoint, 5> points = [] {
    const double root = 2 * std::sqrt(10. / 7);
    const double inner = std::sqrt(5 - root) / 3, outer = std::sqrt(5 + root) / 3;
    const double innerWeight = (322 + 13 * std::sqrt(70.)) / 900;
    const double outerWeight = (322 - 13 * std::sqrt(70.)) / 900;
    return std::array<GaussPoint, 5>{{{-outer, outerWeight},
                                      {-inner, innerWeight},
                                      {0, 128. / 225},
                                      {inner, innerWeight},
                                      {outer, outerWeight}}};
  }();
  return points;
}

}  // namespace

Meridian Meridian::Line(const Vec3d& start, const Vec3d& end) {
  Meridian line;
  line.z0 = start.z;
  line.dz = end.z - start.z;
  line.isStraight = true;
  line.x0 = start.x, line.dx = end.x - start.x;
  line.y0 = start.y, line.dy = end.y - start.y;
  line.a = line.x0 * line.x0 + line.y0 * line.y0;
  line.b = line.x0 * line.dx + line.y0 * line.dy;
  line.c = line.dx * line.dx + line.dy * line.dy;
  return line;
}

double Meridian::Azimuth(double v) const {
  return isStraight ? std::atan2(y0 + v * dy, x0 + v * dx) : 0;
}

MeridianArea::MeridianArea(const Meridian& meridian) : meridian_(meridian) {
  constexpr int kSteps = 32;
  // Where the meridian meets the axis, the integrand has a kink. It needs a node there.
  const double closest = meridian.c > 0 ? -meridian.b / meridian.c : 0;
  std::vector<double> ends{0, 1};
  if (closest > 0 && closest < 1) ends = {0, closest, 1};
  nodes_.push_back({0, 0});
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    for (int k = 1; k <= kSteps; ++k) {
      const double v =
          k == kSteps ? ends[i + 1] : ends[i] + (ends[i + 1] - ends[i]) * k / double(kSteps);
      nodes_.push_back({v, nodes_.back().area + Integrate(nodes_.back().v, v)});
    }
  }
}

double MeridianArea::Integrate(double from, double to) const {
  const double middle = (from + to) / 2, half = (to - from) / 2;
  double sum = 0;
  for (const GaussPoint& point : GaussPoints())
    sum += point.weight * meridian_.AreaElement(middle + half * point.x);
  return sum * half;
}

double MeridianArea::Invert(double u) const {
  const double target = u * Total();
  const auto above = std::upper_bound(nodes_.begin() + 1, nodes_.end() - 1, target,
                                      [](double value, const Node& n) { return value < n.area; });
  const Node& below = *(above - 1);
  double low = below.v, high = above->v;
  const double width = high - low, inside = above->area - below.area;
  double v = inside > 0 ? low + width * std::clamp((target - below.area) / inside, 0., 1.) : low;
  // Newton's method, with bisection where a step would leave the bracket.
  for (int i = 0; i < 64; ++i) {
    const double excess = below.area + Integrate(below.v, v) - target;
    (excess > 0 ? high : low) = v;
    const double slope = meridian_.AreaElement(v);
    double next = slope > 0 ? v - excess / slope : low;
    if (!(next >= low && next <= high)) next = (low + high) / 2;
    if (std::abs(next - v) <= 1e-14) return next;
    v = next;
  }
  return v;
}

RevolvedQuadric::RevolvedQuadric(const Meridian& meridian, Real phiMaxDegrees,
                                 const ShapeContext& context)
    : QuadricShape(context),
      meridian_(meridian),
      phiMax_(double(phiMaxDegrees) * (kTwoPi / 360)),
      isRound_(phiMaxDegrees == 360),
      distribution_(meridian),
      area_(Real(phiMax_ * distribution_.Total() * AreaScale().value_or(0))) {
  if (!AreaScale()) {
    uneven_ = std::make_unique<PlacedEmitter>(
        std::make_unique<RevolvedQuadric>(meridian, phiMaxDegrees, InOwnSpace(context)),
        objectToWorld_);
  }
}

Bounds3 RevolvedQuadric::Bounds() const {
  // Radius2 is convex or linear, so its largest value is at an end.
  const Real r = NextUp(Real(std::sqrt(std::max(meridian_.Radius2(0), meridian_.Radius2(1)))));
  const double start = meridian_.Z(0), end = meridian_.Z(1);
  return objectToWorld_.ApplyBounds(
      {{-r, -r, NextDown(Real(std::min(start, end)))}, {r, r, NextUp(Real(std::max(start, end)))}});
}

EmitterSample RevolvedQuadric::SamplePoint(Point2 u, Real uSubLight, Real time) const {
  if (uneven_) return uneven_->SamplePoint(u, uSubLight, time);
  const double v = distribution_.Invert(double(u.x));
  const double azimuth = double(u.y) * phiMax_ + meridian_.Azimuth(v);
  const double r = std::sqrt(meridian_.Radius2(v));
  return MakeSample(Describe({r * std::cos(azimuth), r * std::sin(azimuth), meridian_.Z(v)}),
                    1 / area_);
}

std::optional<EmitterSample> RevolvedQuadric::SampleToward(const SurfacePoint& ref, Point2 u,
                                                           Real uSubLight) const {
  if (uneven_) return uneven_->SampleToward(ref, u, uSubLight);
  return EmitterSurface::SampleToward(ref, u, uSubLight);
}

Real RevolvedQuadric::PdfToward(const SurfacePoint& ref, const Vector3& wi,
                                const SurfacePoint& on) const {
  if (uneven_) return uneven_->PdfToward(ref, wi, on);
  return EmitterSurface::PdfToward(ref, wi, on);
}

QuadricRoots RevolvedQuadric::Roots(const ObjectRay& ray) const {
  const Vec3d d = ray.d, center(0, 0, meridian_.Z(.5));
  const double nearest = Dot(center - ray.o, d) / Dot(d, d);
  if (!std::isfinite(nearest)) return {};
  const Vec3d o = ray.At(nearest);
  // x^2 + y^2 - Radius2(v) along the ray is a t^2 + 2 b t + c.
  const double v = (o.z - meridian_.z0) / meridian_.dz, dv = d.z / meridian_.dz;
  const double slope = meridian_.HalfSlope(v);
  const double a = d.x * d.x + d.y * d.y - meridian_.c * dv * dv;
  const double b = o.x * d.x + o.y * d.y - slope * dv;
  const double c = o.x * o.x + o.y * o.y - (meridian_.a + v * (2 * meridian_.b + v * meridian_.c));
  const double discriminant = b * b - a * c;
  if (!(discriminant >= 0)) return {};
  const double q = -(b + std::copysign(std::sqrt(discriminant), b));
  QuadricRoots roots;
  const auto add = [&](double t) {
    if (std::isfinite(t)) roots.t[roots.count++] = nearest + t;
  };
  add(c / q);
  add(q / a);
  if (roots.count == 2 && roots.t[1] < roots.t[0]) std::swap(roots.t[0], roots.t[1]);
  return roots;
}

double RevolvedQuadric::AngleSwept(double x, double y, double v) const {
  const double angle = AzimuthOf(x, y) - meridian_.Azimuth(v);
  if (angle < 0) return std::min(angle + kTwoPi, kTwoPi);
  return angle > kTwoPi ? angle - kTwoPi : angle;
}

bool RevolvedQuadric::Has(const Vec3d& p) const {
  const double v = (p.z - meridian_.z0) / meridian_.dz;
  return v >= 0 && v <= 1 && (isRound_ || AngleSwept(p.x, p.y, v) <= phiMax_);
}

Vec3d RevolvedQuadric::AlongMeridian(const Vec3d& p, double angle, double v) const {
  if (meridian_.isStraight) {
    const double sin = std::sin(angle), cos = std::cos(angle);
    return {meridian_.dx * cos - meridian_.dy * sin, meridian_.dx * sin + meridian_.dy * cos,
            meridian_.dz};
  }
  const double radius2 = meridian_.Radius2(v);
  if (!(radius2 > 0)) return {0, 0, meridian_.dz};
  const double growth = meridian_.HalfSlope(v) / radius2;
  return {p.x * growth, p.y * growth, meridian_.dz};
}

QuadricPoint RevolvedQuadric::Describe(const Vec3d& p) const {
  // Move p to the surface by one Newton step along the gradient of rho^2 - Radius2, in the half
  // plane of rho and z. p is so near that one step suffices.
  double rho = std::hypot(p.x, p.y), v = (p.z - meridian_.z0) / meridian_.dz;
  const double cosPhi = rho > 0 ? p.x / rho : 1, sinPhi = rho > 0 ? p.y / rho : 0;
  const double gradientZ = -2 * meridian_.HalfSlope(v) / meridian_.dz;
  const double gradient2 = 4 * rho * rho + gradientZ * gradientZ;
  if (gradient2 > 0) v -= (rho * rho - meridian_.Radius2(v)) / gradient2 * gradientZ / meridian_.dz;
  v = std::clamp(v, 0., 1.);
  rho = std::sqrt(meridian_.Radius2(v));

  QuadricPoint point;
  point.p = {rho * cosPhi, rho * sinPhi, meridian_.Z(v)};
  const double angle = AngleSwept(point.p.x, point.p.y, v), slope = meridian_.HalfSlope(v);
  point.uv = {Real(std::min(angle / phiMax_, 1.0)), Real(v)};
  const Vec3d turn(-point.p.y, point.p.x, 0), along = AlongMeridian(point.p, angle, v);
  point.dpdu = turn * phiMax_;
  point.dpdv = along;
  // The cross product of dp/dphi and dp/dv, and its derivatives.
  const double dz = meridian_.dz;
  const Vec3d across(point.p.x * dz, point.p.y * dz, -slope);
  const double length = Length(across);
  if (!(length > 0)) {  // the tip of a cone
    point.n = {0, 0, meridian_.HalfSlope(.5) > 0 ? -1. : 1.};
    return point;
  }
  point.n = across * (1 / length);
  const auto derivative = [&](const Vec3d& change) {
    return (change - point.n * Dot(point.n, change)) * (1 / length);
  };
  point.dndu = derivative(turn * (phiMax_ * dz));
  point.dndv = derivative({along.x * dz, along.y * dz, -meridian_.c});
  return point;
}

}  // namespace exphoton
