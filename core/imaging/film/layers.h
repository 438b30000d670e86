// SPDX-License-Identifier: BSD-2-Clause
// Layers: what a picture can hold besides its radiance, by the names that pbrt-v4 and tev use, and
// LayerSample: what one camera sample says of them. Filling them is the renderer's and the
// integrator's affair; summing them layer_film.h's.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/math/spectrum.h"
#include "core/math/vec.h"

namespace exphoton {

enum class Layer {
  Albedo,    // hemispherical reflectance and transmittance of the first surface
  Normal,    // its shading normal, turned to the camera, in world space
  Position,  // where it was hit, in world space
  Variance,  // of the pixel's value
  // The light layers: how light left the first surface. They sum to the picture.
  Emission,          // by itself, and what lies behind everything
  Direct,            // by non-specular lobes, straight from a light
  Caustic,           // by non-specular lobes, from a light over specular surfaces only
  Indirect,          // by non-specular lobes, everything else
  Specular,          // by its specular lobes
  Time,              // seconds that the pixel took, of one thread
  Samples,           // camera samples
  PhotonDensity,     // photons of all maps per unit of area at the first surface
  RadianceDistance,  // mean distance from gather hits to the radiance photons they read
};
inline constexpr int kLayerCount = 13;

struct LayerInfo {
  const char* name;                   // "Albedo", as --aov takes it
  std::vector<std::string> channels;  // "Albedo.R" ...
  const char* meaning;
};
const LayerInfo& GetLayerInfo(Layer layer);

class LayerSet {
 public:
  constexpr LayerSet() = default;
  constexpr LayerSet(std::initializer_list<Layer> layers) {
    for (const Layer layer : layers) Add(layer);
  }
  constexpr void Add(Layer layer) { bits_ |= 1u << int(layer); }
  constexpr bool Has(Layer layer) const { return (bits_ >> int(layer) & 1u) != 0; }
  constexpr bool IsEmpty() const { return bits_ == 0; }
  constexpr LayerSet operator|(LayerSet other) const { return LayerSet(bits_ | other.bits_); }
  constexpr LayerSet operator&(LayerSet other) const { return LayerSet(bits_ & other.bits_); }
  constexpr LayerSet Without(LayerSet other) const { return LayerSet(bits_ & ~other.bits_); }
  friend constexpr bool operator==(LayerSet, LayerSet) = default;

  std::vector<Layer> List() const;  // in the order of the enumeration
  std::string Names() const;        // "Albedo, N"

 private:
  constexpr explicit LayerSet(std::uint32_t bits) : bits_(bits) {}
  std::uint32_t bits_ = 0;
};

inline constexpr LayerSet kLightLayers{Layer::Emission, Layer::Direct, Layer::Caustic,
                                       Layer::Indirect, Layer::Specular};
inline constexpr LayerSet kSurfaceLayers{Layer::Albedo, Layer::Normal, Layer::Position};
// What the renderer fills for every integrator.
inline constexpr LayerSet kRendererLayers =
    kSurfaceLayers | LayerSet{Layer::Variance, Layer::Time, Layer::Samples};

// "Albedo,N,direct" or "light" for all light layers; upper and lower case alike, and "Albedo.RGB"
// for "Albedo". nullopt where a name is unknown: it is then in *unknown.
std::optional<LayerSet> ParseLayers(std::string_view list, std::string* unknown);

// What one camera sample says besides its radiance. Light layers as long as they are not sums to be
// weighted: the renderer does that.
struct LayerSample {
  LayerSet wanted;  // those that cost something to know are filled only if asked for

  Spectrum emission, direct, caustic, indirect, specular;
  Spectrum albedo;
  Normal3 n;  // all 0 where the ray escaped
  Point3 p;   // the same
  double photonDensity = 0;
  double radianceDistance = 0;           // summed over
  std::int64_t radiancePhotonsRead = 0;  // so many
};

}  // namespace exphoton
