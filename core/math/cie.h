// SPDX-License-Identifier: BSD-2-Clause
// Linear RGB from CIE XYZ, from spectral samples and from black bodies.
#pragma once

#include <utility>
#include <vector>

#include "core/math/spectrum.h"

namespace exphoton {

struct SpectralSample {
  double wavelength;  // nanometres
  double value;
};

// Components outside the gamut of Rec. 709 come out negative; the caller decides.
Spectrum RgbFromXyz(double x, double y, double z);

// The colour of a spectrum given by samples in rising order of wavelength: linear between them,
// constant beyond them. Normalised so that a spectrum that is 1 everywhere has luminance 1.
Spectrum RgbFromSamples(const std::vector<SpectralSample>& samples);

// The colour of Planck's law at `kelvin` in (0, 1e9], scaled so that the largest value of the
// spectrum over all wavelengths is 1.
Spectrum RgbOfBlackbody(double kelvin);

}  // namespace exphoton
