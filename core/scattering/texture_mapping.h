// SPDX-License-Identifier: BSD-2-Clause
// Mappings from a surface to the plane or space a texture is drawn in, with the pixel's footprint
// there. Derivatives are analytic and 0 where the footprint is unknown.
#pragma once

#include "core/geometry/interaction.h"
#include "core/math/transform.h"

namespace exphoton {

struct TexturePoint2 {
  Point2 st;
  Point2 dstdx, dstdy;  // per step of one pixel
};
struct TexturePoint3 {
  Point3 p;
  Vector3 dpdx, dpdy;  // per step of one pixel
};

class TextureMapping2D {
 public:
  enum class Kind { Uv, Spherical, Cylindrical, Planar };
  struct Options {
    Kind kind = Kind::Uv;
    Real uScale = 1, vScale = 1;       // of uv
    Real uDelta = 0, vDelta = 0;       // of uv and planar
    Vector3 v1{1, 0, 0}, v2{0, 1, 0};  // of planar: s = uDelta + p.v1, in world space
  };

  TextureMapping2D(const Options& options, const Transform& textureToWorld);

  // uv: (us u + ud, vs v + vd). spherical: (theta/pi, phi/2pi) about texture space's z axis.
  // cylindrical: ((pi + atan2(y,x))/2pi, z of the unit vector to the point).
  TexturePoint2 Map(const SurfaceInteraction& si) const;

 private:
  Point2 Spherical(const Vector3& unit, const Vector3& change) const;
  Point2 Cylindrical(const Vector3& unit, const Vector3& change) const;
  TexturePoint2 Curved(const SurfaceInteraction& si) const;

  Options options_;
  Transform worldToTexture_;
};

// World to texture space.
class TextureMapping3D {
 public:
  explicit TextureMapping3D(const Transform& textureToWorld)
      : worldToTexture_(textureToWorld.Inverted()) {}

  TexturePoint3 Map(const SurfaceInteraction& si) const;

 private:
  Transform worldToTexture_;
};

}  // namespace exphoton
