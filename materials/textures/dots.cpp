// SPDX-License-Identifier: BSD-2-Clause
// The texture "dots" scatters round dots over the plane: about every second unit cell holds one, at
// a random place within the cell.
#include "materials/textures/common/mapping.h"
#include "materials/textures/noise/noise.h"

namespace exphoton {
namespace {

template <class T>
struct Settings : MappingSettings {
  TexturePtr<T> inside = Uniform(T(1)), outside = Uniform(T(0));
};

template <class T>
const ParamTable<Settings<T>>& Parameters() {
  static const ParamTable<Settings<T>> table{
      MappingParameters(), Param("inside", &Settings<T>::inside, "within the dots"),
      Param("outside", &Settings<T>::outside, "between the dots")};
  return table;
}

// Returns whether (s, t) is within a dot. Cells are centred at integer points.
bool IsInDot(double s, double t) {
  constexpr double kRadius = .35, kMaxShift = .5 - kRadius;
  const double cellS = std::floor(s + .5), cellT = std::floor(t + .5);
  if (!(Noise(cellS + .5, cellT + .5) > 0)) return false;
  const double ds = s - cellS - kMaxShift * Noise(cellS + 1.5, cellT + 2.8);
  const double dt = t - cellT - kMaxShift * Noise(cellS + 4.5, cellT + 9.8);
  return ds * ds + dt * dt < kRadius * kRadius;
}

template <class T>
class Dots final : public Texture<T> {
 public:
  Dots(const Settings<T>& settings, const TextureContext& context)
      : mapping_(settings.Mapping(context)),
        inside_(settings.inside),
        outside_(settings.outside),
        constant_(FindConstant()),
        isFiltered_(inside_->IsFiltered() || outside_->IsFiltered()) {}

  T Evaluate(const SurfaceInteraction& si) const override {
    const Point2 st = mapping_.Map(si).st;
    return (IsInDot(double(st.x), double(st.y)) ? inside_ : outside_)->Evaluate(si);
  }
  std::optional<T> ConstantValue() const override { return constant_; }
  bool IsFiltered() const override { return isFiltered_; }

 private:
  std::optional<T> FindConstant() const {
    const auto a = inside_->ConstantValue(), b = outside_->ConstantValue();
    return a == b ? a : std::nullopt;
  }

  TextureMapping2D mapping_;
  TexturePtr<T> inside_, outside_;
  std::optional<T> constant_;
  bool isFiltered_;
};

template <class T>
std::unique_ptr<Texture<T>> Create(const Settings<T>& settings, const TextureContext& context) {
  return std::make_unique<Dots<T>>(settings, context);
}

}  // namespace
}  // namespace exphoton

EXPHOTON_TEXTURE("dots", "round dots at random places")
