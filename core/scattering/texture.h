// SPDX-License-Identifier: BSD-2-Clause
// Texture is a value that varies over a surface; T is Real ("float") or Spectrum ("color").
#pragma once

#include <memory>
#include <optional>

#include "core/geometry/interaction.h"
#include "core/math/spectrum.h"

namespace exphoton {

template <class T>
class Texture {
 public:
  virtual ~Texture() = default;
  virtual T Evaluate(const SurfaceInteraction& si) const = 0;
  // Returns the value if it is the same everywhere and known while loading.
  virtual std::optional<T> ConstantValue() const { return std::nullopt; }
  // Returns whether every value is provably 0. This is false for a texture that is not constant.
  bool IsProvablyZero() const { return ConstantValue() == T{}; }
  // Returns whether Evaluate uses the footprint (dudx ... or dpdx).
  virtual bool IsFiltered() const { return false; }
};

using FloatTexture = Texture<Real>;
using ColorTexture = Texture<Spectrum>;
template <class T>
using TexturePtr = std::shared_ptr<const Texture<T>>;

// UniformTexture has one value everywhere. A plain parameter value becomes a UniformTexture.
template <class T>
class UniformTexture final : public Texture<T> {
 public:
  explicit UniformTexture(const T& value) : value_(value) {}
  T Evaluate(const SurfaceInteraction&) const override { return value_; }
  std::optional<T> ConstantValue() const override { return value_; }

 private:
  T value_;
};
TexturePtr<Real> Uniform(Real value);
TexturePtr<Spectrum> Uniform(const Spectrum& value);

}  // namespace exphoton
