// SPDX-License-Identifier: BSD-2-Clause
// MappingSettings holds the parameters of 2D texture mappings, which several textures share.
#pragma once

#include "core/plugin.h"
#include "core/scattering/texture_mapping.h"

namespace exphoton {

struct MappingSettings {
  TextureMapping2D::Kind mapping = TextureMapping2D::Kind::Uv;
  Real uScale = 1, vScale = 1, uDelta = 0, vDelta = 0;
  Vector3 v1{1, 0, 0}, v2{0, 1, 0};

  TextureMapping2D Mapping(const TextureContext& context) const {
    return {{mapping, uScale, vScale, uDelta, vDelta, v1, v2}, context.textureToWorld};
  }
};

const ParamTable<MappingSettings>& MappingParameters();

}  // namespace exphoton
