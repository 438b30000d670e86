// SPDX-License-Identifier: BSD-2-Clause
// PartMeans holds the means of a small picture and of its light AOVs, a value for each seed.
// CompareParts compares two of them.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "tests/random/scenes/agreement.h"
#include "tests/random/scenes/scene_text.h"
#include "tests/random/scenes/statistics.h"

namespace exphoton::random_scenes {

inline constexpr int kPartSeeds = 6;
enum Part { kPicture, kEmission, kDirect, kCaustic, kIndirect, kSpecular };
inline constexpr std::array<const char*, 6> kParts{"R",         "emission.R", "direct.R",
                                                   "caustic.R", "indirect.R", "specular.R"};
using PartMeans = std::array<std::vector<double>, kParts.size()>;

// Returns the options of a picture of 8 x 6 pixels. `factor` and `photonFactor` multiply the
// numbers of samples and of photons.
TextOptions SmallPicture(const std::string& integrator, int factor, int photonFactor);
std::string SmallSceneText(const SceneModel& scene, const std::string& integrator, int factor,
                           int photonFactor);

PartMeans MeansOf(const std::string& text, std::uint64_t firstSeed, int seeds = kPartSeeds);

// Differences up to these are allowed, relative to a part of the light and to the picture.
struct Margins {
  double ofPart = 0, ofPicture = 0;
};

// Compares the means of each part but emission. With equal seeds the differences have less noise
// than the means.
std::vector<Comparison> CompareParts(const std::string& what, const PartMeans& a,
                                     const PartMeans& b, const Margins& margins,
                                     bool hasEqualSeeds);

// Returns "mean +- standard error against mean +- standard error".
std::string TextOf(const Sample& a, const Sample& b);

}  // namespace exphoton::random_scenes
