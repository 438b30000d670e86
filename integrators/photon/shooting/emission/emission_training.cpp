// SPDX-License-Identifier: BSD-2-Clause
// TreeBuilder splits the unit cube of one light top-down. Every split is the one that most reduces
// the number of paths that a given variance takes.
#include "integrators/photon/shooting/emission/emission_training.h"

#include <algorithm>
#include <cmath>

namespace exphoton {
namespace {

constexpr int kBins = 16;  // candidates for a split are the bounds between them
constexpr int kMaxDepth = 40;
constexpr std::size_t kMaxNodes = 1 << 15;
constexpr std::int64_t kMinKept = 4;  // a node with fewer kept paths is not split
constexpr std::int64_t kMinSamples = 8;
constexpr std::int64_t kMinSlanted = 16;  // kept samples that show a diagonal
constexpr double kMinCorrelation2 = .05;
constexpr double kMinGain = .01;  // of the cost of a node, for a split
// The estimate of a box starts with this many samples of the light's mean among possible paths.
constexpr double kPriorSamples = 1;

// The share of these numbers in all kept paths of a light bounds the part of its kept power that is
// assumed to come from boxes that look empty: from above, and from below.
constexpr double kUnseenAtFirst = 3, kUnseen = .3;

// LabelledSample is an EmissionSample with the power that one map kept.
struct LabelledSample {
  std::array<float, EmissionNumbers::kDimensions> u;
  float inverseDensity, kept;
  bool isGuided;  // the guide changed the density
  bool isRare;    // the guide lowered the density
};

// Moments summarises the samples of a box.
struct Moments {
  double weight = 0, keptWeight = 0;        // sums of the inverse densities
  double square = 0;                        // of the kept power
  double guidedSquare = 0, rareSquare = 0;  // of these, by guided paths; in spite of their guide
  std::int64_t count = 0, kept = 0;

  void Add(const LabelledSample& sample) {
    const double w = double(sample.inverseDensity);
    weight += w;
    square += w * double(sample.kept) * double(sample.kept);
    if (sample.isGuided) guidedSquare += w * double(sample.kept) * double(sample.kept);
    if (sample.isRare) rareSquare += w * double(sample.kept) * double(sample.kept);
    keptWeight += sample.kept > 0 ? w : 0;
    ++count;
    kept += sample.kept > 0;
  }
  Moments& operator+=(const Moments& other) {
    weight += other.weight;
    keptWeight += other.keptWeight;
    square += other.square;
    guidedSquare += other.guidedSquare;
    rareSquare += other.rareSquare;
    count += other.count;
    kept += other.kept;
    return *this;
  }
};

Moments MomentsOf(std::span<const LabelledSample> samples) {
  Moments all;
  for (const LabelledSample& sample : samples) all.Add(sample);
  return all;
}

// A kept photon costs as much time as this many paths that are not kept.
constexpr double kCostOfKept = 20;

// Estimate has the expectations of a box: the mean square of the kept power, and the time of a path
// in units of a path that is not kept.
struct Estimate {
  double square = 0, kept = 0;

  Estimate() = default;
  // The estimate begins with the one of a larger box, or every box where nothing was kept yet would
  // count as empty.
  Estimate(const Moments& moments, const Estimate& larger) {
    if (moments.count == 0) {
      *this = larger;
      return;
    }
    const double n = double(moments.count), scale = 1 / (n + kPriorSamples);
    square = (moments.square / moments.weight * n + kPriorSamples * larger.square) * scale;
    kept = (moments.keptWeight / moments.weight * n + kPriorSamples * larger.kept) * scale;
  }
  Estimate operator+(const Estimate& other) const {
    Estimate sum = *this;
    sum.square += other.square;
    sum.kept += other.kept;
    return sum;
  }
  double Time() const { return 1 + kCostOfKept * kept; }
  // Time multiplied by variance is the square of the sum of all costs, if paths have this density.
  double Cost() const { return std::sqrt(square * Time()); }
  double Density() const { return std::sqrt(square / Time()); }
};

// Returns the part of a light's kept power that probably comes from boxes that look empty. Guided
// paths measure it: it is the part that came from where their guide expected little.
double UnseenShare(const Moments& light) {
  const double n = double(std::max<std::int64_t>(light.kept, 1));
  const double atMost = std::min(1.0, kUnseenAtFirst / n);
  if (!(light.guidedSquare > 0)) return atMost;
  return std::min(atMost, light.rareSquare / light.guidedSquare + kUnseen / n);
}

class TreeBuilder {
 public:
  TreeBuilder(std::span<LabelledSample> samples, const Estimate& prior, int dimensions)
      : dimensions_(dimensions) {
    const Moments all = MomentsOf(samples);
    const Estimate ofLight(all, prior);
    const double unseen = UnseenShare(all);
    unseen_.square = ofLight.square * unseen;
    unseen_.kept = ofLight.kept * unseen;
    nodes_.emplace_back();
    const Box box{};
    Build({0, 0, box, samples, all, ofLight});
    while (!pending_.empty()) {
      const Part part = pending_.back();
      pending_.pop_back();
      Build(part);
    }
  }

