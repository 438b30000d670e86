// SPDX-License-Identifier: BSD-2-Clause
// Material turns a surface interaction into a BSDF. It is immutable and shared between threads.
#pragma once

#include <bit>
#include <memory>
#include <string>
#include <vector>

#include "core/base/arena.h"
#include "core/scattering/bsdf.h"
#include "core/scattering/texture.h"

namespace exphoton {

class Material {
 public:
  virtual ~Material() = default;

  // Evaluates textures and applies bump mapping to si->shading, then makes the lobes in `arena`.
  virtual Bsdf Evaluate(SurfaceInteraction* si, TransportMode mode, Arena* arena) const = 0;

  // Returns every lobe that Evaluate may ever add. A lobe whose coefficient is provably 0 is left
  // out.
  virtual LobeSet PossibleLobes() const = 0;
  // Returns whether any texture is filtered or there is a bump map. Otherwise rays need no
  // differentials.
  virtual bool NeedsDifferentials() const = 0;
  // Returns an upper bound of the number of lobes that Evaluate adds, at most Bsdf::kMaxLobes.
  virtual int LobeCount() const { return std::popcount(unsigned(PossibleLobes())); }
};

// MaterialLookup finds the materials that a scene has named, for a material made of others.
class MaterialLookup {
 public:
  virtual ~MaterialLookup() = default;
  // Returns null for an unknown name. Throws Error if the material cannot be made.
  virtual std::shared_ptr<const Material> Find(const std::string& name) const = 0;
  virtual std::vector<std::string> Names() const = 0;  // for "did you mean"
};

}  // namespace exphoton
