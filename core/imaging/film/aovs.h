// SPDX-License-Identifier: BSD-2-Clause
// Aov lists the quantities that a picture can hold besides its radiance. Names are written as words
// in lower case ("photonDensity"), except the symbols N, Ng, P and Z. AovSample holds the values of
// one camera sample. The renderer and the integrator fill them; AovFilm (aov_film.h) accumulates
// them.
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
  Albedo,           // hemispherical reflectance and transmittance of the first surface
  Normal,           // its shading normal, turned to the camera, in world space
  GeometricNormal,  // its geometric normal, turned to the camera, in world space
  Position,         // position of the first hit, in world space
  Depth,            // its depth along the view axis (Camera::Depth), in camera units
  TexCoords,        // its texture coordinates
  ObjectId,         // number of its shape or instance in the scene; 0 where nothing was hit
  MaterialId,       // number of its material
  Variance,         // variance of the pixel value
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
  SharingBias,       // estimated error that shared gathers add to the pixel, with its sign
  CryptoObject,      // objects of the pixel's samples and their shares (cryptomatte.h)
  CryptoMaterial,    // the same for materials
};
inline constexpr int kAovCount = 21;

struct AovInfo {
  const char* name;                   // for example "albedo", as in --aov
  std::vector<std::string> channels;  // for example "albedo.R"
  const char* meaning;
  bool isExact = false;  // 16 bits would be too few; EXR files always have 32
};
const AovInfo& GetAovInfo(Aov aov);
// Returns whether this is the name of a channel of an exact AOV, for example "P.X".
bool IsExactChannel(const std::string& channel);

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
  std::string Names() const;      // for example "albedo, N"

 private:
  constexpr explicit AovSet(std::uint32_t bits) : bits_(bits) {}
  std::uint32_t bits_ = 0;
};

inline constexpr AovSet kLightAovs{Aov::Emission, Aov::Direct, Aov::Caustic, Aov::Indirect,
                                   Aov::Specular};
inline constexpr AovSet kCryptomatte{Aov::CryptoObject, Aov::CryptoMaterial};
inline constexpr AovSet kSurfaceAovs =
    kCryptomatte | AovSet{Aov::Albedo, Aov::Normal,    Aov::GeometricNormal, Aov::Position,
                          Aov::Depth,  Aov::TexCoords, Aov::ObjectId,        Aov::MaterialId};
// The AOVs that the renderer fills for every integrator.
inline constexpr AovSet kRendererAovs =
    kSurfaceAovs | AovSet{Aov::Variance, Aov::Time, Aov::Samples};

// Parses a list such as "albedo,N,direct". "light" selects all light AOVs, and "cryptomatte"
// selects objects and materials. Case is ignored, and "albedo.RGB" is the same as "albedo". Returns
// nullopt if a name is unknown and stores that name in *unknown.
std::optional<AovSet> ParseAovs(std::string_view list, std::string* unknown);

// The AOV values of one camera sample. Light AOVs are not yet weighted by the filter; AovFilm does
// this.
struct AovSample {
  AovSet wanted;  // integrators fill costly AOVs only if they are in this set

  Spectrum emission, direct, caustic, indirect, specular;
  Spectrum albedo;
  bool isHit = false;  // whether the ray hit a surface; if not, its data are 0
  Normal3 n, ng;
  Point3 p;
  Real depth = 0;
  Point2 uv;
  std::uint32_t objectId = 0, materialId = 0;
  double photonDensity = 0;
  double radianceDistance = 0;           // sum over the reads
  std::int64_t radiancePhotonsRead = 0;  // number of reads
  // The sample's own part of the light that pixels share after all pixels are rendered. It is not
  // in the sample's radiance, but Variance counts it. Variance is then an upper bound.
  Spectrum ownGathers;
};

}  // namespace exphoton
