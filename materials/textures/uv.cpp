// SPDX-License-Identifier: BSD-2-Clause
// The texture "uv" shows texture coordinates as red and green, to inspect a parameterisation.
#include "materials/textures/common/mapping.h"

namespace exphoton {
namespace {

struct Settings : MappingSettings {};

const ParamTable<Settings>& Parameters() {
  static const ParamTable<Settings> table{MappingParameters()};
  return table;
}

class Uv final : public ColorTexture {
 public:
  explicit Uv(const TextureMapping2D& mapping) : mapping_(mapping) {}

  Spectrum Evaluate(const SurfaceInteraction& si) const override {
    const Point2 st = mapping_.Map(si).st;
    return {st.x - std::floor(st.x), st.y - std::floor(st.y), 0};
  }

 private:
  TextureMapping2D mapping_;
};

std::unique_ptr<ColorTexture> Create(const Settings& settings, const TextureContext& context) {
  return std::make_unique<Uv>(settings.Mapping(context));
}

}  // namespace
}  // namespace exphoton

EXPHOTON_COLOR_TEXTURE("uv", "texture coordinates as red and green")
