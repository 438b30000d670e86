// SPDX-License-Identifier: BSD-2-Clause
// AgreeInBlocks compares two integrators in a scene: 3 x 3 blocks of the picture, 8 seeds each,
// with Welch's interval for the difference of two means. As with IsWithin, noise never makes a test
// pass.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "tests/support/equivalence.h"
#include "tests/support/test_scene.h"

namespace exphoton {

inline constexpr int kBlocksPerSide = 3;
using BlockEstimates = std::array<SeedEstimate, kBlocksPerSide * kBlocksPerSide>;

inline BlockEstimates EstimateBlocks(const std::string& scene) {
  std::array<std::vector<double>, kBlocksPerSide * kBlocksPerSide> means;
  for (int k = 0; k < kGateSeeds; ++k) {
    TestRenderOptions options;
    options.seed = std::uint64_t(k) * 1000 + 1;
    options.threads = 2;
    const Image image = RenderSceneText(scene, options).image;
    const int w = image.Width() / kBlocksPerSide, h = image.Height() / kBlocksPerSide;
    for (int b = 0; b < int(means.size()); ++b) {
      const int x = b % kBlocksPerSide * w, y = b / kBlocksPerSide * h;
      means[std::size_t(b)].push_back(MeanRadiance(image, {x, y, x + w, y + h}));
    }
  }
  BlockEstimates estimates;
  for (std::size_t b = 0; b < means.size(); ++b) estimates[b] = EstimateFrom(means[b]);
  return estimates;
}

// The tolerance is relative to the mean of the whole picture.
inline testing::AssertionResult AgreeInBlocks(double tolerance, const BlockEstimates& a,
                                              const BlockEstimates& b) {
  double mean = 0;
  for (const SeedEstimate& estimate : b) mean += estimate.mean / double(b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double half = std::hypot(a[i].halfWidth, b[i].halfWidth);
    if (!(std::abs(a[i].mean - b[i].mean) + half <= tolerance * mean))
      return testing::AssertionFailure()
             << "block " << i << ": " << a[i].mean << " and " << b[i].mean << " differ beyond "
             << tolerance * mean << ", with half-width " << half;
  }
  return testing::AssertionSuccess();
}

}  // namespace exphoton
