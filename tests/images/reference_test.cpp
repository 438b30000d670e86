// SPDX-License-Identifier: BSD-2-Clause
// These tests render seven scenes with path, photonmap and exphotonmap at 64 x 48 pixels, and
// compare the pictures with path tracing. They allow no non-finite pixel, no fireflies, and no bias
// beyond the stated one in the mean of the picture or of any of 4 x 3 blocks. The tolerances are
// for the small settings used here.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>

#include "tests/images/reference.h"

namespace exphoton {
namespace {

constexpr int kSeeds = 6;

struct Tolerances {
  double picture;  // of the mean, relative
  double block;    // relative to the block's mean, or to half the picture's if larger
  double firefly;  // largest pixel over the reference around it
};

struct PictureCase {
  const char* scene;
  const char* variant;  // the file; its integrator
  int samples;          // per pixel
  std::vector<ParameterOverride> parameters;
  Tolerances tolerances;

  std::string Path() const { return std::string(scene) + "/" + variant; }
};

std::vector<ParameterOverride> Photons(const char* indirect, const char* gather,
                                       const char* caustic = "20000") {
  return {{"SurfaceIntegrator", "indirectphotons", indirect},
          {"SurfaceIntegrator", "causticphotons", caustic},
          {"SurfaceIntegrator", "finalgathersamples", gather}};
}

const std::vector<ParameterOverride> kDeep = {{"SurfaceIntegrator", "maxdepth", "200"}};

// Path tracing has no bias; tolerances above 1 % allow for its noise, mainly of caustics. Photon
// maps have a bias (docs/theory/exphotonmap.md, section 6). It is largest in blocks full of contact
// shadows, +4 % under the skylight room's chair, and falls slowly with the number of photons.
const PictureCase kCases[] = {
    {"skylight-room", "emitters", 16, kDeep, {.01, .05, 4}},
    {"skylight-room", "exphotonmap", 8, Photons("200000", "32"), {.02, .08, 5}},
    {"cornell-caustic", "path", 64, kDeep, {.03, .16, 30}},
    {"cornell-caustic", "photonmap", 2, Photons("30000", "16", "40000"), {.02, .06, 5}},
    {"cornell-caustic", "exphotonmap", 2, Photons("30000", "16", "40000"), {.02, .06, 5}},
    {"glossy-room", "path", 64, kDeep, {.01, .05, 6}},
    {"glossy-room", "photonmap", 4, Photons("30000", "4", "4000"), {.02, .10, 10}},
    {"glossy-room", "exphotonmap", 4, Photons("30000", "8", "4000"), {.02, .10, 10}},
    {"glossy-floor-room", "exphotonmap", 64, Photons("1000000", "16"), {.01, .03, 5}},
    {"furnace", "path", 16, kDeep, {.01, .02, 2}},
    {"furnace", "photonmap", 1, Photons("50000", "16"), {.02, .03, 2}},
    {"furnace", "exphotonmap", 1, Photons("50000", "16"), {.02, .03, 2}},
    {"veach-mis", "path", 32, kDeep, {.01, .08, 4}},
    {"veach-mis", "photonmap", 8, Photons("20000", "8"), {.02, .10, 15}},
    {"veach-mis", "exphotonmap", 8, Photons("20000", "8"), {.02, .06, 4}},
    {"moving-spheres", "path", 32, kDeep, {.01, .08, 6}},
    {"moving-spheres", "photonmap", 4, Photons("30000", "8", "4000"), {.02, .10, 10}},
    {"moving-spheres", "exphotonmap", 4, Photons("30000", "16", "4000"), {.02, .10, 10}},
};

// ctest calls a test long if its name begins with this word. Nearly all light of the room with the
// glossy floor is indirect over this floor, which costs path tracing many samples. photonmap takes
// long in rooms of indirect light, and other scenes compare it, too.
const PictureCase kLongCases[] = {
    {"skylight-room", "photonmap", 6, Photons("300000", "16"), {.02, .10, 5}},
    {"glossy-floor-room", "photonmap", 8, Photons("100000", "16"), {.02, .10, 10}},
    {"glossy-floor-room", "path", 640, kDeep, {.01, .05, 6}},
};

class Picture : public testing::TestWithParam<PictureCase> {};

std::vector<Image> RenderSeeds(const PictureCase& picture, const Reference& reference) {
  LoadOptions load;
  load.parameters = picture.parameters;
  load.samplesPerPixel = picture.samples;
  LoadedScene scene = LoadSceneFile(picture.Path(), load);
  std::vector<Image> pictures;
  for (int k = 0; k < kSeeds; ++k) {
    TestRenderOptions options;
    options.seed = std::uint64_t(k) * 1000 + 1;
    options.footprintSamples = reference.footprintSamples;
    pictures.push_back(RenderLoaded(scene, options).image);
  }
  return pictures;
}

std::string Describe(const RegionResult& region, double tolerance) {
  char text[256];
  std::snprintf(
      text, sizeof text,
      "%s: mean %.5g, reference %.5g, error %+.5f +- %.5f, tolerance %.5f, p-value %.2g%s",
      region.name.c_str(), region.mean, region.truth, region.mean - region.truth, region.halfWidth,
      tolerance, region.pValue, region.halfWidth > tolerance ? " (inconclusive: too noisy)" : "");
  return text;
}

bool IsWithinTolerance(const RegionResult& region, double tolerance) {
  return std::abs(region.mean - region.truth) + region.halfWidth <= tolerance;  // false for NaN
}

TEST_P(Picture, AgreesWithPathTracing) {
  const PictureCase& picture = GetParam();
  const Reference reference = LoadReference(picture.scene);
  const std::vector<Image> pictures = RenderSeeds(picture, reference);
  EXPECT_EQ(CountNonFinite(pictures), 0);

  const Image& truth = reference.image;
  const RegionResult whole =
      MeasureRegion(reference, pictures, {0, 0, truth.Width(), truth.Height()});
  double tolerance = picture.tolerances.picture * whole.truth;
  EXPECT_TRUE(IsWithinTolerance(whole, tolerance)) << Describe(whole, tolerance);
  double worst = 0;
  for (const PixelBounds& block : Blocks(truth)) {
    const RegionResult region = MeasureRegion(reference, pictures, block);
    const double scale = std::max(region.truth, whole.truth / 2);
    tolerance = picture.tolerances.block * scale;
    EXPECT_TRUE(IsWithinTolerance(region, tolerance)) << Describe(region, tolerance);
    worst = std::max(worst, (std::abs(region.mean - region.truth) + region.halfWidth) / scale);
  }
  const double firefly = LargestFirefly(reference, pictures);
  EXPECT_LE(firefly, picture.tolerances.firefly);

  std::printf("%s: error %+.2f %% +- %.2f %%, worst block %.2f %%, brightest pixel %.1f x\n",
              picture.Path().c_str(), 100 * (whole.mean / whole.truth - 1),
              100 * whole.halfWidth / whole.truth, 100 * worst, firefly);
  const study::Separation separation = study::Separate(pictures, reference.measured);
  std::printf("relMSE %.3g: noise %.3g, bias^2 %.2g +- %.2g, of the reference %.2g\n",
              separation.relMse.value, separation.variance.value, separation.bias2.value,
              separation.bias2.error, reference.measured.variance.value);
  if (HasFailure())
    std::printf("see %s\n", WriteFailure(picture.Path(), reference, pictures).c_str());
}

std::string CaseName(const testing::TestParamInfo<PictureCase>& info) {
  std::string name = info.param.Path();
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
  return name;
}

INSTANTIATE_TEST_SUITE_P(References, Picture, testing::ValuesIn(kCases), CaseName);
INSTANTIATE_TEST_SUITE_P(LongReferences, Picture, testing::ValuesIn(kLongCases), CaseName);

// directlighting and whitted omit some light, so they never exceed the reference. Two threads,
// another tile size and another tile order give the same bits.
TEST(Picture, WithoutIndirectLightIsNoBrighterAndAlwaysTheSame) {
  for (const char* scene : {"skylight-room", "cornell-caustic", "glossy-room", "furnace",
                            "veach-mis", "moving-spheres", "glossy-floor-room"}) {
    const double truth = MeanRadiance(LoadReference(scene).image);
    for (const char* variant : {"directlighting", "whitted"}) {
      SCOPED_TRACE(std::string(scene) + "/" + variant);
      LoadOptions load;
      load.samplesPerPixel = 4;
      LoadedScene loaded = LoadSceneFile(std::string(scene) + "/" + variant, load);
      const Image first = RenderLoaded(loaded).image;
      TestRenderOptions others;
      others.threads = 2;
      others.tileSize = 7;
      others.tileOrder = TileOrder::Reversed;
      EXPECT_EQ(first.pixels, RenderLoaded(loaded, others).image.pixels);
      EXPECT_EQ(CountNonFinite({first}), 0);
      EXPECT_LE(MeanRadiance(first), truth * 1.02);
      if (std::string(scene) == "skylight-room")
        EXPECT_EQ(MeanRadiance(first), 0);
      else
        EXPECT_GT(MeanRadiance(first), truth * .2);
    }
  }
}

TEST(Picture, OfPhotonsIsTheSameForAnyThreadsAndTiles) {
  for (const char* variant : {"cornell-caustic/exphotonmap", "cornell-caustic/photonmap"}) {
    SCOPED_TRACE(variant);
    LoadOptions load;
    load.parameters = Photons("3000", "8", "3000");
    load.samplesPerPixel = 1;
    LoadedScene loaded = LoadSceneFile(variant, load);
    const Image first = RenderLoaded(loaded).image;
    TestRenderOptions others;
    others.threads = 3;
    others.tileSize = 7;
    others.tileOrder = TileOrder::Reversed;
    EXPECT_EQ(first.pixels, RenderLoaded(loaded, others).image.pixels);
  }
}

}  // namespace
}  // namespace exphoton
