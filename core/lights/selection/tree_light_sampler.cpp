// SPDX-License-Identifier: BSD-2-Clause
// TreeLightSampler is built by splitting the lights into halves along the longest side of the box
// of their centres. It is sampled from the root down.
#include "core/lights/selection/tree_light_sampler.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace exphoton {
namespace {

// The share of the mean power in every light's weight: powers are estimates and can be 0.
constexpr double kMeanPowerShare = .05;
// The least probability of the tree and of the group of distant lights.
constexpr double kLeastGroupShare = .1;
// The least probability of each of two children.
constexpr double kLeastChildShare = 1e-3;

}  // namespace

TreeLightSampler::TreeLightSampler(std::span<const std::unique_ptr<Light>> lights,
                                   const Sphere3& world)
    : LightSampler(lights), places_(lights.size()) {
  std::vector<Leaf> leaves;
  std::vector<double> irradiances;
  double sum = 0;
  for (std::size_t i = 0; i < lights.size(); ++i) {
    const Light& light = *lights[i];
    if (light.IsProvablyBlack()) continue;
    const double power = UsablePower(light);
    if (const auto bounds = light.Bounds()) {
      leaves.push_back({bounds->Center(), *bounds, power, int(i)});
      sum += power;
    } else {
      places_[i].far = int(distantLights_.size());
      distantLights_.push_back(int(i));
      const double disk = double(kPi) * double(world.radius) * double(world.radius);
      irradiances.push_back(disk > 0 ? power / disk : 0);
    }
  }
  if (leaves.empty() && distantLights_.empty()) return;
  for (Leaf& leaf : leaves) {
    const double mean = sum > 0 ? sum / double(leaves.size()) : 1;
    leaf.power = (1 - kMeanPowerShare) * leaf.power + kMeanPowerShare * mean;
  }
  double farSum = 0;
  for (const double irradiance : irradiances) farSum += irradiance;
  for (double& irradiance : irradiances) {
    const double mean = farSum > 0 ? farSum / double(irradiances.size()) : 1;
    irradiance = (1 - kMeanPowerShare) * irradiance + kMeanPowerShare * mean;
  }
  if (!irradiances.empty()) far_ = DiscreteDistribution(irradiances);
  nodes_.reserve(2 * leaves.size());
  if (!leaves.empty()) Build(leaves, {0, 0, -1});
}

// Returns the index of the subtree's root node.
int TreeLightSampler::Build(std::span<Leaf> leaves, Place place) {
  const int number = int(nodes_.size());
  nodes_.emplace_back();
  Bounds3 bounds, centers;
  double power = 0;
  for (const Leaf& leaf : leaves) {
    bounds.Extend(leaf.bounds);
    centers.Extend(leaf.center);
    power += leaf.power;
  }
  const Sphere3 ball = BoundingSphere(bounds);
  Node node{ball.center, ball.radius, power, -1, -1};
  if (leaves.size() == 1) {
    node.light = leaves[0].light;
    places_[std::size_t(node.light)] = place;
    nodes_[std::size_t(number)] = node;
    return number;
  }
  const int axis = centers.LongestAxis();
  const std::size_t middle = leaves.size() / 2;
  std::nth_element(leaves.begin(), leaves.begin() + std::ptrdiff_t(middle), leaves.end(),
                   [axis](const Leaf& a, const Leaf& b) {
                     return a.center[axis] != b.center[axis] ? a.center[axis] < b.center[axis]
                                                             : a.light < b.light;
                   });
  Build(leaves.first(middle), {place.turns, place.depth + 1, -1});
  node.right = Build(leaves.subspan(middle),
                     {place.turns | std::uint64_t(1) << place.depth, place.depth + 1, -1});
  nodes_[std::size_t(number)] = node;
  return number;
}

// A point within the sphere round the node is at most its radius higher above a plane than the
// centre is.
inline TreeLightSampler::Importance TreeLightSampler::ImportanceOf(const Node& node,
                                                                   const LightReceiver& receiver) {
  const Vector3 to = node.center - receiver.p;
  const Real d2 = LengthSquared(to), r2 = Square(node.radius);
  if (!(d2 > r2)) return {node.power, double(r2)};
  if (receiver.ns == Normal3()) return {node.power, double(d2)};
  if (Dot(to, receiver.n) < -node.radius) return {0, double(d2)};
  const Real cosine = (AbsDot(to, receiver.ns) + node.radius) / std::sqrt(d2);
  return {node.power * double(std::min(cosine, Real(1))), double(d2)};
}

