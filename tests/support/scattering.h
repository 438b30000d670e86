// SPDX-License-Identifier: BSD-2-Clause
// This file has helpers for tests of scattering: a flat surface, every kind of smooth BSDF lobe,
// ordinary and awkward directions, and integrals over directions.
#pragma once

#include <functional>
#include <memory>
#include <ostream>
#include <string>
#include <vector>

#include "core/app/checks/flat_surface.h"
#include "core/scattering/bsdf.h"

namespace exphoton {

// Returns FlatSurface with a shading normal tilted by `angle` (radians) from z towards x.
SurfaceInteraction TiltedSurface(Real angle);

struct NamedLobe {
  std::string name;
  std::shared_ptr<const Bxdf> lobe;

  friend void PrintTo(const NamedLobe& named, std::ostream* out) { *out << named.name; }
};
// Returns every non-specular BSDF lobe, with coefficients of at most 1, at ordinary and extreme
// roughness.
std::vector<NamedLobe> SmoothLobes();

// Returns the integral of lobe.f |cos wi| over all wi. It is the mean throughput of Sample on a
// stratified grid of side x side.
Spectrum Albedo(const Bxdf& lobe, const Vector3& wo, int side = 64);
// Returns the cosine-weighted mean of Albedo over the upper hemisphere.
Spectrum HemisphericalAlbedo(const Bxdf& lobe, int side = 32);

}  // namespace exphoton
