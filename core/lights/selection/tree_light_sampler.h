// SPDX-License-Identifier: BSD-2-Clause
// TreeLightSampler chooses one of many lights for a point, in time proportional to the logarithm of
// their number. It chooses near and bright lights more often. Source: Conty Estevez and Kulla 2018,
// "Importance Sampling of Many Lights with Adaptive Tree Splitting", with the cosine at the
// receiver, without orientations of lights and without splitting.
#pragma once

#include "core/lights/selection/light_sampler.h"
#include "core/math/sampling/distribution.h"

namespace exphoton {

// The lights that have a position form a balanced tree. On the way down, a child is chosen in
// proportion to an estimate of its irradiance, power cos / (4 pi max(d^2, r^2)). d is the distance
// to the centre of its box, and r is half the diagonal of the box. cos is a bound on the cosine at
// a surface, and 0 for lights behind it. Distant lights (sun, sky) form a separate group. It is
// chosen by its irradiance; the tree's irradiance is a sum over a few nodes. No light is starved:
// each choice between groups or children has a least probability, and each light's power is mixed
// with the mean power.
class TreeLightSampler final : public LightSampler {
 public:
  // `world` is the sphere that the lights were prepared with.
  TreeLightSampler(std::span<const std::unique_ptr<Light>> lights, const Sphere3& world);

  LightReceiver Prepared(const LightReceiver& receiver) const override;
  Choice Sample(const LightReceiver& receiver, Real u) const override;
  Real Pmf(const LightReceiver& receiver, const Light& light) const override;

 private:
  struct Node {
    Point3 center;
    Real radius = 0;   // of the sphere around the box
    double power = 0;  // luminance
    int right = -1;    // right child, -1 for a leaf; the left child follows its parent
    int light = -1;    // the light of a leaf
  };
  struct Leaf {
    Point3 center;
    Bounds3 bounds;
    double power;
    int light;
  };
  // Place is the position of a light in the tree: the turns from the root down, in bits from the
  // least significant. A set bit is a turn to the right.
  struct Place {
    std::uint64_t turns = 0;
    int depth = -1;  // -1: not in the tree
    int far = -1;    // index in the distribution of distant lights; -1: not distant
  };

  int Build(std::span<Leaf> leaves, Place place);
  // Importance is the estimate of a node's irradiance at a receiver, times 4 pi, as a fraction: the
  // receiver may lie on a light, so the squared distance may be 0.
  struct Importance {
    double power;      // times a bound on the cosine
    double distance2;  // at least the squared radius
  };
  static Importance ImportanceOf(const Node& node, const LightReceiver& receiver);
  double LeftProbability(int node, const LightReceiver& receiver) const;
  double NearIrradiance(const LightReceiver& receiver) const;
  double DistantProbability(const LightReceiver& receiver) const;

  std::vector<Place> places_;  // one per light
  std::vector<Node> nodes_;    // the root first
  std::vector<int> distantLights_;
  DiscreteDistribution far_;  // by irradiance
};

}  // namespace exphoton
