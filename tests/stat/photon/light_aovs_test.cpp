// SPDX-License-Identifier: BSD-2-Clause
// Path tracing and photon mapping must agree on which light is caustic, indirect or specular. The
// lamp and the mirror are large, so that path tracing finds caustics with little noise.
#include <cmath>
#include <map>

#include "tests/support/equivalence.h"
#include "tests/support/test_scene.h"

namespace exphoton {
namespace {

constexpr const char* kMirrorRoom = R"(WorldBegin
AttributeBegin Material "matte" "color Kd" [.5 .5 .5] Shape "sphere" "float radius" 8 AttributeEnd
AttributeBegin
AreaLightSource "area" "color L" [9 8 7] "integer nsamples" 1
Translate 0 4.5 5 Shape "sphere" "float radius" 2.4
AttributeEnd
AttributeBegin Material "glass" Translate -1.6 0 4 Shape "sphere" AttributeEnd
AttributeBegin Material "mirror" Translate 3 1 4 Rotate -90 0 1 0
Shape "disk" "float radius" 3 AttributeEnd
Material "matte" "color Kd" [.7 .6 .5]
Shape "trianglemesh" "point P" [-9 -1 -9 9 -1 -9 9 -1 9 -9 -1 9] "integer indices" [0 1 2 0 2 3]
WorldEnd
)";

std::map<std::string, SeedEstimate> EstimateAovs(const std::string& integrator, int samples) {
  std::map<std::string, std::vector<double>> means;
  for (int k = 0; k < kGateSeeds; ++k) {
    TestRenderOptions options;
    options.aovs = kLightAovs;
    options.seed = std::uint64_t(k) * 1000 + 1;
    const Image image =
        RenderSceneText(TestHeader(integrator, 16, 12, samples) + kMirrorRoom, options).image;
    for (const char* aov : {"emission.G", "direct.G", "caustic.G", "indirect.G", "specular.G"})
      means[aov].push_back(MeanChannel(image, aov));
  }
  std::map<std::string, SeedEstimate> estimates;
  for (const auto& [aov, values] : means) estimates[aov] = EstimateFrom(values);
  return estimates;
}

TEST(LightAovs, AgreeBetweenPathTracingAndPhotonMapping) {
  const auto path = EstimateAovs("\"path\" \"integer maxdepth\" 12", 256);
  const auto photons = EstimateAovs(
      "\"exphotonmap\" \"integer causticphotons\" 30000 \"integer maxdepth\" 12 "
      "\"integer indirectphotons\" 10000 \"integer finalgathersamples\" 8",
      32);
  for (const auto& [aov, expected] : path) {
    const SeedEstimate& found = photons.at(aov);
    EXPECT_GT(expected.mean, .02) << aov;
    // The interval of the difference belongs to the error, as in IsWithin.
    const double half = std::hypot(found.halfWidth, expected.halfWidth);
    EXPECT_LE(std::abs(found.mean - expected.mean) + half, .04 * expected.mean)
        << aov << ": " << found.mean << " and " << expected.mean << ", half-widths "
        << found.halfWidth << " and " << expected.halfWidth;
  }
}

}  // namespace
}  // namespace exphoton
