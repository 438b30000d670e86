// SPDX-License-Identifier: BSD-2-Clause
// Aov lists the quantities that a picture can hold besides its radiance. The names are those of
// pbrt-v4 and tev. AovSample holds the values of one camera sample. The renderer and the integrator
// fill them; AovFilm (aov_film.h) accumulates them.
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
  Position,  // position of the first hit, in world space
  Variance,  // variance of the pixel value
  // The light AOVs divide the light that leaves the first surface. They sum to the picture.
  Emission,          // emitted by the first surface, and the background
  Direct,            // scattered by non-specular lobes, directly from a light
  Caustic,           // by non-specular lobes, from a light over specular surfaces only
  Indirect,          // by non-specular lobes, all other light
  Specular,          // by the specular lobes
  Time,              // milliseconds that the pixel took, on one thread
  Samples,           // camera samples
  PhotonDensity,     // photons of all maps per unit area at the first surface
  RadianceDistance,  // mean distance from gather hits to the radiance photons they read
};
inline constexpr int kAovCount = 13;

struct AovInfo {
  const char* name;                   // for example "Albedo", as in --aov
  std::vector<std::string> channels;  // for example "Albedo.R"
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
  std::string Names() const;      // for example "Albedo, N"

 private:
  constexpr explicit AovSet(std::uint32_t bits) : bits_(bits) {}
  std::uint32_t bits_ = 0;
};

inline constexpr AovSet kLightAovs{Aov::Emission, Aov::Direct, Aov::Caustic, Aov::Indirect,
                                   Aov::Specular};
inline constexpr AovSet kSurfaceAovs{Aov::Albedo, Aov::Normal, Aov::Position};
// The AOVs that the renderer fills for every integrator.
inline constexpr AovSet kRendererAovs =
    kSurfaceAovs | AovSet{Aov::Variance, Aov::Time, Aov::Samples};

// Parses a list such as "Albedo,N,direct". "light" selects all light AOVs. Case is ignored, and
// "Albedo.RGB" is the same as "Albedo". Returns nullopt if a name is unknown and stores that name
// in *unknown.
std::optional<AovSet> ParseAovs(std::string_view list, std::string* unknown);

// The AOV values of one camera sample. Light AOVs are not yet weighted by the filter; AovFilm does
// this.
struct AovSample {
  AovSet wanted;  // integrators fill costly AOVs only if they are in this set

  Spectrum emission, direct, caustic, indirect, specular;
  Spectrum albedo;
  Normal3 n;  // 0 if the ray escaped
  Point3 p;   // 0 if the ray escaped
  double photonDensity = 0;
  double radianceDistance = 0;           // sum over the reads
  std::int64_t radiancePhotonsRead = 0;  // number of reads
};

}  // namespace exphoton
