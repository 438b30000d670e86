// SPDX-License-Identifier: BSD-2-Clause
// bruteforce tests every primitive with every ray. It is the reference that the other accelerators
// are compared with. For rendering it suits only scenes with a handful of primitives.
#include "core/plugin.h"

namespace exphoton {
namespace {

struct Settings {};

const ParamTable<Settings>& Parameters() {
  static const ParamTable<Settings> table{};
  return table;
}

class BruteForce final : public Aggregate {
 public:
  explicit BruteForce(const PrimitiveSet& primitives) : primitives_(primitives) {}

  Hit Intersect(const Ray& ray) const override {
    Hit hit;
    if (!IsTraceable(ray)) return hit;
    hit.t = ray.tMax;
    const TraceRay trace(ray);
    for (std::uint32_t id = 0; id < primitives_.Count(); ++id)
      primitives_.Intersect(id, trace, &hit);
    return primitives_.Reported(trace, hit);
  }

  bool Occluded(const Ray& ray) const override {
    if (!IsTraceable(ray)) return false;
    const TraceRay trace(ray);
    for (std::uint32_t id = 0; id < primitives_.Count(); ++id)
      if (primitives_.Occludes(id, trace)) return true;
    return false;
  }

 private:
  const PrimitiveSet& primitives_;
};

std::unique_ptr<Aggregate> Create(const Settings&, const AcceleratorContext& context) {
  return std::make_unique<BruteForce>(context.primitives);
}

}  // namespace
}  // namespace exphoton

EXPHOTON_ACCELERATOR("bruteforce",
                     "tests every primitive; the reference for tests of other accelerators")
