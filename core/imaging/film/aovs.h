// SPDX-License-Identifier: BSD-2-Clause
// Aovs: what a picture can hold besides its radiance, by the names that pbrt-v4 and tev use, and
// AovSample: what one camera sample says of them. Filling them is the renderer's and the
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

enum class Aov {
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
inline constexpr int kAovCount = 13;

struct AovInfo {
  const char* name;                   // "Albedo", as --aov takes it
  std::vector<std::string> channels;  // "Albedo.R" ...
  const char* meaning;
};
const AovInfo& GetAovInfo(Aov aov);

class AovSet {
 public:
  constexpr AovSet() = default;
  constexpr AovSet(std::initializer_list<Aov> aovs) {
    for (const Aov aov : aovs) Add(aov);
  }
  constexpr void Add(Aov aov) { bits_ |= 1u << int(aov); }
  constexpr bool Has(Aov aov) const { return (bits_ >> int(aov) & 1u) != 0; }
  constexpr bool IsEmpty() const { return bits_ == 0; }
  constexpr AovSet operator|(AovSet other) const { return AovSet(bits_ | other.bits_); }
  constexpr AovSet operator&(AovSet other) const { return AovSet(bits_ & other.bits_); }
  constexpr AovSet Without(AovSet other) const { return AovSet(bits_ & ~other.bits_); }
  friend constexpr bool operator==(AovSet, AovSet) = default;

  std::vector<Aov> List() const;  // in the order of the enumeration
  std::string Names() const;      // "Albedo, N"

 private:
  constexpr explicit AovSet(std::uint32_t bits) : bits_(bits) {}
  std::uint32_t bits_ = 0;
};

inline constexpr AovSet kLightAovs{Aov::Emission, Aov::Direct, Aov::Caustic, Aov::Indirect,
                                   Aov::Specular};
inline constexpr AovSet kSurfaceLayers{Aov::Albedo, Aov::Normal, Aov::Position};
// What the renderer fills for every integrator.
inline constexpr AovSet kRendererLayers =
    kSurfaceLayers | AovSet{Aov::Variance, Aov::Time, Aov::Samples};

// "Albedo,N,direct" or "light" for all light layers; upper and lower case alike, and "Albedo.RGB"
// for "Albedo". nullopt where a name is unknown: it is then in *unknown.
std::optional<AovSet> ParseLayers(std::string_view list, std::string* unknown);

// What one camera sample says besides its radiance. Light layers as long as they are not sums to be
// weighted: the renderer does that.
struct AovSample {
  AovSet wanted;  // those that cost something to know are filled only if asked for

  Spectrum emission, direct, caustic, indirect, specular;
  Spectrum albedo;
  Normal3 n;  // all 0 where the ray escaped
  Point3 p;   // the same
  double photonDensity = 0;
  double radianceDistance = 0;           // summed over
  std::int64_t radiancePhotonsRead = 0;  // so many
};

}  // namespace exphoton
