// SPDX-License-Identifier: BSD-2-Clause
// DimOutliers finds pixels of one half that are far brighter than all similar pixels of the other
// half. Such light is real, but the picture has too few samples to show where it falls: a filter
// that averages the pixels of a window spreads it over this window, which is then a bright square.
#pragma once

#include "core/base/parallel.h"
#include "core/imaging/denoise/denoise_layers.h"

namespace exphoton {

struct Outliers {
  long long pixels = 0;  // of both halves
  double light = 0;      // the part of the picture's light that they lose; at most 1
};

// Lowers each channel of an outlier to kMostBrightness (outliers.cpp) times the brightest similar
// pixel of the other half, and estimates the variance again. A pixel with few similar pixels stays
// as it is, because these say little. The result does not depend on the number of threads.
Outliers DimOutliers(DenoiseLayers* layers, ThreadPool& threads);

}  // namespace exphoton
