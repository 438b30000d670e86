// SPDX-License-Identifier: BSD-2-Clause
// kdtree: rays walk a kd-tree from front to back. Cells are entered wherever rounding might have
// put a hit: every plane has a margin that follows from the ray's origin, every primitive one that
// follows from its coordinates, so that the answer is exactly that of testing every primitive.
// Traversal runs in double; direction components of 0 are decided by comparison.
#include <array>

#include "accelerators/kd/kd_build.h"
#include "core/plugin.h"

namespace exphoton {
namespace {

struct Settings {
  int intersectCost = 80, traversalCost = 1;
  Real emptyBonus = Real(.5);
  int maxPrimitives = 1, maxDepth = -1;
};

const ParamTable<Settings>& Parameters() {
  static const ParamTable<Settings> table{
      Param("intersectcost", &Settings::intersectCost, "assumed cost of testing a primitive")
          .Range(1, 1000000),
      Param("traversalcost", &Settings::traversalCost, "assumed cost of a step in the tree")
          .Range(0, 1000000),
      Param("emptybonus", &Settings::emptyBonus, "discount for cutting off empty space")
          .Range(0, 1),
      Param("maxprims", &Settings::maxPrimitives, "a cell with as few is not split")
          .Range(1, 1000000),
      Param("maxdepth", &Settings::maxDepth, "levels of the tree; -1: by the number of primitives")
          .Range(-1, 1000000)};
  return table;
}

// The ray as the traversal needs it.
struct KdRay {
  std::array<double, 3> o, d, inverse;
  double margin;                  // of positions
  std::array<double, 3> tMargin;  // the same, as a part of the ray

  explicit KdRay(const Ray& ray) {
    margin = double(kKdMargin) * double(MaxComponent(Abs(ray.o)));
    for (int axis = 0; axis < 3; ++axis) {
      const auto a = std::size_t(axis);
      o[a] = double(ray.o[axis]);
      d[a] = double(ray.d[axis]);
      inverse[a] = d[a] == 0 ? 0 : 1 / d[a];
      tMargin[a] = margin * std::abs(inverse[a]);
    }
  }
};

struct Span {
  double min, max;
};

// Where the ray may be within the bounds.
std::optional<Span> RootSpan(const KdRay& ray, const Bounds3& bounds, Real tMax) {
  Span span{0, double(tMax)};
  for (std::size_t a = 0; a < 3; ++a) {
    const double low = double(bounds.min[int(a)]) - ray.o[a];
    const double high = double(bounds.max[int(a)]) - ray.o[a];
    if (ray.d[a] == 0) {
      if (low > ray.margin || high < -ray.margin) return std::nullopt;
      continue;
    }
    const double t0 = low * ray.inverse[a], t1 = high * ray.inverse[a];
    span.min = std::max(span.min, std::min(t0, t1) - ray.tMargin[a]);
    span.max = std::min(span.max, std::max(t0, t1) + ray.tMargin[a]);
  }
  if (!(span.min <= span.max)) return std::nullopt;
  return span;
}

class KdTree final : public Aggregate {
 public:
  KdTree(const PrimitiveSet& primitives, const KdCosts& costs)
      : primitives_(primitives), arrays_(BuildKdTree(primitives, costs)) {}

  Hit Intersect(const Ray& ray) const override {
    Hit hit;
    if (!IsTraceable(ray)) return hit;
    hit.t = ray.tMax;
    const TraceRay trace(ray);
    Walk(ray, [&](const KdNode& leaf) {
      ForEach(leaf, [&](std::uint32_t id) {
        primitives_.Intersect(id, trace, &hit);
        return false;
      });
      return double(hit.t);
    });
    return hit;
  }

  bool Occluded(const Ray& ray) const override {
    if (!IsTraceable(ray)) return false;
    const TraceRay trace(ray);
    bool isOccluded = false;
    Walk(ray, [&](const KdNode& leaf) {
      isOccluded = ForEach(leaf, [&](std::uint32_t id) { return primitives_.Occludes(id, trace); });
      return isOccluded ? -1.0 : double(ray.tMax);
    });
    return isOccluded;
  }

