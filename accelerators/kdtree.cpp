// SPDX-License-Identifier: BSD-2-Clause
// kdtree is the classic kd-tree: kd_build.cpp builds it by the surface area heuristic, and rays
// traverse it with a stack of nodes to visit. A ray enters a cell wherever rounding might have put
// a hit. The margin at split planes grows with the distance; the margin of primitives follows from
// their size. Hits therefore equal those of testing every primitive. Traversal runs in double
// precision and divides by no component that may be 0.
#include <array>
#include <span>

#include "accelerators/bvh/traverse/traverse.h"
#include "accelerators/kd/kd_build.h"
#include "core/plugin.h"

namespace exphoton {
namespace {

using Settings = KdSettings;

const ParamTable<Settings>& Parameters() {
  static const ParamTable<Settings> table{
      Param("intersectcost", &Settings::intersectCost,
            "assumed cost of testing up to eight triangles")
          .Range(1, 1000000),
      Param("traversalcost", &Settings::traversalCost, "assumed cost of a step in the tree")
          .Range(0, 1000000),
      Param("emptybonus", &Settings::emptyBonus, "discount for cutting off empty space")
          .Range(0, 1),
      Param("maxprims", &Settings::maxPrimitives,
            "largest number of primitives in a cell that is not split")
          .Range(1, 1000000),
      Param("maxdepth", &Settings::maxDepth, "levels of the tree; -1: by the number of primitives")
          .Range(-1, 1000000)};
  return table;
}

// KdRay holds a ray in the form that traversal needs. The computed hit at t may lie up to slope * t
// off the ray on each axis, so the ray crosses a plane somewhere in an interval of t.
struct KdRay {
  struct Axis {
    double o;
    double first, last;  // 1 / (d +- slope), signed as d: earliest and latest t per distance
    bool isParallel;     // the ray may stay on one side of a plane
    bool isBackward;
  };
  Axis axes[3];

  explicit KdRay(const Ray& ray) {
    const double slope = double(kBvhMargin) * double(MaxComponent(Abs(ray.d)));
    for (int i = 0; i < 3; ++i) {
      Axis& axis = axes[i];
      const double d = double(ray.d[i]), size = std::abs(d);
      axis.o = double(ray.o[i]);
      axis.isBackward = d < 0;
      axis.isParallel = size <= 2 * slope;
      // With x = slope / |d|: 1 / (1 + x) >= 1 - x, and 1 / (1 - x) <= 1 + 2 x for x up to 1/2.
      const double inverse = 1 / (axis.isParallel ? slope : size), x = slope * inverse;
      constexpr double kRounding = 8 * std::numeric_limits<double>::epsilon();
      axis.first =
          std::copysign(axis.isParallel ? inverse * .33 : inverse * (1 - x - kRounding), d);
      axis.last = axis.isParallel ? 0 : std::copysign(inverse * (1 + 2 * x + kRounding), d);
    }
  }
};

struct Span {
  double min, max;
};

// Returns the interval of t in which the ray may be within the bounds; min > max if there is none.
Span RootSpan(const KdRay& ray, const Bounds3& bounds, Real tMax) {
  Span span{0, double(tMax)};
  for (int i = 0; i < 3; ++i) {
    const KdRay::Axis& axis = ray.axes[i];
    double enter = double(bounds.min[i]) - axis.o, leave = double(bounds.max[i]) - axis.o;
    if (axis.isParallel) {
      const double outside = std::max({enter, -leave, 0.0});
      span.min = std::max(span.min, outside * std::abs(axis.first));
      continue;
    }
    if (axis.isBackward) std::swap(enter, leave);
    span.min = std::max(span.min, enter * axis.first);
    span.max = std::min(span.max, leave * axis.last);
  }
  return span;
}

class KdTree final : public Aggregate {
 public:
  KdTree(const PrimitiveSet& primitives, const KdSettings& settings)
      : primitives_(primitives), arrays_(BuildKdTree(primitives, settings)) {}

  Hit Intersect(const Ray& ray) const override {
    if (!IsTraceable(ray)) return {};
    const TraceRay trace(ray);
    NearestHit nearest(ray.tMax);
    BlockRayRoom blockRay;
    test_.makeBlockRay(trace.triangle, &blockRay);
    Walk<Order::NearFirst>(ray, [&](const KdNode& leaf) {
      test_.intersectBlocks(FirstBlock(leaf), leaf.Blocks(), blockRay, trace.triangle, &nearest);
      if (leaf.HasOthers()) test_.findDistance(trace.triangle, &nearest);
      for (std::uint32_t id : Others(leaf)) IntersectOther(primitives_, id, trace, &nearest);
      return double(nearest.high);
    });
    return nearest.hit;
  }

