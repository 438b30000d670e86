// SPDX-License-Identifier: BSD-2-Clause
// ToneMapping maps linear light to the displayed range [0, 1] for PNG files.
#pragma once

#include "core/imaging/image.h"

namespace exphoton {

enum class ToneCurve {
  Clamp,   // values above 1 are cut
  Filmic,  // rolls off highlights; Narkowicz 2015, "ACES Filmic Tone Mapping Curve"
};

struct ToneMapping {
  float exposure = 0;  // stops: values are multiplied by 2^exposure before the curve
  ToneCurve curve = ToneCurve::Clamp;

  // Maps a linear value to linear displayed light in [0, 1]. NaN and negative values become 0.
  double Apply(double value) const;
};

// Returns the exposure, in hundredths of a stop, that maps the geometric mean of the luminances
// above 0 to 0.18 (Reinhard et al. 2002, "Photographic Tone Reproduction for Digital Images", eq.
// 1 and 2). Returns 0 for a black picture.
float AutoExposure(const Image& image);

// Shares of all pixels after the tone curve: pixels with a channel above 1 before clamping, and
// pixels whose three 8-bit values are 0. Transparent pixels (alpha 0) count as neither.
struct ToneLoss {
  double clipped = 0, black = 0;
};
ToneLoss MeasureToneLoss(const Image& image, const ToneMapping& tone);

}  // namespace exphoton
