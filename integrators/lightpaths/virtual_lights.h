// SPDX-License-Identifier: BSD-2-Clause
// VirtualLights traces sets of light paths and keeps their non-specular surface points as virtual
// point lights (Keller 1997, "Instant Radiosity").
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "integrators/lightpaths/light_path.h"

namespace exphoton {

class VirtualLights {
 public:
  VirtualLights();
  ~VirtualLights();

  // Replaces all sets by `sets` new ones of `paths` light paths each. Path i of all sets depends on
  // (seed, i) alone.
  void Trace(const Scene& scene, int sets, int paths, PreprocessContext& context);
  void Clear();

  std::size_t Count() const;  // in all sets together
  std::span<const LightPathVertex> Set(int i) const { return sets_[std::size_t(i)]; }

 private:
  struct Block;

  LightPathTracer tracer_;
  std::vector<std::vector<LightPathVertex>> sets_;
  std::vector<std::unique_ptr<Block>> blocks_;  // own the memory of the BSDFs
};

}  // namespace exphoton
