// SPDX-License-Identifier: BSD-2-Clause
// SurfaceMaterial: what all materials share: the bump map, colours read without NaN or negative
// values, warnings of colours above 1, and the answers about lobes and differentials.
#pragma once

#include <string>

#include "core/plugin.h"
#include "core/scattering/bump.h"

namespace exphoton {

struct SurfaceSettings {
  TexturePtr<Real> bumpMap;  // null: none
};

inline const ParamTable<SurfaceSettings>& SurfaceParameters() {
  static const ParamTable<SurfaceSettings> table{
      Param("bumpmap", &SurfaceSettings::bumpMap,
            "displaces the surface along its normal, for shading only; none if absent")
          .Unit("scene units")};
  return table;
}

// Positive and finite values as they are, above 1 too; everything else is 0.
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
  LobeSet PossibleLobes() const final { return possible_; }
  bool NeedsDifferentials() const final { return needsDifferentials_; }

 protected:
  explicit SurfaceMaterial(const SurfaceSettings& settings) : bumpMap_(settings.bumpMap) {
    // A constant displacement of a curved surface tilts nothing either.
    if (bumpMap_ && bumpMap_->ConstantValue()) bumpMap_ = nullptr;
    needsDifferentials_ = bumpMap_ != nullptr;
  }

  // For the constructor: a texture that Evaluate reads.
  template <class T>
  void Reads(const TexturePtr<T>& texture) {
    needsDifferentials_ = needsDifferentials_ || texture->IsFiltered();
  }
  // A reflectance or transmittance: warns if it is known to create energy.
  void ReadsColor(const char* name, const TexturePtr<Spectrum>& color,
                  const MaterialContext& context) {
    Reads(color);
    const auto value = color->ConstantValue();
    if (value && value->MaxComponent() > 1) {
      context.log.Warning(std::string("'") + name +
                              "' is above 1: the surface scatters more light than it receives",
                          context.where);
    }
  }
  void MayHave(LobeSet lobe) { possible_ = possible_ | lobe; }

  // First of Evaluate: bump mapping, then an empty BSDF in the frame it left.
  Bsdf MakeBsdf(SurfaceInteraction* si) const {
    if (bumpMap_) ApplyBump(*bumpMap_, si);
    return Bsdf(*si);
  }

 private:
  TexturePtr<Real> bumpMap_;
  bool needsDifferentials_ = false;
  LobeSet possible_ = LobeSet::None;
};

}  // namespace exphoton
