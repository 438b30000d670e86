// SPDX-License-Identifier: BSD-2-Clause
// DistantLightTargeting implements emission importance sampling for distant lights (the sun, the
// sky): more photons start towards points that matter for the image. Uniform starts on the disk
// that covers the scene would send almost no photons to a house in a wide landscape. Sources: Veach
// 1997, section 9.2.4 (defensive mixture sampling); Peter and Pietrek 1998.
#pragma once

#include <span>
#include <vector>

#include "core/lights/light.h"
#include "core/math/sampling/distribution.h"

namespace exphoton {

// The wanted points are covered by a hierarchy of bounding spheres; from level to level a set of
// points is halved. If its sphere is much smaller than the parent sphere, spheres that shrink by a
// factor of 4 come first. A photon first picks the world sphere with weight 1, or sphere i with
// weight share_i, its share of the wanted points. The photon then picks a position on the disk of
// that sphere, projected along the light's direction. Let q be 1 / (sum of all weights), R the
// radius of the world sphere, r_i the radius of disk i and d_i the distance from x to its centre.
// With (y)+ for the larger of y and 0, the density of photon starts per area is
//   p(x) = q [1 / (pi R^2) + sum over spheres i of share_i 2 (1 - d_i^2 / r_i^2)+ / (pi r_i^2)].
// The power of a photon is multiplied by 1 / (pi R^2 p). No light is lost, because p is at least
// the first term. The enclosing spheres make p fall off roughly as 1 / distance^2 outside the
// wanted region, which limits the power of photons that bounce in from outside. Within a disk p is
// smooth, and minShare keeps the disks so large that p hardly varies within one density estimate.
class DistantLightTargeting {
 public:
  DistantLightTargeting() = default;  // empty: no targeting
  // `world` is the bounding sphere that the lights were prepared with. No sphere holds less than
  // minShare, in (0,1], of the points, up to rounding. With fewer than 16 points the object is
  // empty.
  DistantLightTargeting(std::vector<Point3> wanted, const Sphere3& world, double minShare);

  bool IsEmpty() const { return shares_.IsEmpty(); }

  // Moves the start of a photon of a distant light (Light::IsDistant) to a position chosen by u,
  // and updates its power and density.
  void Redirect(LightLeSample* emission, Point2 u) const;

  // Returns the median, over the wanted points, of the density of photon starts divided by the
  // uniform density.
  double Gain() const { return gain_; }

 private:
  struct TargetSphere {
    Vector3 center;  // relative to the world's centre
    Real radius;
    double share;  // of all photons

    double Density(Real distance2) const;
  };
  void AddLevels(std::span<Point3> wanted, double minShare);  // reorders the points
  double WorldDensity() const;
  // Density per area at `offset` from the world's centre, in the plane of frame.x and frame.y.
  double Density(const Vector3& offset, const Frame& frame) const;
  double Gain(std::span<const Point3> wanted) const;

  Sphere3 world_;
  std::vector<TargetSphere> spheres_;  // without the world sphere
  DiscreteDistribution shares_;        // of the world sphere, then of spheres_
  double gain_ = 1;
};

}  // namespace exphoton
