// SPDX-License-Identifier: BSD-2-Clause
// Aggregate: the interface of accelerators (plugins): which primitive of a set does a ray hit
// first. It refers to the PrimitiveSet it was built over and owns nothing of it.
#pragma once

#include <memory>

#include "core/scene/primitive.h"

namespace exphoton {

// Whether a ray can hit anything at all; every accelerator asks this first, and may then rely on
// finite numbers.
inline bool IsTraceable(const Ray& ray) {
  return IsFinite(ray.o) && IsFinite(ray.d) && ray.d != Vector3() && ray.tMax > 0;
}

class Aggregate {
 public:
  virtual ~Aggregate() = default;

  // Nearest hit with 0 < t < ray.tMax; of hits at equal t the one PrimitiveSet prefers.
  // A ray with a NaN or a zero direction hits nothing.
  virtual Hit Intersect(const Ray& ray) const = 0;
  // Whether anything lies in 0 < t < ray.tMax.
  virtual bool Occluded(const Ray& ray) const = 0;
  virtual std::size_t MemoryBytes() const { return 0; }
};

// A set with its accelerator: what an instance refers to.
class ObjectGeometry {
 public:
  ObjectGeometry(std::unique_ptr<PrimitiveSet> set, std::unique_ptr<Aggregate> aggregate)
      : set_(std::move(set)), aggregate_(std::move(aggregate)) {}
  const PrimitiveSet& Set() const { return *set_; }
  const Aggregate& Accelerator() const { return *aggregate_; }

 private:
  std::unique_ptr<PrimitiveSet> set_;
  std::unique_ptr<Aggregate> aggregate_;
};

}  // namespace exphoton
