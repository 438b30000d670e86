// SPDX-License-Identifier: BSD-2-Clause
// MeasureRegion compares renders of the project's scenes with tests/images/references: means over
// the picture and over 4 x 3 blocks, by the equivalence rule (equivalence.h). The difference
// between a reference's two halves gives its noise. tests/images/references/make.sh makes the
// references.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "core/app/analysis/separation.h"
#include "core/imaging/image.h"
#include "tests/support/test_scene.h"

namespace exphoton {

// Reference is the mean of a reference's two halves. Row by row, it has the variance of R + G + B
// over 3, and the pixels that count. Pixels brighter than ten times the median and their neighbours
// do not count. They show a light or its mirror image, whose value depends on where the few samples
// of a pixel fall, and would hide the light transport under test.
struct Reference {
  Image image;
  std::vector<double> variance;  // ((a - b) / 2)^2
  std::vector<bool> counts;
  study::Reference measured;  // the same for relMSE, noise and bias
  // Samples per pixel of each half. The appearance of bumps and textures depends on the footprint,
  // so compared renders use this footprint.
  std::int64_t footprintSamples = 0;
};
Reference LoadReference(const std::string& name);

// Loads a scene, at the size of the references unless the options name one. "cornell-caustic/path"
// is scenes/cornell-caustic/path.pbrt.
LoadedScene LoadSceneFile(const std::string& variant, LoadOptions options = {});

// RegionResult is the result for the picture or one block, in units of radiance.
struct RegionResult {
  std::string name;
  double truth = 0, mean = 0, halfWidth = 0, pValue = 1;
};

// Measures the means of `pictures` (one per seed) in a region. halfWidth is half the width of the
// 99 % confidence interval of mean - truth: the terms of the seeds (Student) and the reference
// (normal), added in squares. pValue is the probability of a deviation this large without bias.
RegionResult MeasureRegion(const Reference& reference, const std::vector<Image>& pictures,
                           const PixelBounds& region);
std::vector<PixelBounds> Blocks(const Image& image);  // 4 x 3, row by row

// Returns the largest ratio of a counting pixel to the reference near it. The reference value is
// the largest of the pixel and its eight neighbours, plus a tenth of the picture's mean, so that
// black may be grey.
double LargestFirefly(const Reference& reference, const std::vector<Image>& pictures);

// Counts non-finite pixels and negative values.
long long CountNonFinite(const std::vector<Image>& pictures);

// Writes the pictures' mean, the reference and the differences (as exphoton compare computes them)
// to failed-images/NAME* in the working directory. Returns the path of the mean.
std::string WriteFailure(const std::string& name, const Reference& reference,
                         const std::vector<Image>& pictures);

}  // namespace exphoton
