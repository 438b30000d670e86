// SPDX-License-Identifier: BSD-2-Clause
// Texture mappings map a surface to the plane or space of a texture, with the pixel footprint
// there. Derivatives are analytic. They are 0 if the footprint is unknown.
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
    Real uScale = 1, vScale = 1;       // for uv
    Real uDelta = 0, vDelta = 0;       // for uv and planar
    Vector3 v1{1, 0, 0}, v2{0, 1, 0};  // for planar: s = uDelta + p.v1, in world space
  };

  TextureMapping2D(const Options& options, const Transform& textureToWorld);

  // Returns the texture coordinates.
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

// TextureMapping3D maps world space to texture space.
class TextureMapping3D {
 public:
  explicit TextureMapping3D(const Transform& textureToWorld)
      : worldToTexture_(textureToWorld.Inverted()) {}

  TexturePoint3 Map(const SurfaceInteraction& si) const;

 private:
  Transform worldToTexture_;
};

}  // namespace exphoton
