// SPDX-License-Identifier: BSD-2-Clause
// NoiseTexture is a texture of one number that a function computes from the point in texture
// space. As a colour it is grey.
#pragma once

#include "materials/textures/common/mapping.h"
#include "materials/textures/noise/noise.h"

namespace exphoton {

struct FractalSettings {
  int octaves = 8;
  Real roughness = Real(.5);

  bool IsBlack() const { return octaves == 0; }  // a sum of no octaves
  FractalNoise Noise() const { return {octaves, double(roughness)}; }
};

inline const ParamTable<FractalSettings>& FractalParameters() {
  static const ParamTable<FractalSettings> table{
      Param("octaves", &FractalSettings::octaves, "layers of noise, each about twice as fine")
          .Range(0, 64),
      Param("roughness", &FractalSettings::roughness, "amplitude of a layer over the one before")
          .Range(0, 4)};
  return table;
}

// F maps a TexturePoint3 to a double.
template <class T, class F>
class NoiseTexture final : public Texture<T> {
 public:
  // If isBlack, the value is 0 everywhere.
  NoiseTexture(const TextureContext& context, F value, bool isBlack)
      : mapping_(context.textureToWorld), value_(value), isBlack_(isBlack) {}

  T Evaluate(const SurfaceInteraction& si) const override {
    return T(Real(value_(mapping_.Map(si))));
  }
  std::optional<T> ConstantValue() const override {
    return isBlack_ ? std::optional<T>(T(Real(0))) : std::nullopt;
  }
  bool IsFiltered() const override { return !isBlack_; }

 private:
  TextureMapping3D mapping_;
  F value_;
  bool isBlack_;
};

template <class T, class F>
std::unique_ptr<Texture<T>> MakeNoiseTexture(const TextureContext& context, F value,
                                             bool isBlack = false) {
  return std::make_unique<NoiseTexture<T, F>>(context, value, isBlack);
}

}  // namespace exphoton
