// SPDX-License-Identifier: BSD-2-Clause
// SurfaceMaterial is the base class of all materials. It applies the bump map, reads colours
// without NaN or negative values, warns of colours above 1, and reports the possible lobes and the
// need for ray differentials.
#pragma once

#include "core/plugin.h"
#include "core/scattering/bump.h"

namespace exphoton {

struct SurfaceSettings {
  TexturePtr<Real> bumpMap;  // null: none
};

const ParamTable<SurfaceSettings>& SurfaceParameters();

// Returns positive finite values unchanged, also above 1, and 0 for all other values.
inline Real NonNegative(Real x) { return x > 0 && x < kInfinity ? x : 0; }
inline Spectrum NonNegative(const Spectrum& s) {
  return {NonNegative(s.r), NonNegative(s.g), NonNegative(s.b)};
}
template <class T>
T ReadNonNegative(const TexturePtr<T>& texture, const SurfaceInteraction& si) {
  return NonNegative(texture->Evaluate(si));
}

class SurfaceMaterial : public Material {
 public:
  ~SurfaceMaterial() override;
  LobeSet PossibleLobes() const final { return possible_; }
  bool NeedsDifferentials() const final { return needsDifferentials_; }
  int LobeCount() const final { return lobeCount_; }

 protected:
  explicit SurfaceMaterial(const SurfaceSettings& settings);

  // Registers a texture that Evaluate reads. For constructors.
  template <class T>
  void Reads(const TexturePtr<T>& texture) {
    needsDifferentials_ = needsDifferentials_ || texture->IsFiltered();
  }
  // Registers a reflectance or transmittance. Warns if it is constant and creates energy.
  void ReadsColor(const char* name, const TexturePtr<Spectrum>& color,
                  const MaterialContext& context);
  // Registers one lobe that Evaluate may add.
  void MayHave(LobeSet lobe) {
    possible_ = possible_ | lobe;
    ++lobeCount_;
  }

  // First step of Evaluate: applies the bump map and returns an empty BSDF in the resulting frame.
  Bsdf MakeBsdf(SurfaceInteraction* si) const {
    if (bumpMap_) ApplyBump(*bumpMap_, si);
    return Bsdf(*si);
  }

 private:
  TexturePtr<Real> bumpMap_;
  bool needsDifferentials_ = false;
  LobeSet possible_ = LobeSet::None;
  int lobeCount_ = 0;
};

}  // namespace exphoton
