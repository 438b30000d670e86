// SPDX-License-Identifier: BSD-2-Clause
// DistantLightTargeting: where photons of far lights (the sun, the sky) should land. They start on
// a disk that covers the scene, so in a wide landscape next to none would land near the house that
// is looked at. Given points where photons are wanted, the aim is a hierarchy of balls: level by
// level the points are halved, and a level's balls hold them all. A photon picks a level, every
// level alike, a ball of it in proportion to the points in it, and a place on the shadow that the
// ball throws. Places of the disk (radius R, about the world's shadow) then have density, per area,
//   p(x) = q [1 / (pi R^2) + sum over balls i of share_i 2 (1 - d_i^2 / r_i^2)+ / (pi r_i^2)],
// d_i the distance to the shadow's middle, and a photon's power is multiplied by 1 / (pi R^2 p).
// Nothing is lost, as p is at least the first term: defensive mixture sampling, Veach 1997, section
// 9.2.4; photons where the camera looks: Peter and Pietrek 1998. From level to level the density
// falls off about as 1 / distance^2, so that light that bounces in from outside comes in photons
// whose power is not too great; within a shadow it is smooth, and no ball is so small that a
// density estimate would see it change.
#pragma once

#include <span>
#include <vector>

#include "core/lights/light.h"
#include "core/math/sampling/distribution.h"

namespace exphoton {

class DistantLightTargeting {
 public:
  DistantLightTargeting() = default;  // no aim
  // World: the ball that the lights were prepared with. No ball but the last of a level's chain
  // holds less than leastShare of the points, in (0,1]. Too few points give no aim.
  DistantLightTargeting(std::vector<Point3> wanted, const Sphere3& world, double leastShare);

  bool IsEmpty() const { return shares_.IsEmpty(); }

  // Moves the start of a far light's photon (Light::IsFar) and weighs its power accordingly; u is
  // used up.
  void Redirect(LightLeSample* emission, Point2 u) const;

  // How much denser than without aim photons start towards a wanted point: the median.
  double Gain() const { return gain_; }

 private:
  struct Ball {
    Vector3 center;  // from the world's
    Real radius;
    double share;  // of all photons

    double Density(Real distance2) const;
  };
  void AddLevels(std::span<Point3> wanted, double leastShare);  // reorders the points
  double WorldDensity() const;
  // At `offset` from the world's centre on the plane of the frame's x and y.
  double Density(const Vector3& offset, const Frame& frame) const;
  double Gain(std::span<const Point3> wanted) const;

  Sphere3 world_;
  std::vector<Ball> balls_;      // without the world's
  DiscreteDistribution shares_;  // of the world and then the balls
  double gain_ = 1;
};

}  // namespace exphoton