  // The mass of each leaf is its volume times the root of its mean square.
  std::vector<EmissionTree::Node> Take() { return std::move(nodes_); }

 private:
  struct Box {
    std::array<double, EmissionNumbers::kDimensions> low{};
    std::array<double, EmissionNumbers::kDimensions> size{1, 1, 1, 1, 1, 1};
    double volume = 1;
  };
  struct Part {
    std::size_t node;
    int depth;
    Box box;
    std::span<LabelledSample> samples;
    Moments moments;
    Estimate estimate;
  };
  struct Split {
    int axis = -1, bin = 0;
    double cost;
    Moments below, above;
  };

  int Bin(const LabelledSample& sample, const Box& box, std::size_t axis) const {
    const double x = (double(sample.u[axis]) - box.low[axis]) / box.size[axis];
    return std::clamp(int(x * kBins), 0, kBins - 1);
  }

  Split BestSplit(const Part& part) const {
    Split best;
    best.cost = part.estimate.Cost() * (1 - kMinGain);
    for (int axis = 0; axis < dimensions_; ++axis) {
      std::array<Moments, kBins> bins{};
      for (const LabelledSample& sample : part.samples)
        bins[std::size_t(Bin(sample, part.box, std::size_t(axis)))].Add(sample);
      std::array<Moments, kBins + 1> above{};
      for (int b = kBins - 1; b >= 0; --b) {
        above[std::size_t(b)] = above[std::size_t(b) + 1];
        above[std::size_t(b)] += bins[std::size_t(b)];
      }
      Moments below;
      for (int b = 1; b < kBins; ++b) {
        below += bins[std::size_t(b) - 1];
        const Moments& rest = above[std::size_t(b)];
        if (below.count < kMinSamples || rest.count < kMinSamples) continue;
        const double x = double(b) / kBins;
        const double split = x * Estimate(below, part.estimate).Cost() +
                             (1 - x) * Estimate(rest, part.estimate).Cost();
        if (split < best.cost) best = {axis, b, split, below, rest};
      }
    }
    return best;
  }

  // Where the kept samples lie along a diagonal, no single split gains anything. A split in the
  // middle of one of the two axes lets splits of the other axis gain.
  Split SlantedSplit(const Part& part) const {
    Split split;
    constexpr int kDims = EmissionNumbers::kDimensions;
    if (part.moments.kept < kMinSlanted) return split;
    std::array<double, kDims> mean{};
    std::array<std::array<double, kDims>, kDims> product{};
    for (const LabelledSample& sample : part.samples) {
      if (!(sample.kept > 0)) continue;
      for (std::size_t i = 0; i < kDims; ++i) {
        const double x = (double(sample.u[i]) - part.box.low[i]) / part.box.size[i];
        mean[i] += x;
        for (std::size_t j = 0; j < i; ++j)
          product[i][j] += x * (double(sample.u[j]) - part.box.low[j]) / part.box.size[j];
        product[i][i] += x * x;
      }
    }
    const double n = double(part.moments.kept);
    for (double& m : mean) m /= n;
    double strongest = kMinCorrelation2;
    const auto covariance = [&](std::size_t i, std::size_t j) {
      return product[i][j] / n - mean[i] * mean[j];
    };
    for (std::size_t i = 1; i < std::size_t(dimensions_); ++i)
      for (std::size_t j = 0; j < i; ++j) {
        const double ii = covariance(i, i), jj = covariance(j, j), ij = covariance(i, j);
        if (!(ij * ij > strongest * ii * jj)) continue;
        strongest = ij * ij / (ii * jj);
        split.axis = int(ii > jj ? i : j);
      }
    if (split.axis < 0) return split;
    split.bin = kBins / 2;
    const auto axis = std::size_t(split.axis);
    for (const LabelledSample& sample : part.samples)
      (Bin(sample, part.box, axis) < split.bin ? split.below : split.above).Add(sample);
    if (split.below.count < kMinSamples || split.above.count < kMinSamples) split.axis = -1;
    return split;
  }

