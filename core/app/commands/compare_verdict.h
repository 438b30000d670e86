// SPDX-License-Identifier: BSD-2-Clause
// A verdict says whether a picture passes a comparison, and which limit it broke.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>

#include "core/imaging/metrics/metrics.h"
#include "core/imaging/metrics/noise_test.h"

namespace exphoton::cli {

struct CompareLimits {
  double maxRelMse = -1, maxMean = -1;  // < 0: no bound
  double significance = .01;            // of the noise test
  bool requiresNoiseTest = false;       // --z-test

  bool IsBounded() const { return maxRelMse >= 0 || maxMean >= 0; }
};

struct Comparison {
  std::string name;
  bool isIdentical = false;
  ImageDifference difference;
  std::array<double, 3> relativeMeans{};  // (picture - reference) / reference, of R, G, B
  double flip = 0;
  std::optional<NoiseTest> noise;  // absent if no noise test applies
};

// Tests the picture against noise if --z-test asks for it, or if there are no other limits. Throws
// ImageError if --z-test asks for it and the noise is unknown.
std::optional<NoiseTest> TestNoise(std::span<const Image> references, const Image& picture,
                                   const std::string& name, const CompareLimits& limits);

struct Verdict {
  bool isPass = false;
  std::string text;  // "FAIL: mean of G -1.0 % > 1 %"
};
Verdict Judge(const Comparison& comparison, const CompareLimits& limits);

// Returns one line on the noise test for the table; "" without one.
std::string NoiseText(const Comparison& comparison);

}  // namespace exphoton::cli
