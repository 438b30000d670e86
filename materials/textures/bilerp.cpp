// SPDX-License-Identifier: BSD-2-Clause
// The texture "bilerp" interpolates bilinearly between four values at the corners of the unit
// square, and extrapolates beyond them.
#include "materials/textures/common/mapping.h"

namespace exphoton {
namespace {

template <class T>
struct Settings : MappingSettings {
  T v00 = T(0), v01 = T(1), v10 = T(0), v11 = T(1);
};

template <class T>
const ParamTable<Settings<T>>& Parameters() {
  static const ParamTable<Settings<T>> table{
      MappingParameters(), Param("v00", &Settings<T>::v00, "value at s = 0, t = 0"),
      Param("v01", &Settings<T>::v01, "value at s = 0, t = 1"),
      Param("v10", &Settings<T>::v10, "value at s = 1, t = 0"),
      Param("v11", &Settings<T>::v11, "value at s = 1, t = 1")};
  return table;
}

template <class T>
class Bilerp final : public Texture<T> {
 public:
  Bilerp(const Settings<T>& s, const TextureContext& context)
      : mapping_(s.Mapping(context)), v00_(s.v00), v01_(s.v01), v10_(s.v10), v11_(s.v11) {}

  T Evaluate(const SurfaceInteraction& si) const override {
    const Point2 st = mapping_.Map(si).st;
    return Lerp(st.x, Lerp(st.y, v00_, v01_), Lerp(st.y, v10_, v11_));
  }
  std::optional<T> ConstantValue() const override {
    if (v00_ == v01_ && v00_ == v10_ && v00_ == v11_) return v00_;
    return std::nullopt;
  }

 private:
  TextureMapping2D mapping_;
  T v00_, v01_, v10_, v11_;
};

template <class T>
std::unique_ptr<Texture<T>> Create(const Settings<T>& settings, const TextureContext& context) {
  return std::make_unique<Bilerp<T>>(settings, context);
}

}  // namespace
}  // namespace exphoton

EXPHOTON_TEXTURE("bilerp", "bilinear between four corner values")