double TreeLightSampler::LeftProbability(int node, const LightReceiver& receiver) const {
  const Importance left = ImportanceOf(nodes_[std::size_t(node + 1)], receiver);
  const Importance right =
      ImportanceOf(nodes_[std::size_t(nodes_[std::size_t(node)].right)], receiver);
  // Compares power / distance^2 of both children, multiplied by both squared distances.
  const double a = left.power * right.distance2, b = right.power * left.distance2;
  return a + b > 0 ? std::clamp(a / (a + b), kLeastChildShare, 1 - kLeastChildShare) : .5;
}

// Follows the brighter child from the root down, and adds the irradiance of each other child.
double TreeLightSampler::NearIrradiance(const LightReceiver& receiver) const {
  const auto irradiance = [&](int node) {
    const Importance found = ImportanceOf(nodes_[std::size_t(node)], receiver);
    if (!(found.distance2 > 0)) return std::numeric_limits<double>::infinity();
    return found.power / (4 * double(kPi) * found.distance2);
  };
  int node = 0;
  double sum = 0, brighter = irradiance(node);
  while (nodes_[std::size_t(node)].right >= 0) {
    const int children[] = {node + 1, nodes_[std::size_t(node)].right};
    const double left = irradiance(children[0]), right = irradiance(children[1]);
    sum += std::min(left, right);
    brighter = std::max(left, right);
    node = children[left >= right ? 0 : 1];
  }
  return sum + brighter;
}

double TreeLightSampler::DistantProbability(const LightReceiver& receiver) const {
  if (receiver.distantProbability >= 0) return double(receiver.distantProbability);
  if (distantLights_.empty()) return 0;
  if (nodes_.empty()) return 1;
  const double sum = far_.Sum() + NearIrradiance(receiver);
  const double share = sum > 0 ? far_.Sum() / sum : .5;
  return double(Real(std::clamp(share, kLeastGroupShare, 1 - kLeastGroupShare)));
}

LightReceiver TreeLightSampler::Prepared(const LightReceiver& receiver) const {
  LightReceiver prepared = receiver;
  prepared.distantProbability = Real(DistantProbability(receiver));
  return prepared;
}

LightSampler::Choice TreeLightSampler::Sample(const LightReceiver& receiver, Real u) const {
  const double farProbability = DistantProbability(receiver);
  double rest = double(u);
  if (rest < farProbability) {
    const auto choice =
        far_.Sample(Real(std::min(rest / farProbability, double(kOneMinusEpsilon))));
    const int index = distantLights_[std::size_t(choice.index)];
    return {LightAt(index), index, Real(farProbability) * choice.probability, choice.remapped};
  }
  double probability = 1 - farProbability;
  rest = (rest - farProbability) / probability;
  int node = 0;
  while (nodes_[std::size_t(node)].right >= 0) {
    const double left = LeftProbability(node, receiver);
    const bool goesLeft = rest < left;
    const double share = goesLeft ? left : 1 - left;
    rest = goesLeft ? rest / share : (rest - left) / share;
    rest = std::clamp(rest, 0.0, std::nextafter(1.0, 0.0));
    probability *= share;
    node = goesLeft ? node + 1 : nodes_[std::size_t(node)].right;
  }
  const int index = nodes_[std::size_t(node)].light;
  return {LightAt(index), index, Real(probability), std::min(Real(rest), kOneMinusEpsilon)};
}

Real TreeLightSampler::Pmf(const LightReceiver& receiver, const Light& light) const {
  const Place& place = places_[std::size_t(IndexOf(light))];
  const double farProbability = DistantProbability(receiver);
  if (place.far >= 0) return Real(farProbability) * far_.Probability(place.far);
  if (place.depth < 0) return 0;
  double probability = 1 - farProbability;
  int node = 0;
  for (int depth = 0; depth < place.depth; ++depth) {
    const double left = LeftProbability(node, receiver);
    const bool goesLeft = (place.turns >> depth & 1) == 0;
    probability *= goesLeft ? left : 1 - left;
    node = goesLeft ? node + 1 : nodes_[std::size_t(node)].right;
  }
  return Real(probability);
}

}  // namespace exphoton
