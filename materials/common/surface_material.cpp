// SPDX-License-Identifier: BSD-2-Clause
// SurfaceMaterial: the parts that run while a scene is loaded.
#include "materials/common/surface_material.h"

#include <string>

namespace exphoton {

const ParamTable<SurfaceSettings>& SurfaceParameters() {
  static const ParamTable<SurfaceSettings> table{
      Param("bumpmap", &SurfaceSettings::bumpMap,
            "displaces the surface along its normal, for shading only; none if absent")
          .Unit("scene units")};
  return table;
}

SurfaceMaterial::SurfaceMaterial(const SurfaceSettings& settings) : bumpMap_(settings.bumpMap) {
  // A constant displacement tilts no normal, even on a curved surface.
  if (bumpMap_ && bumpMap_->ConstantValue()) bumpMap_ = nullptr;
  needsDifferentials_ = bumpMap_ != nullptr;
}

SurfaceMaterial::~SurfaceMaterial() = default;

void SurfaceMaterial::ReadsColor(const char* name, const TexturePtr<Spectrum>& color,
                                 const MaterialContext& context) {
  Reads(color);
  const auto value = color->ConstantValue();
  if (value && value->MaxComponent() > 1) {
    context.log.Warning(
        std::string("'") + name + "' is above 1: the surface scatters more light than it receives",
        context.where);
  }
}

}  // namespace exphoton
