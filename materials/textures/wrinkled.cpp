// SPDX-License-Identifier: BSD-2-Clause
// The texture "wrinkled" is turbulence in texture space: a sum of octaves of the absolute value of
// noise, whose creases look like folds.
#include "materials/textures/noise/noise_texture.h"

namespace exphoton {
namespace {

template <class T>
const ParamTable<FractalSettings>& Parameters() {
  return FractalParameters();
}

template <class T>
std::unique_ptr<Texture<T>> Create(const FractalSettings& settings, const TextureContext& context) {
  return MakeNoiseTexture<T>(
      context,
      [noise = settings.Noise()](const TexturePoint3& at) { return TurbulenceAt(at, noise); },
      settings.IsBlack());
}

}  // namespace
}  // namespace exphoton

EXPHOTON_TEXTURE("wrinkled", "a sum of octaves of the absolute value of noise")
