// SPDX-License-Identifier: BSD-2-Clause
// These tests check the radiance that gather rays read at a surface with different reflectance and
// transmittance, and the ray length from which radiance photons are used. Photons of known density
// arrive on both sides of a pane.
#include "integrators/photon/gather/gather_ray.h"

#include <gtest/gtest.h>

#include "core/base/log.h"
#include "core/base/parallel.h"
#include "core/base/progress.h"
#include "tests/support/equivalence.h"
#include "tests/support/test_scene.h"

namespace exphoton {
namespace {

constexpr double kPi64 = 3.14159265358979;
constexpr double kReflected = .3, kTransmitted = .6;
// Photons above and below the pane have these powers. The irradiance on each side is the power
// times the density of the lattice.
constexpr double kAbove = 1, kBelow = 3;
// The 32nd photon of both sides has the squared distance .05 from a lattice point. Disks of photons
// follow from it, and hold 12 points besides the centre. The 50th point has the squared distance
// .17. Rays read a radiance photon within the disk of 50 photons that are as dense as in their own
// disks.
constexpr double kDisk2 = PhotonMap::kOwnDisk * 50 * .05 / 32, kReach2 = 50 * .05 / 32;
const double kOwnWeight = OwnPhotonWeight(.125, 1).In(48 / .17 * kDisk2, 48 / .17 * kReach2);
const double kLattice = (12 + kOwnWeight) / (kDisk2 * kPi64) / 100;

const char* const kPane =
    "Material \"translucent\" \"color Kd\" [1 1 1] \"color Ks\" [0 0 0] \"color reflect\" [.3 .3 "
    ".3] "
    "\"color transmit\" [.6 .6 .6]\nShape \"disk\" \"float radius\" 5\n";

class PaneTest : public testing::Test {
 protected:
  explicit PaneTest(const std::string& world = kPane)
      : scene_(
            LoadSceneText("SurfaceIntegrator \"exphotonmap\"\nWorldBegin\nLightSource \"point\"\n" +
                          world + "WorldEnd\n")),
        samples_(SampleLayout()),
        random_(1) {
    settings_.maxDist = 1;
    settings_.nUsed = 50;
  }

  // Fills the maps from a lattice of 100 photons per unit area and 100 paths.
  void Fill() {
    PhotonPassResult result;
    std::vector<RadiancePhotonSite> sites;
    for (int y = -30; y <= 30; ++y) {
      for (int x = -30; x <= 30; ++x) {
        const Point3 p{Real(x) / 10, Real(y) / 10, 0};
        result[PhotonKind::Direct].Add({p, {0, 0, 1}, Spectrum(Real(kAbove))});
        result[PhotonKind::Direct].Add({p, {0, 0, -1}, Spectrum(Real(kBelow))});
        sites.push_back({p, {0, 0, 1}, Spectrum(Real(kReflected)), Spectrum(Real(kTransmitted))});
      }
    }
    for (PhotonBuffer& buffer : result.buffers) buffer.paths = 100;
    PreprocessContext context{threads_, 1, log_, progress_, statistics_, false, nullptr, {}};
    maps_ = PhotonMapSet(&result, settings_, 5, context);
    radianceMap_ = std::make_unique<RadiancePhotonMap>(sites, maps_, settings_, true, context);
  }

  struct Read {
    double radiance;
    double radius;  // radius of the radiance photon's density estimate
    std::int64_t radiancePhotonsRead;
  };
  Read ReadFrom(const Point3& o, const Vector3& d, const RadiancePhotonMap* radianceMap) {
    AovSample aovs;
    LiContext context{*scene_.setup->scene, samples_, arena_, rays_, 1, 1, &aovs};
    const auto lights = scene_.setup->scene->MakeLightSampler(LightSelection::Auto);
    const GatherRay gather(maps_, radianceMap, settings_, *lights, context, &random_);
    Ray ray;
    ray.o = o;
    ray.d = d;
    auto segment = gather.Trace(ray);
    gather.LookUp({&segment, 1});
    const double radiance = double(gather.Read(segment).g);
    const double radius2 = segment.entry ? double(segment.entry->radius2) : 0;
    return {radiance, std::sqrt(radius2), aovs.radiancePhotonsRead};
  }

