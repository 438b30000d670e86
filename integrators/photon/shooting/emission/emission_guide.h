// SPDX-License-Identifier: BSD-2-Clause
// EmissionGuide is a density over everything that the emission of a photon draws at random: the
// light, and the numbers that choose position, direction, part of the light and time. It sends
// photons to where a photon map keeps them. emission_training.h learns it. Sources: Jensen 1996
// (projection maps); Mueller et al. 2017 (adaptive trees); Hesterberg 1995 (defensive mixtures).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/math/sampling/distribution.h"
#include "core/math/vec.h"

namespace exphoton {

// EmissionNumbers are the uniform numbers that decide how one photon leaves a light.
struct EmissionNumbers {
  static constexpr int kDimensions = 6;
  static constexpr int kTime = 5;

  Real light = 0;                     // chooses the light
  std::array<Real, kDimensions> u{};  // position, direction (two each), part of the light, time

  Point2 Position() const { return {u[0], u[1]}; }
  Point2 Direction() const { return {u[2], u[3]}; }
  Real SubLight() const { return u[4]; }
  Real Time() const { return u[kTime]; }
};

// EmissionTree divides the unit cube of one light's numbers into boxes. The density is constant in
// each box.
class EmissionTree {
 public:
  struct Node {
    int axis = -1;              // -1: a leaf
    std::int32_t children = 0;  // index of the lower child; the upper one follows
    double split = 0;           // relative position of the split within the node
    double mass = 0;            // probability of the node, up to a factor
  };

  EmissionTree() : nodes_(1, Node{-1, 0, 0, 1}) {}  // uniform
  // nodes[0] is the root. All masses must be positive, and those of two children must sum to the
  // mass of their parent.
  explicit EmissionTree(std::vector<Node> nodes) : nodes_(std::move(nodes)) {}

  // Maps uniform numbers to numbers of this density, one to one. Neighbours stay neighbours within
  // each box, so well distributed points remain so. Returns the density, which is 1 for a uniform
  // tree.
  double Warp(std::array<Real, EmissionNumbers::kDimensions>* u) const;
  // Returns the density at the numbers.
  double Density(const std::array<Real, EmissionNumbers::kDimensions>& u) const;
  std::span<const Node> Nodes() const { return nodes_; }

 private:
  std::vector<Node> nodes_;
};

class EmissionGuide {
 public:
  EmissionGuide() = default;  // empty
  // `shares` has the probability of each light up to a factor. A light of share 0 is never chosen.
  EmissionGuide(std::span<const double> shares, std::vector<EmissionTree> trees)
      : lights_(shares), trees_(std::move(trees)) {}

  bool IsEmpty() const { return lights_.IsEmpty(); }

  struct Choice {
    int light;
    // Probability of the light times the density of the warped numbers. The power of the photon is
    // divided by it.
    double density;
  };
  Choice Warp(EmissionNumbers* numbers) const;

  double Share(int light) const { return double(lights_.Probability(light)); }
  const EmissionTree& Tree(int light) const { return trees_[std::size_t(light)]; }

 private:
  DiscreteDistribution lights_;
  std::vector<EmissionTree> trees_;
};

}  // namespace exphoton
