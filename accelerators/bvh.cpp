// SPDX-License-Identifier: BSD-2-Clause
// bvh is a bounding volume hierarchy with eight children per node. It tests boxes and triangles
// eight at a time. It is the default accelerator. Its hits equal those of bruteforce bit for bit on
// every SIMD target.
#include "accelerators/bvh/build/bvh_build.h"
#include "accelerators/bvh/traverse/traverse.h"
#include "core/plugin.h"

namespace exphoton {
namespace {

struct Settings {
  int maxPrimitives = kBvhWidth;
  BvhVectors vectors = BvhVectors::Widest;
  int maxNodePrimitives = 4;
  std::string splitMethod = "sah";
};

const ParamTable<Settings>& Parameters() {
  static const ParamTable<Settings> table{
      Param("maxprims", &Settings::maxPrimitives,
            "largest number of triangles in a leaf, at most eight")
          .Range(1, 64),
      Param("vectors", &Settings::vectors,
            "widest SIMD instructions to use, auto: the machine's; the hits are the same")
          .OneOf({{"auto", BvhVectors::Widest},
                  {"avx2", BvhVectors::Avx2},
                  {"portable", BvhVectors::Portable}}),
      Param("maxnodeprims", &Settings::maxNodePrimitives,
            "version 2's size of leaves; the picture does not depend on it")
          .Ignored(),
      Param("splitmethod", &Settings::splitMethod,
            "version 2's rule for splits; the surface area decides here")
          .Ignored()};
  return table;
}

class Bvh final : public Aggregate {
 public:
  Bvh(const PrimitiveSet& primitives, const Settings& settings, ThreadPool& threads)
      : primitives_(primitives),
        arrays_(BuildBvh(primitives, std::uint32_t(settings.maxPrimitives), threads)),
        traversal_(FastestTraversal(settings.vectors)) {}

  Hit Intersect(const Ray& ray) const override {
    return traversal_.intersect(arrays_, primitives_, ray);
  }
  bool Occluded(const Ray& ray) const override {
    return traversal_.occluded(arrays_, primitives_, ray);
  }
  std::size_t MemoryBytes() const override {
    return arrays_.lines.size() * sizeof(BvhLine) + arrays_.others.size() * sizeof(std::uint32_t);
  }

 private:
  const PrimitiveSet& primitives_;
  BvhArrays arrays_;
  const BvhTraversal& traversal_;
};

std::unique_ptr<Aggregate> Create(const Settings& settings, const AcceleratorContext& context) {
  ThreadPool threads(context.primitives.Count() < kBvhFewPrimitives ? 1 : context.threads);
  return std::make_unique<Bvh>(context.primitives, settings, threads);
}

}  // namespace
}  // namespace exphoton

EXPHOTON_ACCELERATOR("bvh", "a bounding volume hierarchy, eight wide; the default")
