// SPDX-License-Identifier: BSD-2-Clause
// These functions convert CIE XYZ, spectral samples and black-body temperatures to linear RGB.
#pragma once

#include <utility>
#include <vector>

#include "core/math/spectrum.h"

namespace exphoton {

struct SpectralSample {
  double wavelength;  // nanometres
  double value;
};

// Colours outside the gamut of Rec. 709 have negative components, which the caller must handle.
Spectrum RgbFromXyz(double x, double y, double z);

// Returns the colour of a spectrum. Its samples are in rising order of wavelength; values are
// linear between samples and constant beyond them. A spectrum that is 1 everywhere has luminance 1.
Spectrum RgbFromSamples(const std::vector<SpectralSample>& samples);

// Returns the colour of Planck's law at `kelvin` in (0, 1e9]. The spectrum is scaled so that its
// largest value over all wavelengths is 1.
Spectrum RgbOfBlackbody(double kelvin);

}  // namespace exphoton
