// SPDX-License-Identifier: BSD-2-Clause
// Gradient noise in space, and the two sums of it that textures use. Sources: Perlin 2002,
// "Improving Noise"; Ebert et al. 2003, "Texturing and Modeling", chapter 2 (octaves limited by
// the pixel footprint).
#pragma once

#include "core/scattering/texture_mapping.h"

namespace exphoton {

// Returns noise in [-1, 1]. It is 0 at integer points, has continuous second derivatives, and
// repeats every 256 units.
double Noise(double x, double y = .5, double z = .5);

struct FractalNoise {
  int octaves = 8;        // at most
  double roughness = .5;  // ratio of the amplitudes of an octave and the one before
};

// Returns the sum of octaves of noise at `at`, with amplitudes 1, roughness, roughness^2, ... and
// frequencies 1, 1.99, 1.99^2, ... Octaves finer than the pixel footprint are left out. The last
// one fades in.
double FbmAt(const TexturePoint3& at, const FractalNoise& noise);
// Does the same with the absolute value of the noise ("turbulence").
double TurbulenceAt(const TexturePoint3& at, const FractalNoise& noise);

// Returns the point and its footprint, both multiplied by `factor`.
TexturePoint3 Scaled(const TexturePoint3& at, Real factor);

}  // namespace exphoton
