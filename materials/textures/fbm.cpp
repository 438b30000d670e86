// SPDX-License-Identifier: BSD-2-Clause
// The texture "fbm" is fractional Brownian motion in texture space: a sum of octaves of noise.
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
      context, [noise = settings.Noise()](const TexturePoint3& at) { return FbmAt(at, noise); },
      settings.IsBlack());
}

}  // namespace
}  // namespace exphoton

EXPHOTON_TEXTURE("fbm", "a sum of octaves of noise")
