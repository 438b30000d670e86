// SPDX-License-Identifier: BSD-2-Clause
// The texture "windy" is the height of water under wind: waves of six octaves, whose amplitude is a
// ten times coarser noise of three octaves.
#include "materials/textures/noise/noise_texture.h"

namespace exphoton {
namespace {

struct Settings {};

template <class T>
const ParamTable<Settings>& Parameters() {
  static const ParamTable<Settings> table;
  return table;
}

template <class T>
std::unique_ptr<Texture<T>> Create(const Settings&, const TextureContext& context) {
  return MakeNoiseTexture<T>(context, [](const TexturePoint3& at) {
    const double wind = FbmAt(Scaled(at, Real(.1)), {3, .5});
    return std::abs(wind) * FbmAt(at, {6, .5});
  });
}

}  // namespace
}  // namespace exphoton

EXPHOTON_TEXTURE("windy", "waves on water")
