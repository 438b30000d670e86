// SPDX-License-Identifier: BSD-2-Clause
// Texture mappings compute texture coordinates and their derivatives along the pixel's steps.
#include "core/scattering/texture_mapping.h"

#include "core/math/sampling/sampling.h"

namespace exphoton {
namespace {

Point2 FiniteOrZero(Point2 d) {
  return std::isfinite(d.x) && std::isfinite(d.y) ? d : Point2(0, 0);
}

// Returns the change of the azimuth, in turns, of a unit vector that changes by `change`. It is
// half a turn on the axis, where all azimuths meet.
Real TurnsOf(const Vector3& unit, const Vector3& change) {
  const Real cross = unit.x * change.y - unit.y * change.x;
  if (cross == 0) return 0;
  const Real turns = kInv2Pi * SafeDivide(cross, unit.x * unit.x + unit.y * unit.y, Real(.5));
  return std::clamp(turns, Real(-.5), Real(.5));
}

}  // namespace

TextureMapping2D::TextureMapping2D(const Options& options, const Transform& textureToWorld)
    : options_(options), worldToTexture_(textureToWorld.Inverted()) {}

TexturePoint2 TextureMapping2D::Map(const SurfaceInteraction& si) const {
  const Options& o = options_;
  switch (o.kind) {
    case Kind::Uv:
      return {{o.uScale * si.uv.x + o.uDelta, o.vScale * si.uv.y + o.vDelta},
              FiniteOrZero({o.uScale * si.dudx, o.vScale * si.dvdx}),
              FiniteOrZero({o.uScale * si.dudy, o.vScale * si.dvdy})};
    case Kind::Planar:
      return {{o.uDelta + Dot(si.p, o.v1), o.vDelta + Dot(si.p, o.v2)},
              FiniteOrZero({Dot(si.dpdx, o.v1), Dot(si.dpdx, o.v2)}),
              FiniteOrZero({Dot(si.dpdy, o.v1), Dot(si.dpdy, o.v2)})};
    case Kind::Spherical:
    case Kind::Cylindrical:
      break;
  }
  return Curved(si);
}

TexturePoint2 TextureMapping2D::Curved(const SurfaceInteraction& si) const {
  const Vector3 p = worldToTexture_.ApplyPoint(si.p);
  const Vector3 unit = NormalizeOr(p, Vector3(0, 0, 1));
  const Real radius = Dot(p, unit);
  TexturePoint2 point;
  const bool isSpherical = options_.kind == Kind::Spherical;
  if (isSpherical) {
    point.st = {SphericalTheta(unit) * kInvPi, SphericalPhi(unit) * kInv2Pi};
  } else {
    point.st = {(kPi + std::atan2(unit.y, unit.x)) * kInv2Pi, unit.z};
  }
  if (!si.hasDifferentials || !(radius > 0)) return point;
  const auto change = [&](const Vector3& dp) {
    const Vector3 d = worldToTexture_.ApplyVector(dp) / radius;
    const Vector3 across = d - unit * Dot(unit, d);  // change of the unit vector
    return FiniteOrZero(isSpherical ? Spherical(unit, across) : Cylindrical(unit, across));
  };
  point.dstdx = change(si.dpdx);
  point.dstdy = change(si.dpdy);
  return point;
}

// theta = acos z, so d theta = -dz / sin theta. At a pole, d theta is the whole length of the
// change.
Point2 TextureMapping2D::Spherical(const Vector3& unit, const Vector3& change) const {
  const Real sinTheta = std::sqrt(unit.x * unit.x + unit.y * unit.y);
  const Real dTheta = SafeDivide(-change.z, sinTheta, Length(change));
  return {dTheta * kInvPi, TurnsOf(unit, change)};
}

Point2 TextureMapping2D::Cylindrical(const Vector3& unit, const Vector3& change) const {
  return {TurnsOf(unit, change), change.z};
}

TexturePoint3 TextureMapping3D::Map(const SurfaceInteraction& si) const {
  TexturePoint3 point;
  point.p = worldToTexture_.ApplyPoint(si.p);
  if (si.hasDifferentials) {
    point.dpdx = worldToTexture_.ApplyVector(si.dpdx);
    point.dpdy = worldToTexture_.ApplyVector(si.dpdy);
  }
  return point;
}

}  // namespace exphoton
