// SPDX-License-Identifier: BSD-2-Clause
// Renders of our scenes against the pictures of tests/images/references: means over the picture and
// over 4 x 3 blocks by the equivalence rule (equivalence.h), with the noise of the reference taken
// from the difference of its two halves. Makes no references: tests/images/references/make.sh does.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "core/app/analysis/separation.h"
#include "core/imaging/image.h"
#include "tests/support/test_scene.h"

namespace exphoton {

// The mean of a reference's two halves; row by row, the variance of R + G + B over 3, and which
// pixels count. Those brighter than ten times the median, and their neighbours, do not: they show a
// lamp or its mirror image, which is a matter of where the pixel's few samples fall, and would
// drown the light that integrators are about.
struct Reference {
  Image image;
  std::vector<double> variance;  // ((a - b) / 2)^2
  std::vector<bool> counts;
  study::Reference measured;  // the same for relMSE, noise and bias
  // Samples a pixel of each half. Bumps and textures look different over another footprint, so
  // renders that are compared take this one.
  std::int64_t footprintSamples = 0;
};
Reference LoadReference(const std::string& name);

// "cornell-caustic/path": scenes/cornell-caustic/path.pbrt at the references' size.
LoadedScene LoadSceneFile(const std::string& variant, LoadOptions options = {});

// What one region (the picture or a block) says, all in units of radiance.
struct RegionResult {
  std::string name;
  double truth = 0, mean = 0, halfWidth = 0, pValue = 1;
};

// Means of `pictures` (one a seed) in a region. halfWidth is that of the 99 % confidence interval
// of mean - truth: the seeds' (Student) and the reference's (normal) added in squares. pValue: how
// often seeds would stray as far without any bias.
RegionResult MeasureRegion(const Reference& reference, const std::vector<Image>& pictures,
                           const PixelBounds& region);
std::vector<PixelBounds> Blocks(const Image& image);  // 4 x 3, row by row

// The largest pixel that counts of all pictures, each divided by the largest reference among it and
// its eight neighbours plus a tenth of the picture's mean (so that black may be grey).
double LargestFirefly(const Reference& reference, const std::vector<Image>& pictures);

// Pixels, and negative values.
long long CountNonFinite(const std::vector<Image>& pictures);

// Writes the pictures' mean, the reference and the differences (of exphoton compare) to
// failed-images/NAME* in the working directory; returns the path of the first.
std::string WriteFailure(const std::string& name, const Reference& reference,
                         const std::vector<Image>& pictures);

}  // namespace exphoton
