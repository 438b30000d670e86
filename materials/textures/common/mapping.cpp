// SPDX-License-Identifier: BSD-2-Clause
// MappingSettings: the table of its parameters.
#include "materials/textures/common/mapping.h"

namespace exphoton {

const ParamTable<MappingSettings>& MappingParameters() {
  using Kind = TextureMapping2D::Kind;
  static const ParamTable<MappingSettings> table{
      Param("mapping", &MappingSettings::mapping, "how the surface is laid on the texture's plane")
          .OneOf({{"uv", Kind::Uv},
                  {"spherical", Kind::Spherical},
                  {"cylindrical", Kind::Cylindrical},
                  {"planar", Kind::Planar}}),
      Param("uscale", &MappingSettings::uScale, "factor of u (uv)").Range(-1e6, 1e6),
      Param("vscale", &MappingSettings::vScale, "factor of v (uv)").Range(-1e6, 1e6),
      Param("udelta", &MappingSettings::uDelta, "added to s (uv, planar)").Range(-1e6, 1e6),
      Param("vdelta", &MappingSettings::vDelta, "added to t (uv, planar)").Range(-1e6, 1e6),
      Param("v1", &MappingSettings::v1, "s is the product of the world point with it (planar)")
          .As(ParamType::Vector),
      Param("v2", &MappingSettings::v2, "t is the product of the world point with it (planar)")
          .As(ParamType::Vector)};
  return table;
}

}  // namespace exphoton
