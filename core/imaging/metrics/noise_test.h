// SPDX-License-Identifier: BSD-2-Clause
// TestAgainstNoise decides whether two rendered pictures differ by more than their noise. It tests
// the mean of each channel over the picture and over blocks of 32 x 32 pixels by Student's t, with
// the Sidak correction for the number of tests (Welch 1947; Sidak 1967). The noise comes from the
// pictures themselves. Derivation and measurements: docs/decisions/0038-comparisons-know-noise.md.
#pragma once

#include <span>
#include <string>

#include "core/imaging/image.h"

namespace exphoton {

enum class NoiseSource {
  None,        // unknown: see NoiseTest::reason
  Halves,      // differences of the layers half1 and half2, cell by cell
  Replicates,  // independent pictures: halves, or at least three references
  Variance,    // the layer variance
};

struct NoiseTestOptions {
  double significance = .01;  // probability that pictures that differ by noise alone fail
  // Whether pixels share noise, as photon maps make them do. The noise of a block then says little
  // about the noise of the picture's mean, so only independent pictures can measure it.
  bool sharesNoise = true;
};

// The test with the smallest p-value of its kind.
struct NoiseFinding {
  std::string channel;            // "R", "G" or "B"
  PixelBounds part;               // relative to the data window
  double relativeDifference = 0;  // (picture - reference) / reference, of the means
  double p = 1;                   // probability of a difference at least as large from noise alone
};

struct NoiseTest {
  NoiseSource source = NoiseSource::None;
  std::string reason;    // for None: the missing data
  int count = 0;         // of tests
  double threshold = 0;  // each test fails below this p-value (Sidak)
  NoiseFinding mean, block;

  bool Differs() const { return mean.p < threshold || block.p < threshold; }
};

// The references show the same scene by independent seeds. Pixels that are not finite in any
// picture are left out. Throws ImageError if sizes differ or a channel is missing.
NoiseTest TestAgainstNoise(std::span<const Image> references, const Image& picture,
                           const NoiseTestOptions& options);

// Returns the probability that |t| is at least this large, for Student's distribution.
double StudentTail(double t, double degreesOfFreedom);

}  // namespace exphoton