  bool Occluded(const Ray& ray) const override {
    if (!IsTraceable(ray)) return false;
    const TraceRay trace(ray);
    BlockRayRoom blockRay;
    test_.makeBlockRay(trace.triangle, &blockRay);
    bool isOccluded = false;
    // Any hit blocks a shadow ray. The far end comes first, because most blockers lie where rays
    // leave a room or end at a light.
    Walk<Order::FarFirst>(ray, [&](const KdNode& leaf) {
      isOccluded = test_.occludedByBlocks(FirstBlock(leaf), leaf.Blocks(), blockRay, trace);
      for (std::uint32_t id : Others(leaf))
        isOccluded = isOccluded || primitives_.Occludes(id, trace);
      return isOccluded ? -1.0 : double(ray.tMax);
    });
    return isOccluded;
  }

  std::size_t MemoryBytes() const override {
    return arrays_.nodes.size() * sizeof(KdNode) + arrays_.blocks.size() * sizeof(BvhBlock) +
           arrays_.lists.size() * sizeof(std::uint32_t);
  }

 private:
  const BvhBlock* FirstBlock(const KdNode& leaf) const {
    return arrays_.blocks.data() + (leaf.HasOthers() ? arrays_.lists[leaf.first] : leaf.first);
  }
  std::span<const std::uint32_t> Others(const KdNode& leaf) const {
    if (!leaf.HasOthers()) return {};
    const std::uint32_t* list = arrays_.lists.data() + leaf.first;
    return {list + 2, list[1]};
  }

  enum class Order { NearFirst, FarFirst };

  // ToVisit is a node and the part of the ray inside it.
  struct ToVisit {
    std::uint32_t node;
    Span span;
  };

  // Visits the leaves along the ray, roughly from front to back or from back to front. visit(leaf)
  // returns the t beyond which no hit matters any more; a hit at exactly this t still matters. A
  // negative t ends the traversal.
  template <Order order, class Visit>
  void Walk(const Ray& worldRay, Visit&& visit) const {
    const KdRay ray(worldRay);
    const KdNode* nodes = arrays_.nodes.data();
    std::array<ToVisit, std::size_t(kKdMaxDepth)> toVisit;
    std::size_t count = 0;
    ToVisit now{0, RootSpan(ray, arrays_.bounds, worldRay.tMax)};
    if (arrays_.nodes.empty() || !(now.span.min <= now.span.max)) return;
    double limit = double(worldRay.tMax);
    for (;;) {
      const KdNode& node = nodes[now.node];
      if (!node.IsLeaf()) {
        const KdRay::Axis& axis = ray.axes[node.Axis()];
        const double toPlane = double(node.split) - axis.o;
        std::uint32_t near = now.node + 1, far = node.Above();
        double nearEnd = toPlane * axis.last, farBegin = toPlane * axis.first;
        if (axis.isParallel) [[unlikely]] {
          if (toPlane < 0) std::swap(near, far);
          nearEnd = now.span.max, farBegin = std::abs(farBegin);
        } else if (axis.isBackward) {
          std::swap(near, far);
        }
        // If the ray meets only one child, it crosses the plane outside the span or never.
        if (farBegin > now.span.max) {
          now.node = near;
        } else if (nearEnd < now.span.min) {
          now.node = far;
        } else {
          const ToVisit inNear{near, {now.span.min, std::min(now.span.max, nearEnd)}};
          const ToVisit inFar{far, {std::max(now.span.min, farBegin), now.span.max}};
          if (nodes[near].IsEmpty()) {
            now = inFar;
          } else if (nodes[far].IsEmpty()) {
            now = inNear;
          } else {
            toVisit[count++] = order == Order::NearFirst ? inFar : inNear;
            now = order == Order::NearFirst ? inNear : inFar;
          }
        }
        continue;
      }
      if (!node.IsEmpty()) limit = visit(node);
      if (limit < 0) return;
      do {
        if (count == 0) return;
        now = toVisit[--count];
      } while (order == Order::NearFirst && now.span.min > limit);
    }
  }

  const PrimitiveSet& primitives_;
  KdArrays arrays_;
  const BvhTraversal& test_ = FastestTraversal(BvhVectors::Widest);
};

std::unique_ptr<Aggregate> Create(const Settings& given, const AcceleratorContext& context) {
  Settings settings = given;
  if (settings.maxDepth < 0)
    settings.maxDepth = int(8 + 1.3 * std::log2(std::max(double(context.primitives.Count()), 1.0)));
  settings.maxDepth = std::min(settings.maxDepth, kKdMaxDepth);
  if (given.maxDepth > kKdMaxDepth)
    context.log.Warning("kdtree: \"maxdepth\" is limited to " + std::to_string(kKdMaxDepth));
  return std::make_unique<KdTree>(context.primitives, settings);
}

}  // namespace
}  // namespace exphoton

EXPHOTON_ACCELERATOR("kdtree", "a kd-tree built by the surface area heuristic")
