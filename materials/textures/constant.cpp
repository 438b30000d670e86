// SPDX-License-Identifier: BSD-2-Clause
// The texture "constant" has one value everywhere.
#include "materials/textures/common/mapping.h"

namespace exphoton {
namespace {

template <class T>
struct Settings {
  T value = T(1);
};

template <class T>
const ParamTable<Settings<T>>& Parameters() {
  static const ParamTable<Settings<T>> table{Param("value", &Settings<T>::value, "the value")};
  return table;
}

template <class T>
std::unique_ptr<Texture<T>> Create(const Settings<T>& settings, const TextureContext&) {
  return std::make_unique<UniformTexture<T>>(settings.value);
}

}  // namespace
}  // namespace exphoton

EXPHOTON_TEXTURE("constant", "one value everywhere")
