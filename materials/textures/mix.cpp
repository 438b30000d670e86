// SPDX-License-Identifier: BSD-2-Clause
// The texture "mix" blends two textures by the value of a third.
#include "materials/textures/common/mapping.h"

namespace exphoton {
namespace {

template <class T>
struct Settings {
  TexturePtr<T> tex1 = Uniform(T(0)), tex2 = Uniform(T(1));
  TexturePtr<Real> amount = Uniform(Real(.5));
};

template <class T>
const ParamTable<Settings<T>>& Parameters() {
  static const ParamTable<Settings<T>> table{
      Param("tex1", &Settings<T>::tex1, "where amount is 0"),
      Param("tex2", &Settings<T>::tex2, "where amount is 1"),
      Param("amount", &Settings<T>::amount, "share of tex2")};
  return table;
}

template <class T>
class Mix final : public Texture<T> {
 public:
  explicit Mix(const Settings<T>& s)
      : tex1_(s.tex1),
        tex2_(s.tex2),
        amount_(s.amount),
        constant_(FindConstant()),
        isFiltered_(tex1_->IsFiltered() || tex2_->IsFiltered() || amount_->IsFiltered()) {}

  T Evaluate(const SurfaceInteraction& si) const override {
    return Lerp(amount_->Evaluate(si), tex1_->Evaluate(si), tex2_->Evaluate(si));
  }
  std::optional<T> ConstantValue() const override { return constant_; }
  bool IsFiltered() const override { return isFiltered_; }

 private:
  std::optional<T> FindConstant() const {
    const auto a = tex1_->ConstantValue(), b = tex2_->ConstantValue();
    const auto amount = amount_->ConstantValue();
    if (amount == Real(0)) return a;
    if (amount == Real(1)) return b;
    if (!a || !b) return std::nullopt;
    if (*a == *b) return a;
    if (!amount) return std::nullopt;
    return Lerp(*amount, *a, *b);
  }

  TexturePtr<T> tex1_, tex2_;
  TexturePtr<Real> amount_;
  // Cached, because querying the inner textures doubles the work at every level of a graph.
  std::optional<T> constant_;
  bool isFiltered_;
};

template <class T>
std::unique_ptr<Texture<T>> Create(const Settings<T>& settings, const TextureContext&) {
  return std::make_unique<Mix<T>>(settings);
}

}  // namespace
}  // namespace exphoton

EXPHOTON_TEXTURE("mix", "blend of two textures by a third")
