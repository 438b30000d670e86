// SPDX-License-Identifier: BSD-2-Clause
// Uniform makes the textures of one value, once for all plugins.
#include "core/scattering/texture.h"

namespace exphoton {

TexturePtr<Real> Uniform(Real value) { return std::make_shared<const UniformTexture<Real>>(value); }

TexturePtr<Spectrum> Uniform(const Spectrum& value) {
  return std::make_shared<const UniformTexture<Spectrum>>(value);
}

}  // namespace exphoton
