// SPDX-License-Identifier: BSD-2-Clause
// Sampling descends a tree and rescales one number at each node.
#include "integrators/photon/shooting/emission/emission_guide.h"

#include <algorithm>

namespace exphoton {

double EmissionTree::Warp(std::array<Real, EmissionNumbers::kDimensions>* u) const {
  // The position within the node, and the node's box.
  std::array<double, EmissionNumbers::kDimensions> x, low{}, size;
  std::copy(u->begin(), u->end(), x.begin());
  size.fill(1);
  double density = 1;
  const Node* node = &nodes_[0];
  while (node->axis >= 0) {
    const auto axis = std::size_t(node->axis);
    const Node* child = &nodes_[std::size_t(node->children)];
    const double share = child->mass / node->mass;
    if (x[axis] < share) {
      x[axis] /= share;
      size[axis] *= node->split;
      density *= share / node->split;
    } else {
      ++child;
      x[axis] = (x[axis] - share) / (1 - share);
      low[axis] += size[axis] * node->split;
      size[axis] *= 1 - node->split;
      density *= (1 - share) / (1 - node->split);
    }
    node = child;
  }
  for (std::size_t d = 0; d < x.size(); ++d)
    (*u)[d] = std::clamp(Real(low[d] + size[d] * x[d]), Real(0), kOneMinusEpsilon);
  return density;
}

double EmissionTree::Density(const std::array<Real, EmissionNumbers::kDimensions>& u) const {
  std::array<double, EmissionNumbers::kDimensions> low{}, size;
  size.fill(1);
  double volume = 1;
  const Node* node = &nodes_[0];
  while (node->axis >= 0) {
    const auto axis = std::size_t(node->axis);
    const double split = low[axis] + size[axis] * node->split;
    const bool isUpper = double(u[axis]) >= split;
    size[axis] *= isUpper ? 1 - node->split : node->split;
    volume *= isUpper ? 1 - node->split : node->split;
    if (isUpper) low[axis] = split;
    node = &nodes_[std::size_t(node->children + isUpper)];
  }
  return node->mass / (nodes_[0].mass * volume);
}

EmissionGuide::Choice EmissionGuide::Warp(EmissionNumbers* numbers) const {
  const auto choice = lights_.Sample(numbers->light);
  const double density = trees_[std::size_t(choice.index)].Warp(&numbers->u);
  return {choice.index, double(choice.probability) * density};
}

}  // namespace exphoton
