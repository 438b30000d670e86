// SPDX-License-Identifier: BSD-2-Clause
// Russian roulette must not depend on the lobe that a path takes. In a furnace whose material is a
// little mirror and much matte, the lobes change the path's weight by unlike factors. A survival
// that prefers one of them changes the radiance, which is 1 without such an error.
#include "tests/support/equivalence.h"
#include "tests/support/test_scene.h"

namespace exphoton {
namespace {

TEST(PathRoulette, KeepsTheMeanWhereLobesDiffer) {
  const std::string world = R"(WorldBegin
MakeNamedMaterial "little" "string type" "mirror" "color Kr" [.7 .7 .7]
MakeNamedMaterial "much" "string type" "matte" "color Kd" [.7 .7 .7]
Material "mix" "color amount" [.2 .2 .2] "string namedmaterial1" "little"
  "string namedmaterial2" "much"
ReverseOrientation AreaLightSource "area" "color L" [.3 .3 .3] Shape "sphere"
WorldEnd
)";
  for (const char* integrator :
       {"\"path\" \"integer maxdepth\" 60", "\"bidirectional\" \"integer maxdepth\" 30"}) {
    const SeedEstimate estimate = EstimateOverSeeds([&](std::uint64_t seed) {
      TestRenderOptions options;
      options.seed = seed;
      return MeanRadiance(RenderSceneText(TestHeader(integrator, 8, 8, 32) + world, options).image);
    });
    EXPECT_TRUE(IsWithin(.03, estimate, 1)) << integrator;
  }
}

}  // namespace
}  // namespace exphoton
