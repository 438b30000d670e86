// SPDX-License-Identifier: BSD-2-Clause
// The texture "checkerboard" alternates two textures in unit cells, in the plane or in space. It is
// filtered by the exact mean over a box, or by a few weighted samples of the pixel.
#include "materials/textures/common/mapping.h"

namespace exphoton {
namespace {

enum class Filtering { None, Supersample, ClosedForm };

template <class T>
struct Settings : MappingSettings {
  int dimension = 2;
  TexturePtr<T> tex1 = Uniform(T(1)), tex2 = Uniform(T(0));
  Filtering aaMode = Filtering::ClosedForm;
};

template <class T>
const ParamTable<Settings<T>>& Parameters() {
  static const ParamTable<Settings<T>> table{
      MappingParameters(),
      Param("dimension", &Settings<T>::dimension, "2: squares, 3: cubes of texture space")
          .Range(2, 3),
      Param("tex1", &Settings<T>::tex1, "in cells whose coordinates have an even sum"),
      Param("tex2", &Settings<T>::tex2, "in the other cells"),
      Param("aamode", &Settings<T>::aaMode, "filtering: exact over a box, 16 samples, or none")
          .OneOf({{"closedform", Filtering::ClosedForm},
                  {"supersample", Filtering::Supersample},
                  {"none", Filtering::None}})};
  return table;
}

// Returns 1 if floor(x) is odd, else 0.
double Parity(double x) {
  const double half = std::floor(x) / 2;
  return half == std::floor(half) ? 0 : 1;
}

// Returns the share of [x - radius, x + radius] where floor is odd. The integral of Parity from 0
// to x is 1 per whole pair of cells, plus the part of the last pair that lies in its odd cell.
double OddShare(double x, double radius) {
  if (!(x + radius > x - radius)) return Parity(x);
  const auto integral = [](double t) {
    const double pairs = std::floor(t / 2);
    return pairs + std::max(t - 2 * pairs - 1, 0.0);
  };
  return std::clamp((integral(x + radius) - integral(x - radius)) / (2 * radius), 0.0, 1.0);
}

// Place is a position in up to three coordinates, with its changes along a pixel's x and y.
struct Place {
  std::array<double, 3> x{}, dx{}, dy{};
  int dimension;
};

double OddByBox(const Place& place) {
  double even = 1;  // even share minus odd share: a product over the axes
  for (std::size_t i = 0; i < std::size_t(place.dimension); ++i) {
    const double radius = std::max(std::abs(place.dx[i]), std::abs(place.dy[i]));
    even *= 1 - 2 * OddShare(place.x[i], radius);
  }
  return (1 - even) / 2;
}

double OddAt(const Place& place, double stepX, double stepY) {
  double sum = 0;
  for (std::size_t i = 0; i < std::size_t(place.dimension); ++i)
    sum += Parity(place.x[i] + stepX * place.dx[i] + stepY * place.dy[i]);
  return Parity(sum);
}

// Averages 4 x 4 points of a square two pixels wide, with Gaussian weights.
double OddBySamples(const Place& place) {
  constexpr int kSide = 4;
  double sum = 0, weights = 0;
  for (int j = 0; j < kSide; ++j) {
    for (int i = 0; i < kSide; ++i) {
      const double x = (i + .5) * 2 / kSide - 1, y = (j + .5) * 2 / kSide - 1;
      const double weight = std::exp(-2 * (x * x + y * y));
      sum += weight * OddAt(place, x, y);
      weights += weight;
    }
  }
  return sum / weights;
}

template <class T>
class Checkerboard final : public Texture<T> {
 public:
  Checkerboard(const Settings<T>& s, const TextureContext& context)
      : dimension_(s.dimension),
        filtering_(s.aaMode),
        mapping2_(s.Mapping(context)),
        mapping3_(context.textureToWorld),
        tex1_(s.tex1),
        tex2_(s.tex2),
        constant_(FindConstant()),
        isFiltered_(filtering_ != Filtering::None || tex1_->IsFiltered() || tex2_->IsFiltered()) {}

  T Evaluate(const SurfaceInteraction& si) const override {
    const Real odd = OddPart(si);
    if (odd == 0) return tex1_->Evaluate(si);
    if (odd == 1) return tex2_->Evaluate(si);
    return Lerp(odd, tex1_->Evaluate(si), tex2_->Evaluate(si));
  }
  std::optional<T> ConstantValue() const override { return constant_; }
  bool IsFiltered() const override { return isFiltered_; }

 private:
  std::optional<T> FindConstant() const {
    const auto a = tex1_->ConstantValue(), b = tex2_->ConstantValue();
    return a == b ? a : std::nullopt;
  }
  Real OddPart(const SurfaceInteraction& si) const {
    const Place place = LocationOf(si);
    switch (filtering_) {
      case Filtering::ClosedForm:
        return Real(OddByBox(place));
      case Filtering::Supersample:
        return Real(OddBySamples(place));
      case Filtering::None:
        break;
    }
    return Real(OddAt(place, 0, 0));
  }
  Place LocationOf(const SurfaceInteraction& si) const {
    if (dimension_ == 3) {
      const TexturePoint3 at = mapping3_.Map(si);
      return {{at.p.x, at.p.y, at.p.z},
              {at.dpdx.x, at.dpdx.y, at.dpdx.z},
              {at.dpdy.x, at.dpdy.y, at.dpdy.z},
              3};
    }
    const TexturePoint2 at = mapping2_.Map(si);
    return {{at.st.x, at.st.y}, {at.dstdx.x, at.dstdx.y}, {at.dstdy.x, at.dstdy.y}, 2};
  }

  int dimension_;
  Filtering filtering_;
  TextureMapping2D mapping2_;
  TextureMapping3D mapping3_;
  TexturePtr<T> tex1_, tex2_;
  // Cached, because querying the inner textures doubles the work at every level of a graph.
  std::optional<T> constant_;
  bool isFiltered_;
};

template <class T>
std::unique_ptr<Texture<T>> Create(const Settings<T>& settings, const TextureContext& context) {
  return std::make_unique<Checkerboard<T>>(settings, context);
}

}  // namespace
}  // namespace exphoton

EXPHOTON_TEXTURE("checkerboard", "alternating cells of two textures")
