// SPDX-License-Identifier: BSD-2-Clause
// MeansOf renders a scene with each seed. Its pictures have few pixels and samples.
#include "tests/random/variations/parts.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "tests/support/test_scene.h"

namespace exphoton::random_scenes {

TextOptions SmallPicture(const std::string& integrator, int factor, int photonFactor) {
  constexpr int kSamples = 4;
  TextOptions options;
  options.integrator = integrator;
  options.samples = kSamples * factor;
  options.photons = 500 * photonFactor, options.maxPhotonPaths = 10000 * photonFactor;
  options.gatherRays = 6;
  options.width = 8, options.height = 6;
  return options;
}

std::string SmallSceneText(const SceneModel& scene, const std::string& integrator, int factor,
                           int photonFactor) {
  return SceneText(scene, SmallPicture(integrator, factor, photonFactor));
}

PartMeans MeansOf(const std::string& text, std::uint64_t firstSeed, int seeds) {
  PartMeans means;
  for (int k = 0; k < seeds; ++k) {
    TestRenderOptions options;
    options.seed = firstSeed + std::uint64_t(k) * 1000;
    options.footprintSamples = 1 << 20;
    for (const Aov aov : {Aov::Emission, Aov::Direct, Aov::Caustic, Aov::Indirect, Aov::Specular})
      options.aovs.Add(aov);
    const Image image = RenderSceneText(text, options).image;
    for (std::size_t i = 0; i < kParts.size(); ++i)
      means[i].push_back(MeanChannel(image, kParts[i]));
  }
  return means;
}

std::string TextOf(const Sample& a, const Sample& b) {
  char text[120];
  std::snprintf(text, sizeof text, "%.5g +- %.2g against %.5g +- %.2g", a.mean,
                std::sqrt(a.variance), b.mean, std::sqrt(b.variance));
  return text;
}

std::vector<Comparison> CompareParts(const std::string& what, const PartMeans& a,
                                     const PartMeans& b, const Margins& margins,
                                     bool hasEqualSeeds) {
  const double picture = std::max(SampleOf(a[0]).mean, SampleOf(b[0]).mean);
  std::vector<Comparison> comparisons;
  for (std::size_t i = 0; i < kParts.size(); ++i) {
    if (i == kEmission) continue;
    const Sample left = SampleOf(a[i]), right = SampleOf(b[i]);
    // Sums of float pixels in another order differ in the last digits.
    const double margin = std::max(margins.ofPart, 1e-5) * std::max(left.mean, right.mean) +
                          margins.ofPicture * picture;
    std::vector<double> differences;
    for (std::size_t k = 0; k < a[i].size(); ++k) differences.push_back(a[i][k] - b[i][k]);
    const double chance = hasEqualSeeds
                              ? PValueBeyond(SampleOf(differences), {0, 0, kPartSeeds}, margin)
                              : PValueBeyond(left, right, margin);
    comparisons.push_back(
        {what + ", " + kParts[i], chance, left.mean - right.mean, TextOf(left, right)});
  }
  return comparisons;
}

}  // namespace exphoton::random_scenes
