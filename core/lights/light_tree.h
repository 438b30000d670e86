// SPDX-License-Identifier: BSD-2-Clause
// LightTree: chooses one of many lights for a point, near and bright ones more often, in time
// proportional to the logarithm of their number. A balanced tree over the lights that are
// somewhere; going down, a child is taken in proportion to what could arrive from it,
//   power / (4 pi max(d^2, r^2)),
// d the distance to the middle of its box, r half its diagonal: Conty Estevez and Kulla 2018,
// "Importance Sampling of Many Lights with Adaptive Tree Splitting", without orientations and
// without splitting. Far lights (sun, sky) form a group of their own, chosen by irradiance. A share
// of every decision between the groups, and of every light's power, is uniform, so that no light
// is ever starved.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "core/lights/light.h"
#include "core/math/sampling/distribution.h"

namespace exphoton {

class LightTree {
 public:
  LightTree() = default;
  // Black lights are never chosen. World: the ball that the lights were prepared with.
  LightTree(const std::vector<std::unique_ptr<Light>>& lights, const Sphere3& world);

  bool IsEmpty() const { return lights_.empty(); }  // every light is black

  struct Choice {
    const Light* light;
    int index;         // into the vector given
    Real probability;  // > 0
  };
  Choice Sample(const Point3& p, Real u) const;
  // With which Sample chooses that light at p; 0 for a black one.
  Real Probability(const Point3& p, int index) const;

 private:
  struct Node {
    Point3 center;
    Real radius2 = 0;  // of the ball round the box
    double power = 0;  // luminance
    int right = -1;    // the other child; the left one follows its parent. -1: a leaf
    int light = -1;    // of a leaf
  };
  struct Leaf {
    Point3 center;
    Bounds3 bounds;
    double power;
    int light;
  };
  // Where a light is to be found: the turns on the way down, least significant first.
  struct Place {
    std::uint64_t turns = 0;
    int depth = -1;  // -1: not in the tree
    int far = -1;    // in the distribution of far lights; -1: not among them
  };

  int Build(std::span<Leaf> leaves, Place place);
  static double Distance2(const Node& node, const Point3& p);
  double LeftProbability(int node, const Point3& p) const;
  double FarProbability(const Point3& p) const;

  std::vector<const Light*> lights_;  // those given
  std::vector<Place> places_;         // of each
  std::vector<Node> nodes_;           // the root first
  std::vector<int> farLights_;
  DiscreteDistribution far_;  // by irradiance
};

}  // namespace exphoton
