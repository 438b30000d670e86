// SPDX-License-Identifier: BSD-2-Clause
// The wall scatters the share d of the light diffusely and s in the mirror direction, and emits
// e = 1 - d - s. Light that arrives after any number of mirrors and no other scattering is
// e / (1 - s). So the AOVs are e, d e (direct), d (e / (1 - s) - e) (caustic), d (1 - e / (1 - s))
// (indirect) and s (specular).
#include "tests/random/variations/mirror_furnace.h"

#include <array>
#include <cstdio>

#include "core/math/sampling/random.h"

namespace exphoton::random_scenes {
namespace {

constexpr std::array<const char*, 2> kMirrorMethods{R"("path" "integer maxdepth" 60)",
                                                    R"("bidirectional" "integer maxdepth" 20)"};
constexpr double kReflectance = .6;  // of both materials
constexpr double kMargin = .02;      // relative to each AOV
constexpr int kSamples = 8;

std::string WallText(const char* integrator, double diffuseShare, int samples) {
  char text[900];
  std::snprintf(
      text, sizeof text,
      "SurfaceIntegrator %s\nFilm \"image\" \"integer xresolution\" 6 \"integer yresolution\" 6\n"
      "PixelFilter \"box\"\nSampler \"lowdiscrepancy\" \"integer pixelsamples\" %d\n"
      "Translate .1 .2 .3 Camera \"perspective\" \"float fov\" 90\nWorldBegin\n"
      "MakeNamedMaterial \"a\" \"string type\" \"matte\" \"color Kd\" [.6 .6 .6]\n"
      "MakeNamedMaterial \"b\" \"string type\" \"mirror\" \"color Kr\" [.6 .6 .6]\n"
      "Material \"mix\" \"color amount\" [%g %g %g] \"string namedmaterial1\" \"a\" "
      "\"string namedmaterial2\" \"b\"\nAreaLightSource \"area\" \"color L\" [.4 .4 .4]\n"
      "ReverseOrientation Shape \"sphere\" \"float radius\" 1\nWorldEnd\n",
      integrator, samples, diffuseShare, diffuseShare, diffuseShare);
  return text;
}

}  // namespace

std::vector<Comparison> CompareInMirrorFurnace(const Effort& effort) {
  RandomStream random(HashKey({effort.sceneSeed, 40}));
  const char* const integrator = kMirrorMethods[std::size_t(random.Bits() % kMirrorMethods.size())];
  const double diffuseShare = .25 * double(1 + random.Bits() % 3);
  const double d = kReflectance * diffuseShare, s = kReflectance - d, e = 1 - kReflectance;
  const double mirrored = e / (1 - s);
  const std::array<double, kParts.size()> exact{1, e, d * e, d * (mirrored - e), d * (1 - mirrored),
                                                s};
  const PartMeans means =
      MeansOf(WallText(integrator, diffuseShare, kSamples * effort.factor), effort.firstSeed);
  std::vector<Comparison> comparisons;
  for (std::size_t i = 0; i < kParts.size(); ++i) {
    const Sample found = SampleOf(means[i]), truth{exact[i], 0, kPartSeeds};
    comparisons.push_back({std::string("mirror furnace of ") + integrator + ", " + kParts[i],
                           PValueBeyond(found, truth, kMargin * exact[i]), found.mean - exact[i],
                           TextOf(found, truth)});
  }
  return comparisons;
}

}  // namespace exphoton::random_scenes