  std::size_t MemoryBytes() const override {
    return arrays_.nodes.size() * sizeof(KdNode) + arrays_.entries.size() * sizeof(std::uint32_t);
  }

 private:
  // Calls visit(id) for the entries of a leaf until one says true.
  template <class Visit>
  bool ForEach(const KdNode& leaf, Visit&& visit) const {
    const std::uint32_t count = leaf.High();
    if (count == 1) return visit(leaf.offset);
    const std::uint32_t* entry = arrays_.entries.data() + leaf.offset;
    for (std::uint32_t i = 0; i < count; ++i)
      if (visit(entry[i])) return true;
    return false;
  }

  // Visits the leaves along the ray, roughly from front to back. visit(leaf) returns the t beyond
  // which nothing matters any more (ties at it do).
  template <class Visit>
  void Walk(const Ray& worldRay, Visit&& visit) const {
    if (arrays_.nodes.empty()) return;
    const KdRay ray(worldRay);
    const auto root = RootSpan(ray, arrays_.bounds, worldRay.tMax);
    if (!root) return;
    struct Entry {
      std::uint32_t node;
      Span span;
    };
    std::array<Entry, std::size_t(kKdMaxDepth) + 4> stack;
    std::size_t depth = 0;
    std::uint32_t index = 0;
    Span span = *root;
    double limit = double(worldRay.tMax);
    const KdNode* nodes = arrays_.nodes.data();
    for (;;) {
      const KdNode& node = nodes[index];
      if (!node.IsLeaf()) {
        const auto axis = std::size_t(node.Axis());
        const double toPlane = double(node.split) - ray.o[axis];
        std::uint32_t near = index + 1, far = node.High();
        double nearEnd, farBegin;
        if (ray.d[axis] == 0) {
          if (toPlane < 0) std::swap(near, far);
          const bool isBeside = std::abs(toPlane) <= ray.margin;
          nearEnd = span.max;
          farBegin = isBeside ? span.min : std::numeric_limits<double>::infinity();
        } else {
          if (ray.d[axis] < 0) std::swap(near, far);
          const double t = toPlane * ray.inverse[axis];
          nearEnd = t + ray.tMargin[axis];
          farBegin = t - ray.tMargin[axis];
        }
        if (farBegin > span.max) {
          index = near;
          span.max = std::min(span.max, nearEnd);
        } else if (nearEnd < span.min) {
          index = far;
          span.min = std::max(span.min, farBegin);
        } else {
          stack[depth++] = {far, {std::max(span.min, farBegin), span.max}};
          index = near;
          span.max = std::min(span.max, nearEnd);
        }
        continue;
      }
      if (node.High() > 0) limit = visit(node);
      do {
        if (depth == 0) return;
        --depth;
      } while (stack[depth].span.min > limit);
      index = stack[depth].node;
      span = stack[depth].span;
    }
  }

  const PrimitiveSet& primitives_;
  KdArrays arrays_;
};

std::unique_ptr<Aggregate> Create(const Settings& settings, const AcceleratorContext& context) {
  KdCosts costs;
  costs.intersect = settings.intersectCost;
  costs.traverse = settings.traversalCost;
  costs.emptyBonus = double(settings.emptyBonus);
  costs.maxPrimitives = std::uint32_t(settings.maxPrimitives);
  const double count = std::max(double(context.primitives.Count()), 1.0);
  costs.maxDepth = settings.maxDepth >= 0 ? settings.maxDepth : int(8 + 1.3 * std::log2(count));
  if (costs.maxDepth > kKdMaxDepth) {
    if (settings.maxDepth > kKdMaxDepth)
      context.log.Warning("kdtree: \"maxdepth\" is limited to " + std::to_string(kKdMaxDepth));
    costs.maxDepth = kKdMaxDepth;
  }
  return std::make_unique<KdTree>(context.primitives, costs);
}

}  // namespace
}  // namespace exphoton

EXPHOTON_PLUGIN("kdtree", "a kd-tree built by the surface area heuristic",
                exphoton::MakeForm<exphoton::PluginKind::Accelerator>(exphoton::Parameters(),
                                                                      exphoton::Create))
