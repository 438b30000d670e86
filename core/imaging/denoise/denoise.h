// SPDX-License-Identifier: BSD-2-Clause
// Denoise filters a picture that was rendered as two independent halves. It averages similar pixels
// of a window: non-local means with the pixels' variance (Rousselle, Knaus and Zwicker 2012),
// guided by noise-free layers of the first surface (Rousselle, Manzi and Zwicker 2013). The weights
// of each half come from the other half, so a bright outlier does not choose its own weight. Light
// that one half alone has found would become a bright square of the window, and is dimmed before.
#pragma once

#include <string>
#include <vector>

#include "core/base/parallel.h"
#include "core/imaging/denoise/outliers.h"
#include "core/imaging/image.h"

namespace exphoton {

// Returns the names of the layers that denoising needs and the picture lacks: "half1", "albedo" ...
std::vector<std::string> MissingDenoiseLayers(const Image& picture);

struct DenoiseResult {
  Image picture;             // without the layers of halves and variance; all others are kept
  double noise = 0;          // noise part of relMSE of the picture, from its halves
  double residualNoise = 0;  // the same for the filtered halves; contains no bias
  Outliers outliers;         // which were dimmed before
  long long nonFinite = 0;   // pixels that are not finite and stay as they are
};

// Throws ImageError if the picture has no channels R, G, B. Its layers must not be missing. The
// result does not depend on the number of threads.
DenoiseResult Denoise(const Image& picture, ThreadPool& threads);

}  // namespace exphoton
