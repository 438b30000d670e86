// SPDX-License-Identifier: BSD-2-Clause
// Aggregate is the interface of accelerators (plugins). It finds the first primitive of a
// PrimitiveSet that a ray hits. It refers to the set but does not own it.
#pragma once

#include <memory>

#include "core/scene/primitive.h"

namespace exphoton {

// Returns whether a ray can hit anything. Every accelerator calls this first and may then rely on
// finite numbers.
inline bool IsTraceable(const Ray& ray) {
  return IsFinite(ray.o) && IsFinite(ray.d) && ray.d != Vector3() && ray.tMax > 0;
}

class Aggregate {
 public:
  virtual ~Aggregate() = default;

  // Returns the nearest hit with 0 < t < ray.tMax. PrimitiveSet defines which of several hits at
  // equal t wins. A ray with a NaN or a zero direction hits nothing.
  virtual Hit Intersect(const Ray& ray) const = 0;
  // Returns whether any primitive is hit in 0 < t < ray.tMax.
  virtual bool Occluded(const Ray& ray) const = 0;
  virtual std::size_t MemoryBytes() const { return 0; }
};

// A primitive set with its accelerator. Instances refer to such an object.
class ObjectGeometry {
 public:
  ObjectGeometry(std::unique_ptr<PrimitiveSet> set, std::unique_ptr<Aggregate> aggregate);
  ~ObjectGeometry();
  const PrimitiveSet& Set() const { return *set_; }
  const Aggregate& Accelerator() const { return *aggregate_; }

 private:
  std::unique_ptr<PrimitiveSet> set_;
  std::unique_ptr<Aggregate> aggregate_;
};

}  // namespace exphoton
