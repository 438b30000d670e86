// SPDX-License-Identifier: BSD-2-Clause
// The diffuse reflectance of translucent media, for materials that replace subsurface scattering.
// Light leaves the surface where it enters. Source: Jensen, Marschner, Levoy and Hanrahan 2001, "A
// practical model for subsurface light transport".
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace exphoton {

// The coefficients of a medium for red, green and blue, in 1 / length. Only their ratios matter
// here, so the unit of length is free. Negative ones count as 0.
struct SubsurfaceCoefficients {
  std::array<double, 3> absorption{}, reducedScattering{};
};

// Returns the coefficients in 1/mm of one of the media that the paper measured, such as "Skin1".
// Returns nullopt for other names.
std::optional<SubsurfaceCoefficients> MeasuredCoefficients(const std::string& medium);
std::vector<std::string> MeasuredMedia();
// The medium of a material that states neither a medium nor coefficients.
inline constexpr const char* kDefaultMedium = "Wholemilk";

// Returns the share of diffuse light in a medium that its smooth boundary reflects back. `eta` is
// the index of refraction relative to the outside, at least 1. Source: the fit of Egan and Hilgeman
// 1973.
double InternalReflectance(double eta);

// Returns the share of the light in the medium that leaves its plane surface again, for red, green
// and blue, by the dipole model. `eta` is the index of refraction relative to the outside. It is
// clamped to [1, 3], where the fit of the internal reflection holds.
std::array<double, 3> DipoleReflectance(const SubsurfaceCoefficients& medium, double eta);

}  // namespace exphoton
