// SPDX-License-Identifier: BSD-2-Clause
// The texture "scale" is the product of two textures.
#include "materials/textures/common/mapping.h"

namespace exphoton {
namespace {

template <class T>
struct Settings {
  TexturePtr<T> tex1 = Uniform(T(1)), tex2 = Uniform(T(1));
};

template <class T>
const ParamTable<Settings<T>>& Parameters() {
  static const ParamTable<Settings<T>> table{Param("tex1", &Settings<T>::tex1, "one factor"),
                                             Param("tex2", &Settings<T>::tex2, "the other factor")};
  return table;
}

template <class T>
class Scale final : public Texture<T> {
 public:
  explicit Scale(const Settings<T>& s)
      : tex1_(s.tex1),
        tex2_(s.tex2),
        constant_(FindConstant()),
        isFiltered_(tex1_->IsFiltered() || tex2_->IsFiltered()) {}

  T Evaluate(const SurfaceInteraction& si) const override {
    return tex1_->Evaluate(si) * tex2_->Evaluate(si);
  }
  std::optional<T> ConstantValue() const override { return constant_; }
  bool IsFiltered() const override { return isFiltered_; }

 private:
  std::optional<T> FindConstant() const {
    if (tex1_->IsProvablyZero() || tex2_->IsProvablyZero()) return T{};
    const auto a = tex1_->ConstantValue(), b = tex2_->ConstantValue();
    if (!a || !b) return std::nullopt;
    return *a * *b;
  }

  TexturePtr<T> tex1_, tex2_;
  // Cached, because querying the inner textures doubles the work at every level of a graph.
  std::optional<T> constant_;
  bool isFiltered_;
};

template <class T>
std::unique_ptr<Texture<T>> Create(const Settings<T>& settings, const TextureContext&) {
  return std::make_unique<Scale<T>>(settings);
}

}  // namespace
}  // namespace exphoton

EXPHOTON_TEXTURE("scale", "product of two textures")
