// SPDX-License-Identifier: BSD-2-Clause
// These tables hold the hemispherical-hemispherical reflectances of the glossy lobes, by Blinn
// exponent. They were computed by a midpoint rule of 96 x 192 x 96 points (error below 1e-4);
// tests/unit compares them with an independent computation. Row j has exponent 2^j - 1. Values are
// interpolated linearly in log2(exponent + 1).
#pragma once

#include <array>

#include "core/math/real.h"

namespace exphoton {

inline constexpr int kAlbedoRows = 11;

// AlbedoRow is a place between two rows.
struct AlbedoRow {
  std::size_t index;
  Real fraction;  // towards index + 1

  static AlbedoRow Of(Real exponent) {
    const Real x = std::clamp(std::log2(exponent + 1), Real(0), Real(kAlbedoRows - 1));
    const std::size_t index = std::min(std::size_t(x), std::size_t(kAlbedoRows - 2));
    return {index, x - Real(index)};
  }
};

// This table is for the Torrance-Sparrow lobe with F = 1, split by the cosine wo.h. Column i covers
// [i, i+1)/16.
inline constexpr std::array<std::array<float, 16>, kAlbedoRows> kMicrofacetAlbedo{{
    {0.00005f, 0.00077f, 0.00221f, 0.00438f, 0.00723f, 0.01084f, 0.01524f, 0.02052f, 0.02655f,
     0.03370f, 0.04179f, 0.05120f, 0.06193f, 0.07462f, 0.08989f, 0.11132f},
    {0.00008f, 0.00101f, 0.00290f, 0.00567f, 0.00937f, 0.01397f, 0.01955f, 0.02615f, 0.03361f,
     0.04229f, 0.05192f, 0.06282f, 0.07488f, 0.08854f, 0.10417f, 0.12398f},
    {0.00012f, 0.00138f, 0.00394f, 0.00762f, 0.01252f, 0.01854f, 0.02569f, 0.03391f, 0.04305f,
     0.05331f, 0.06427f, 0.07622f, 0.08876f, 0.10212f, 0.11630f, 0.13224f},
    {0.00017f, 0.00191f, 0.00540f, 0.01030f, 0.01675f, 0.02444f, 0.03322f, 0.04296f, 0.05333f,
     0.06435f, 0.07553f, 0.08708f, 0.09844f, 0.10990f, 0.12121f, 0.13258f},
    {0.00025f, 0.00264f, 0.00738f, 0.01380f, 0.02189f, 0.03109f, 0.04102f, 0.05135f, 0.06171f,
     0.07209f, 0.08212f, 0.09201f, 0.10147f, 0.11073f, 0.11967f, 0.12842f},
    {0.00035f, 0.00363f, 0.00996f, 0.01796f, 0.02738f, 0.03723f, 0.04717f, 0.05688f, 0.06611f,
     0.07516f, 0.08374f, 0.09231f, 0.10049f, 0.10874f, 0.11682f, 0.12485f},
    {0.00049f, 0.00498f, 0.01304f, 0.02220f, 0.03192f, 0.04132f, 0.05028f, 0.05889f, 0.06716f,
     0.07524f, 0.08327f, 0.09124f, 0.09917f, 0.10713f, 0.11504f, 0.12298f},
    {0.00069f, 0.00669f, 0.01615f, 0.02541f, 0.03441f, 0.04290f, 0.05104f, 0.05902f, 0.06693f,
     0.07478f, 0.08265f, 0.09055f, 0.09841f, 0.10630f, 0.11417f, 0.12204f},
    {0.00095f, 0.00869f, 0.01846f, 0.02694f, 0.03517f, 0.04311f, 0.05099f, 0.05883f, 0.06666f,
     0.07450f, 0.08235f, 0.09020f, 0.09802f, 0.10590f, 0.11372f, 0.12157f},
    {0.00127f, 0.01063f, 0.01942f, 0.02733f, 0.03524f, 0.04302f, 0.05091f, 0.05871f, 0.06654f,
     0.07436f, 0.08218f, 0.09003f, 0.09785f, 0.10568f, 0.11350f, 0.12133f},
    {0.00163f, 0.01206f, 0.01951f, 0.02737f, 0.03518f, 0.04299f, 0.05085f, 0.05864f, 0.06648f,
     0.07429f, 0.08212f, 0.08994f, 0.09774f, 0.10557f, 0.11339f, 0.12121f},
}};

// This table is for the gloss of Ashikhmin and Shirley. The columns are for Schlick's terms 1 and
// (1 - wo.h)^5.
inline constexpr std::array<std::array<float, 2>, kAlbedoRows> kFresnelBlendAlbedo{{
    {0.42907f, 0.00611f},
    {0.49999f, 0.00771f},
    {0.58336f, 0.01007f},
    {0.66791f, 0.01325f},
    {0.74431f, 0.01719f},
    {0.80803f, 0.02168f},
    {0.85843f, 0.02631f},
    {0.89692f, 0.03071f},
    {0.92562f, 0.03458f},
    {0.94669f, 0.03780f},
    {0.96201f, 0.04037f},
}};

}  // namespace exphoton
