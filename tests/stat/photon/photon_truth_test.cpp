// SPDX-License-Identifier: BSD-2-Clause
// These tests compare photon integrators with closed forms: furnaces, a light in a sphere, caustics
// of a slab and a mirror, and one light split into many. They use the equivalence rule over
// independent seeds (equivalence.h). Each case has a false-alarm rate below 1 %, and noise can
// never make it pass.
#include <gtest/gtest.h>

#include <string>

#include "tests/support/equivalence.h"
#include "tests/support/test_scene.h"

namespace exphoton {
namespace {

std::string Grey(double value) {
  const std::string v = std::to_string(value);
  return "[" + v + " " + v + " " + v + "]";
}

double MeanOf(const std::string& scene, std::uint64_t seed) {
  TestRenderOptions options;
  options.seed = seed;
  return MeanRadiance(RenderSceneText(scene, options).image);
}

// A closed sphere that emits e and reflects a has the radiance e / (1 - a) everywhere. Plain
// Russian roulette (survival 1/2 after three bounces) multiplies a photon's weight by 2a, so
// its variance is infinite for a > 1/sqrt(2). Brighter furnaces need the roulette that keeps
// weights constant.
class Furnace : public testing::TestWithParam<std::tuple<const char*, double>> {};

TEST_P(Furnace, ShowsEmissionOverOneMinusAlbedo) {
  const auto [integrator, albedo] = GetParam();
  const std::string scene =
      TestHeader(std::string("\"") + integrator +
                     // A path stores a geometrically distributed number of photons, so accuracy
                     // depends on the number of paths.
                     "\" \"integer indirectphotons\" [" +
                     (albedo > .85  ? "500000"
                      : albedo > .7 ? "100000"
                                    : "40000") +
                     "] \"integer directphotons\" [20000] \"integer finalgathersamples\" [16]" +
                     (albedo > .7 ? " \"string photonroulette\" \"luminance\"" : ""),
                 10, 10, 4) +
      FurnaceWorld(1, "\"matte\" \"color Kd\" " + Grey(albedo));
  const auto estimate = EstimateOverSeeds([&](std::uint64_t seed) { return MeanOf(scene, seed); });
  EXPECT_TRUE(IsWithin(.01, estimate, 1 / (1 - albedo)));
}

INSTANTIATE_TEST_SUITE_P(PhotonIntegrators, Furnace,
                         testing::Combine(testing::Values("photonmap", "exphotonmap"),
                                          testing::Values(.5, .8, .9)));

// "constant" must keep the mean, with gloss and two lobes, where it draws several candidates.
class ConstantPhotons : public testing::TestWithParam<const char*> {};

TEST_P(ConstantPhotons, ShowTheSameFurnaceAsLuminanceRoulette) {
  const auto mean = [&](const std::string& roulette) {
    const std::string scene =
        TestHeader(
            "\"photonmap\" \"integer indirectphotons\" 60000 \"integer directphotons\" "
            "20000 \"integer causticphotons\" 0 \"bool finalgather\" \"false\" \"string "
            "photonroulette\" \"" +
                roulette + "\"",
            10, 10, 4) +
        FurnaceWorld(1, GetParam());
    return EstimateOverSeeds([&](std::uint64_t seed) { return MeanOf(scene, seed); });
  };
  const SeedEstimate luminance = mean("luminance");
  EXPECT_TRUE(IsWithin(.015, mean("constant"), luminance.mean));
  EXPECT_LE(luminance.halfWidth, .008 * luminance.mean);
}

INSTANTIATE_TEST_SUITE_P(
    Materials, ConstantPhotons,
    testing::Values(R"("matte" "color Kd" [.5 .5 .5])",
                    R"("plastic" "color Kd" [.4 .3 .2] "color Ks" [.3 .3 .3] "float roughness" .2)",
                    R"("substrate" "color Kd" [.4 .4 .4] "color Ks" [.2 .2 .2])"));

// The guided gather must not lose or add energy at any cone angle.
class GatherFurnace : public testing::TestWithParam<double> {};

TEST_P(GatherFurnace, IsRightAtEveryGatherAngle) {
  const std::string scene =
      TestHeader("\"exphotonmap\" \"integer indirectphotons\" [20000] \"float gatherangle\" [" +
                     std::to_string(GetParam()) + "] \"integer finalgathersamples\" [64]",
                 8, 8, 4) +
      FurnaceWorld(1, "\"matte\" \"color Kd\" " + Grey(.5));
  const auto estimate = EstimateOverSeeds([&](std::uint64_t seed) { return MeanOf(scene, seed); });
  // The total of 2 is the emission 1, direct light .5 and gathered light .5. The first two are
  // exact here, so .4 % of the total is 1.6 % of the gathered light.
  EXPECT_TRUE(IsWithin(.004, estimate, 2));
}

INSTANTIATE_TEST_SUITE_P(Angles, GatherFurnace,
                         testing::Values(.001, .05, .1, 1.0, 5.0, 10.0, 45.0, 90.0));

// For a point light anywhere in a sphere of radius R and albedo a, the indirect radiance is the
// same all over the sphere: a^2 Phi / (4 pi^2 R^2 (1 - a)).
class LightInSphere : public testing::TestWithParam<const char*> {};

TEST_P(LightInSphere, GivesConstantIndirectLightWhereverItIs) {
  const double albedo = .6, intensity = 1;
  const auto scene = [&](const std::string& integrator) {
    return TestHeader(integrator, 8, 8, 4) +
           "WorldBegin\nLightSource \"point\" \"color I\" [1 1 1] \"point from\" [.4 .2 -.3]\n"
           "Material \"matte\" \"color Kd\" " +
           Grey(albedo) + "\nReverseOrientation\nShape \"sphere\" \"float radius\" [1]\nWorldEnd\n";
  };
  const std::string all = scene(std::string("\"") + GetParam() +
                                "\" \"integer indirectphotons\" [20000] \"float maxdist\" [.2]");
  const std::string direct = scene("\"directlighting\"");
  const auto estimate = EstimateOverSeeds(
      [&](std::uint64_t seed) { return MeanOf(all, seed) - MeanOf(direct, seed); });
  const double pi = 3.14159265358979, power = 4 * pi * intensity;
  EXPECT_TRUE(IsWithin(.02, estimate, albedo * albedo * power / (4 * pi * pi * (1 - albedo))));
}

INSTANTIATE_TEST_SUITE_P(PhotonIntegrators, LightInSphere,
                         testing::Values("photonmap", "exphotonmap"));

// Kd .01 keeps interreflection below 1e-4, and the camera looks at the floor from the side. The
// photons of the beam are low-discrepancy points, which lie more evenly than a Poisson process.
// Their k-th nearest point is about half a place farther away, so an estimate from k photons reads
// up to 1/(2k) too low. Therefore k is 200.
std::string CausticScene(const std::string& integrator, const std::string& optics) {
  return "SurfaceIntegrator " + integrator +
         "\nFilm \"image\" \"integer xresolution\" [8] \"integer yresolution\" [8]\n"
         "PixelFilter \"box\"\nSampler \"lowdiscrepancy\" \"integer pixelsamples\" [4]\n"
         "LookAt 0 .7 -.5  0 0 0  0 1 0\nCamera \"perspective\" \"float fov\" [50]\n"
         "WorldBegin\nLightSource \"distant\" \"color L\" [1 1 1] \"point from\" [0 1 0] "
         "\"point to\" [0 0 0]\n" +
         optics +
         "Material \"matte\" \"color Kd\" [.01 .01 .01]\n"
         "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] \"point P\" "
         "[-1 0 -1  -1 0 1  1 0 1  1 0 -1]\nWorldEnd\n";
}

class Caustic : public testing::TestWithParam<const char*> {
 protected:
  std::string Integrator() const {
    return std::string("\"") + GetParam() +
           "\" \"integer causticphotons\" [30000] \"integer indirectphotons\" [0] \"integer "
           "nused\" [200] \"float "
           "maxdist\" [.1] \"bool finalgather\" [\"false\"]";
  }
};

TEST_P(Caustic, ThroughAGlassSlabLosesWhatFresnelTakes) {
  // With all internal bounces, a slab transmits 2 n / (n^2 + 1).
  for (const double index : {1.5, 1.33}) {
    const std::string slab =
        "Material \"glass\" \"float index\" [" + std::to_string(index) +
        "]\nShape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3 4 6 5 4 7 6] \"point P\" "
        "[-2 .9 -2  -2 .9 2  2 .9 2  2 .9 -2  -2 .8 -2  -2 .8 2  2 .8 2  2 .8 -2]\n";
    const std::string scene = CausticScene(Integrator(), slab);
    const auto estimate =
        EstimateOverSeeds([&](std::uint64_t seed) { return MeanOf(scene, seed); });
    EXPECT_TRUE(IsWithin(.01, estimate, .01 / 3.14159265358979 * 2 * index / (index * index + 1)))
        << "index " << index;
  }
}

INSTANTIATE_TEST_SUITE_P(PhotonIntegrators, Caustic, testing::Values("photonmap", "exphotonmap"));

// A horizontal beam meets a 45 degree mirror above the floor, which turns the beam down to the
// floor. The reflectance of the floor is .01.
std::string MirrorCausticScene(const std::string& roughness) {
  return "SurfaceIntegrator \"exphotonmap\" \"integer causticphotons\" [60000] \"integer "
         "indirectphotons\" [0] \"integer nused\" [200] \"float maxdist\" [.1] \"bool "
         "finalgather\" "
         "[\"false\"]\n"
         "Film \"image\" \"integer xresolution\" [8] \"integer yresolution\" [8]\n"
         "PixelFilter \"box\"\nSampler \"lowdiscrepancy\" \"integer pixelsamples\" [4]\n"
         "LookAt 0 .7 -.5  0 0 0  0 1 0\nCamera \"perspective\" \"float fov\" [50]\nWorldBegin\n"
         "LightSource \"distant\" \"color L\" [1 1 1] \"point from\" [0 0 0] \"point to\" [1 0 0]\n"
         "Material \"mirror\" \"color Kr\" [1 1 1]\n"
         "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] \"point P\" "
         "[-1 2.5 -1  -1 2.5 1  1 .5 1  1 .5 -1]\n"
         "Material \"matte\" \"color Kd\" [.01 .01 .01] \"float sigma\" " +
         roughness +
         "\nShape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] \"point P\" "
         "[-1 0 -1  -1 0 1  1 0 1  1 0 -1]\nWorldEnd\n";
}

TEST(MirrorCaustic, FromAMirrorAt45DegreesHasTheIrradianceOfTheBeam) {
  const std::string scene = MirrorCausticScene("0");
  const auto estimate = EstimateOverSeeds([&](std::uint64_t seed) { return MeanOf(scene, seed); });
  EXPECT_TRUE(IsWithin(.01, estimate, .01 / 3.14159265358979));
}

// Oren and Nayar's reflectance for light along the normal is Kd (1 - s^2 / (2 (s^2 + .33))) / pi in
// all directions. The mean over all pairs of directions is 9 % above it.
TEST(MirrorCaustic, OnARoughFloorScattersByTheDirectionOfTheBeam) {
  const std::string scene = MirrorCausticScene("30");
  const auto estimate = EstimateOverSeeds([&](std::uint64_t seed) { return MeanOf(scene, seed); });
  const double s2 = std::pow(3.14159265358979 / 6, 2);
  EXPECT_TRUE(IsWithin(.01, estimate, .01 / 3.14159265358979 * (1 - s2 / (2 * (s2 + .33)))));
}

// n lights of power 1/n must light the room like one light of power 1.
class SplitLight : public testing::TestWithParam<std::tuple<const char*, int>> {};

TEST_P(SplitLight, LightsAsOneDoes) {
  const auto [selection, count] = GetParam();
  std::string lights;
  for (int i = 0; i < count; ++i)
    lights += "LightSource \"point\" \"color I\" " + Grey(1.0 / count) + "\n";
  const double albedo = .5;
  const std::string scene =
      TestHeader(
          "\"exphotonmap\" \"integer indirectphotons\" [80000] \"integer directphotons\" [20000] "
          "\"integer finalgathersamples\" [32] \"string lightselection\" "
          "[\"" +
              std::string(selection) + "\"]",
          10, 10, 4) +
      "WorldBegin\n" + lights + "Material \"matte\" \"color Kd\" " + Grey(albedo) +
      "\nReverseOrientation\nShape \"sphere\" \"float radius\" [1]\nWorldEnd\n";
  const auto estimate = EstimateOverSeeds([&](std::uint64_t seed) { return MeanOf(scene, seed); });
  // The light is at the centre, so the radiance is a I / (pi R^2 (1 - a)).
  EXPECT_TRUE(IsWithin(.01, estimate, albedo / (3.14159265358979 * (1 - albedo))));
}

INSTANTIATE_TEST_SUITE_P(Counts, SplitLight,
                         testing::Combine(testing::Values("power", "uniform"),
                                          testing::Values(1, 2, 7, 100)));

// Returns a closed box around (x, 0, 0) with half-width 1.
std::string Box(double x) {
  std::string p;
  for (int i = 0; i < 8; ++i)
    p += std::to_string(x + (i & 1 ? 1 : -1)) + (i & 2 ? " 1" : " -1") + (i & 4 ? " 1 " : " -1 ");
  return "Shape \"trianglemesh\" \"integer indices\" [0 1 3 0 3 2 4 6 7 4 7 5 0 4 5 0 5 1 2 3 7 2 "
         "7 "
         "6 0 2 6 0 6 4 1 5 7 1 7 3] \"point P\" [" +
         p + "]\n";
}

TEST(UnlitRoom, BesideALitOneStaysDark) {
  for (const char* integrator : {"photonmap", "exphotonmap"}) {
    const std::string scene =
        TestHeader(std::string("\"") + integrator +
                       "\" \"integer indirectphotons\" [5000] \"float maxdist\" [.4]",
                   6, 6, 4) +
        "WorldBegin\nLightSource \"point\" \"color I\" [5 5 5] \"point from\" [2.5 0 0]\n"
        "Material \"matte\" \"color Kd\" [.7 .7 .7]\n" +
        Box(0) + Box(2.5) + "WorldEnd\n";
    EXPECT_EQ(MeanOf(scene, 1), 0) << integrator;
  }
}

}  // namespace
}  // namespace exphoton