  LoadedScene scene_;
  CameraSamples samples_;
  RandomStream random_;
  ThreadPool threads_{1};
  Log log_{Log::Level::Normal, Log::Sink::Memory};
  ProgressReporter progress_{ProgressReporter::Mode::Quiet};
  Statistics statistics_;
  Arena arena_;
  RayCounters rays_;
  PhotonSettings settings_;
  PhotonMapSet maps_;
  std::unique_ptr<RadiancePhotonMap> radianceMap_;
};

TEST_F(PaneTest, SendsGatherRaysWhatItReflectsAndTransmitsOnEitherSide) {
  const double towardsAbove = (kReflected * kAbove + kTransmitted * kBelow) / kPi64;
  const double towardsBelow = (kReflected * kBelow + kTransmitted * kAbove) / kPi64;
  Fill();
  const Read above = ReadFrom({Real(.03), Real(.02), 2}, {0, 0, -1}, radianceMap_.get());
  const Read below = ReadFrom({Real(.03), Real(.02), -2}, {0, 0, 1}, radianceMap_.get());
  EXPECT_EQ(above.radiancePhotonsRead, 1);
  EXPECT_EQ(below.radiancePhotonsRead, 1);
  EXPECT_NEAR(above.radiance / (kLattice * towardsAbove), 1, 1e-4);
  EXPECT_NEAR(below.radiance / (kLattice * towardsBelow), 1, 1e-4);
}

TEST_F(PaneTest, SendsGatherRaysTheSameByDensityEstimates) {
  Fill();
  const Read above = ReadFrom({Real(.03), Real(.02), 2}, {0, 0, -1}, nullptr);
  const Read below = ReadFrom({Real(.03), Real(.02), -2}, {0, 0, 1}, nullptr);
  EXPECT_EQ(above.radiancePhotonsRead, 0);
  // The 50 nearest photons are divided between both sides.
  EXPECT_NEAR(above.radiance * kPi64, kReflected * kAbove + kTransmitted * kBelow, .2);
  EXPECT_NEAR(below.radiance * kPi64, kReflected * kBelow + kTransmitted * kAbove, .2);
}

TEST_F(PaneTest, IsReadFromRadiancePhotonsOnlyBeyondShortRays) {
  Fill();
  const Real radius = Real(ReadFrom({0, 0, 2}, {0, 0, -1}, radianceMap_.get()).radius);
  ASSERT_GT(radius, Real(.25));
  for (const Real shortRays : {Real(.3), Real(.5), Real(2)}) {
    settings_.shortRays = shortRays;
    const Real limit = shortRays * radius;
    const auto read = [&](Real length) {
      return ReadFrom({0, 0, length}, {0, 0, -1}, radianceMap_.get()).radiancePhotonsRead;
    };
    EXPECT_EQ(read(Real(.95) * limit), 0) << shortRays;
    EXPECT_EQ(read(Real(1.05) * limit), 1) << shortRays;
  }
}

// SheetTest places a sheet of glass over a matte surface.
class SheetTest : public PaneTest {
 protected:
  SheetTest()
      : PaneTest(
            "Shape \"disk\" \"float radius\" 5\nMaterial \"glass\" \"float index\" 1.5\n"
            "Translate 0 0 1 ReverseOrientation Shape \"disk\" \"float radius\" 5\n"
            "Translate 0 0 .5 ReverseOrientation Shape \"disk\" \"float radius\" 5\n") {}
};

// A gather ray follows either reflection or refraction at each side of the sheet. Each side
// reflects F = .04, so the sheet transmits (1 - F) / (1 + F) of the light of the surface behind it.
TEST_F(SheetTest, DimsGatherRaysByWhatItReflects) {
  Fill();
  const double bare = ReadFrom({0, 0, Real(.5)}, {0, 0, -1}, nullptr).radiance;
  ASSERT_GT(bare, .1);
  constexpr int kRays = 20000;
  double sum = 0;
  for (int i = 0; i < kRays; ++i) sum += ReadFrom({0, 0, 3}, {0, 0, -1}, nullptr).radiance;
  EXPECT_NEAR(sum / kRays / bare, .96 / 1.04, .01);
}

// WeakMirrorTest places a mirror over a matte surface.
class WeakMirrorTest : public PaneTest {
 protected:
  WeakMirrorTest()
      : PaneTest(
            "Shape \"disk\" \"float radius\" 5\nMaterial \"mirror\" \"color Kr\" [.04 .04 .04]\n"
            "Translate 0 0 2 Shape \"disk\" \"float radius\" 5\n") {}
};

// Roulette ends six of ten gather rays at this mirror.
TEST_F(WeakMirrorTest, SendsGatherRaysWhatItReflects) {
  Fill();
  const double bare = ReadFrom({0, 0, Real(.5)}, {0, 0, -1}, nullptr).radiance;
  constexpr int kRays = 4000;
  double sum = 0;
  int ended = 0;
  for (int i = 0; i < kRays; ++i) {
    const double radiance = ReadFrom({0, 0, 1}, {0, 0, 1}, nullptr).radiance;
    sum += radiance;
    ended += radiance == 0;
  }
  EXPECT_NEAR(double(ended) / kRays, .6, .04);
  EXPECT_NEAR(sum / kRays / bare, .04, .003);
}

// A walk inside this sphere meets a weak mirror at each of up to 24 hits. Walks that went on for 24
// bounces made a picture 10 times as slow as the light in them was worth. Its walls emit .5 and
// reflect half of the light, so each radiance is 1.
constexpr const char* kWeakMirrors =
    "WorldBegin\nMakeNamedMaterial \"wall\" \"string type\" \"matte\" \"color Kd\" [.5 .5 .5]\n"
    "MakeNamedMaterial \"weak\" \"string type\" \"mirror\" \"color Kr\" [.5 .5 .5]\n"
    "Material \"mix\" \"color amount\" [.8 .8 .8] \"string namedmaterial1\" \"wall\" "
    "\"string namedmaterial2\" \"weak\"\n"
    "AreaLightSource \"area\" \"color L\" [.5 .5 .5]\n"
    "ReverseOrientation Shape \"sphere\" \"float radius\" 1\nWorldEnd\n";

// `integrator` is its name and further parameters.
TestRender RenderWeakMirrors(const std::string& integrator, std::uint64_t seed) {
  TestRenderOptions options;
  options.seed = seed;
  return RenderSceneText(
      TestHeader(integrator + " \"integer maxdepth\" 24", 6, 6, 1) + kWeakMirrors, options);
}

const std::string kGathers =
    "\"exphotonmap\" \"integer finalgathersamples\" 8 \"float rrthreshold\" 0 "
    "\"integer indirectphotons\" 4000";
const std::string kGathersDensities = kGathers + " \"bool radiancephotons\" \"false\"";

TEST(GatherRays, EndWhereMirrorsLeaveLittleOfTheirWeight) {
  const auto count = [](const TestRender& render, RayKind kind) {
    return double(render.rays.counts[std::size_t(kind)]);
  };
  // `whitted` has the same specular trees, without further rays for the emission.
  const TestRender trees = RenderWeakMirrors("\"whitted\"", 1);
  const double started = 8 * (count(trees, RayKind::Camera) + count(trees, RayKind::Specular));
  for (const std::string& integrator : {kGathers, kGathersDensities}) {
    const double rays = count(RenderWeakMirrors(integrator, 1), RayKind::Gather);
    // The first ray, the ray after the first bounce, and a tenth of the rays after each other one.
    EXPECT_LT(rays / started, 2.3) << integrator;
    EXPECT_GT(rays / started, 2) << integrator;
  }
}

TEST(GatherRays, LoseAndAddNoLightByRouletteAtMirrors) {
  const auto mean = EstimateOverSeeds([](std::uint64_t seed) {
    return MeanRadiance(RenderWeakMirrors(kGathersDensities, seed).image);
  });
  EXPECT_TRUE(IsWithin(.01, mean, 1));
}

}  // namespace
}  // namespace exphoton