  void Build(const Part& part) {
    nodes_[part.node].mass = (part.estimate + unseen_).Density() * part.box.volume;
    if (part.moments.kept < kMinKept || part.depth >= kMaxDepth || nodes_.size() >= kMaxNodes)
      return;
    Split split = BestSplit(part);
    if (split.axis < 0) split = SlantedSplit(part);
    if (split.axis < 0) return;
    const auto axis = std::size_t(split.axis);
    const auto middle =
        std::partition(part.samples.begin(), part.samples.end(),
                       [&](const LabelledSample& s) { return Bin(s, part.box, axis) < split.bin; });
    const auto lower = std::size_t(middle - part.samples.begin());
    const double x = double(split.bin) / kBins;
    const std::size_t children = nodes_.size();
    nodes_[part.node].axis = split.axis;
    nodes_[part.node].children = std::int32_t(children);
    nodes_[part.node].split = x;
    nodes_.resize(children + 2);
    Box below = part.box, above = part.box;
    below.size[axis] *= x;
    below.volume *= x;
    above.low[axis] += above.size[axis] * x;
    above.size[axis] *= 1 - x;
    above.volume *= 1 - x;
    pending_.push_back({children, part.depth + 1, below, part.samples.first(lower), split.below,
                        Estimate(split.below, part.estimate)});
    pending_.push_back({children + 1, part.depth + 1, above, part.samples.subspan(lower),
                        split.above, Estimate(split.above, part.estimate)});
  }

  int dimensions_;
  Estimate unseen_;
  std::vector<EmissionTree::Node> nodes_;
  std::vector<Part> pending_;
};

// Mixes the masses of the leaves, which sum to `total` over all lights, with a uniform density of
// mass `uniform`, and sums them up. Returns the mass of the node.
double MixMasses(std::vector<EmissionTree::Node>* nodes, std::size_t index, double volume,
                 double factor, double uniform) {
  EmissionTree::Node& node = (*nodes)[index];
  if (node.axis < 0) return node.mass = node.mass * factor + volume * uniform;
  const auto child = std::size_t(node.children);
  node.mass = MixMasses(nodes, child, volume * node.split, factor, uniform) +
              MixMasses(nodes, child + 1, volume * (1 - node.split), factor, uniform);
  return node.mass;
}

double LeafMass(const std::vector<EmissionTree::Node>& nodes) {
  double sum = 0;
  for (const EmissionTree::Node& node : nodes) sum += node.axis < 0 ? node.mass : 0;
  return sum;
}

}  // namespace

EmissionGuide LearnEmission(std::span<const EmissionSample> samples, const EmissionGoal& goal) {
  const std::size_t lights = goal.base.size();
  std::vector<std::vector<LabelledSample>> ofLight(lights);
  for (const EmissionSample& sample : samples) {
    const auto light = std::size_t(sample.light);
    const double gain = 1 / (double(sample.inverseDensity) * goal.base[light]);
    constexpr double kRounding = 1e-4;
    ofLight[light].push_back({sample.u, sample.inverseDensity, sample.kept[std::size_t(goal.map)],
                              std::abs(gain - 1) > kRounding, gain < 1 - kRounding});
  }
  Moments all;
  for (const auto& own : ofLight) all += MomentsOf(own);
  if (all.kept == 0) return {};
  const Estimate ofAll(all, {});
  std::vector<std::vector<EmissionTree::Node>> nodes(lights);
  double total = 0;
  for (std::size_t l = 0; l < lights; ++l) {
    nodes[l].emplace_back();
    nodes[l][0].mass = 0;
    if (ofLight[l].empty()) continue;
    nodes[l] = TreeBuilder(ofLight[l], ofAll, goal.dimensions).Take();
    total += LeafMass(nodes[l]);
  }
  std::vector<double> shares(lights, 0.0);
  std::vector<EmissionTree> trees(lights);
  for (std::size_t l = 0; l < lights; ++l) {
    if (!(goal.base[l] > 0)) continue;
    shares[l] =
        MixMasses(&nodes[l], 0, 1, (1 - goal.defensive) / total, goal.defensive * goal.base[l]);
    trees[l] = EmissionTree(std::move(nodes[l]));
  }
  return EmissionGuide(shares, std::move(trees));
}

}  // namespace exphoton
