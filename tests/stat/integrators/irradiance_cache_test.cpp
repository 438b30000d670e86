// SPDX-License-Identifier: BSD-2-Clause
// These tests compare irradiance caching with closed forms, with finite differences and with path
// tracing, and check the effect of each parameter.
#include <gtest/gtest.h>

#include <sstream>

#include "integrators/irradiance/irradiance_estimate.h"
#include "tests/stat/integrators/comparison.h"

namespace exphoton {
namespace {

TestRender RenderCached(const std::string& scene, std::uint64_t seed = 1) {
  TestRenderOptions options;
  options.seed = seed;
  options.threads = 2;
  return RenderSceneText(scene, options);
}
SeedEstimate CacheMean(const std::string& scene) {
  return EstimateOverSeeds(
      [&](std::uint64_t seed) { return MeanRadiance(RenderCached(scene, seed).image); });
}

IrradianceRecord RecordAt(const Point3& p, Real radius) {
  IrradianceRecord record;
  record.p = p;
  record.n = {0, 0, 1};
  record.irradiance = Spectrum(3);
  record.radius = radius;
  return record;
}

TEST(IrradianceCacheOfRecords, InterpolatesALinearFunctionExactly) {
  IrradianceCache cache(Radians(20), 100);
  const auto truth = [](const Point3& p) { return 3 + p.x / 2 - p.y / 4; };
  for (const Point3 p : {Point3(0, 0, 0), Point3(1, 0, 0), Point3(Real(.3), 1, 0)}) {
    IrradianceRecord record = RecordAt(p, 2);
    record.irradiance = Spectrum(truth(p));
    record.translation.fill({Real(.5), Real(-.25), 0});
    cache.Insert(record);
  }
  for (const Point3 p : {Point3(Real(.2), Real(.1), 0), Point3(Real(.9), Real(.8), 0)})
    EXPECT_NEAR(cache.Find(p, {0, 0, 1}).irradiance[1], truth(p), 1e-5);
  // A turn about y by a small angle
  IrradianceCache turned(Radians(20), 100);
  IrradianceRecord record = RecordAt({}, 1);
  record.rotation.fill({0, 2, 0});
  turned.Insert(record);
  EXPECT_NEAR(turned.Find({}, {std::sin(Real(.1)), 0, std::cos(Real(.1))}).irradiance[0],
              3 + 2 * std::sin(.1), 1e-5);
}

TEST(IrradianceCacheOfRecords, UsesARecordWithinItsRadiusAndAngleAlone) {
  IrradianceCache cache(Radians(10), 100);
  cache.Insert(RecordAt({5, 5, 5}, Real(.5)));
  const Normal3 up(0, 0, 1);
  EXPECT_NEAR(cache.Find({5, 5, 5}, up).weight, 1, 1e-6);
  EXPECT_NEAR(cache.Find({Real(5.25), 5, 5}, up).weight, .5, 1e-5);
  EXPECT_EQ(cache.Find({Real(5.51), 5, 5}, up).weight, 0);
  EXPECT_EQ(cache.Find({5, 5, Real(4.9)}, up).weight, 0);  // the record is in front
  EXPECT_GT(cache.Find({5, 5, Real(5.1)}, up).weight, 0);
  const auto tilted = [](double degrees) {
    const Real a = Radians(Real(degrees));
    return Normal3(std::sin(a), 0, std::cos(a));
  };
  EXPECT_GT(cache.Find({5, 5, 5}, tilted(9)).weight, 0);
  EXPECT_EQ(cache.Find({5, 5, 5}, tilted(11)).weight, 0);
}

TEST(IrradianceCacheOfRecords, FindsRecordsOfAllSizesAndPlaces) {
  IrradianceCache cache(Radians(10), 1000);
  std::vector<IrradianceRecord> records;
  for (int i = 0; i < 200; ++i) {
    const Real x = Real(i * 37 % 100 - 50), y = Real(i * 53 % 90 - 45);
    records.push_back(RecordAt({x, y, 0}, Real(std::ldexp(.3, i % 8))));
    cache.Insert(records.back());
  }
  for (int i = 0; i < 300; ++i) {
    const Point3 p(Real(i * 29 % 110 - 55) + Real(.3), Real(i * 31 % 100 - 50), 0);
    Real sum = 0;
    for (const IrradianceRecord& r : records)
      sum += std::max(Real(0), 1 - Distance(p, r.p) / r.radius);
    EXPECT_NEAR(cache.Find(p, {0, 0, 1}).weight, sum, 1e-4 * (1 + double(sum)));
  }
}

// A point in the air under a wall that a point light lights. Its irradiance is estimated with many
// rays, at the point and beside it.
struct AirPoint {
  LoadedScene scene = LoadSceneText(
      "SurfaceIntegrator \"irradiancecache\"\n"
      "WorldBegin\nLightSource \"point\" \"point from\" [.4 0 .3] \"color I\" [2 2 2]\n"
      "Material \"matte\" \"color Kd\" [.5 .5 .5]\nShape \"trianglemesh\" \"integer indices\" [0 1 "
      "2 0 2 "
      "3] \"point P\" [-1 -1 1  1 -1 1  1 1 1  -1 1 1]\nShape \"trianglemesh\" \"integer indices\" "
      "[0 1 2 0 2 3] \"point P\" [1 -1 0  1 1 0  1 1 1  1 -1 1]\nWorldEnd\n");
  IndirectRadiance incident{*scene.setup->scene, 1};
  Arena arena;
  RayCounters rays;

  IrradianceEstimate At(const Point3& p, const Normal3& n, std::uint64_t key) {
    const CameraSamples samples{SampleLayout()};
    LiContext context{*scene.setup->scene, samples, arena, rays, key};
    SurfacePoint surface;
    surface.p = p;
    surface.ng = {0, 0, 1};
    return EstimateIrradiance({surface, n, 65536}, incident, context.Stream(1), context);
  }
};

TEST(IrradianceEstimate, HasTheGradientsOfFiniteDifferences) {
  AirPoint air;
  const Point3 p(Real(.1), Real(.2), 0);
  const Normal3 up(0, 0, 1);
  const IrradianceEstimate centre = air.At(p, up, 1);
  const double scale = double(centre.irradiance[0]);
  ASSERT_GT(scale, .1);
  const Real h = Real(.1);
  for (const Vector3 step : {Vector3(h, 0, 0), Vector3(0, h, 0)}) {
    const double change = double(air.At(p + step, up, 2).irradiance[0]) -
                          double(air.At(p - step, up, 3).irradiance[0]);
    const double slope = change / (2 * double(h));
    EXPECT_NEAR(double(Dot(centre.translation[0], step / h)), slope, .05 * scale);
  }
  for (const Vector3 axis : {Vector3(1, 0, 0), Vector3(0, 1, 0)}) {
    const Vector3 turned = Cross(axis, up) * h;
    const Normal3 more = NormalizeOr(up + turned, up), less = NormalizeOr(up - turned, up);
    const double change =
        double(air.At(p, more, 4).irradiance[0]) - double(air.At(p, less, 5).irradiance[0]);
    EXPECT_NEAR(double(Dot(centre.rotation[0], axis)), change / (2 * double(h)), .05 * scale);
  }
  EXPECT_GT(double(Length(centre.translation[0])), .2 * scale);
  EXPECT_GT(double(Length(centre.rotation[0])), .2 * scale);
}

// Emission, direct light and d bounces: the sum of .5^i for i up to d + 1.
TEST(IrradianceCache, InAFurnaceShowsThePartialSumOfItsDepth) {
  for (const int depth : {0, 1, 3}) {
    const std::string scene =
        TestHeader("\"irradiancecache\" \"integer nsamples\" 64 \"integer maxindirectdepth\" " +
                       std::to_string(depth),
                   8, 8, 4) +
        FurnaceWorld(1, R"("matte" "color Kd" [.5 .5 .5])");
    double truth = 0;
    for (int i = 0; i <= depth + 1; ++i) truth += std::pow(.5, i);
    EXPECT_TRUE(IsWithin(.003, CacheMean(scene), truth)) << depth;
  }
}

// Every record is too small for any point, so that each point takes rays of its own.
TEST(IrradianceCache, WithoutAValidRecordTakesAFreshEstimate) {
  const std::string scene =
      TestHeader(
          "\"irradiancecache\" \"integer nsamples\" 256 \"float maxpixelspacing\" 1e-6 "
          "\"float minpixelspacing\" 0",
          8, 8, 16) +
      FurnaceWorld(1, R"("matte" "color Kd" [.5 .5 .5])");
  EXPECT_TRUE(IsWithin(.005, CacheMean(scene), 1.9375));
}

std::string CacheQuad(const std::string& points) {
  return "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] \"point P\" [" + points + "]\n";
}
std::string CacheRoom(const std::string& integrator, int samples, const std::string& more = "") {
  return TestHeader(integrator, 24, 24, samples) +
         "WorldBegin\nMaterial \"matte\" \"color Kd\" [.7 "
         ".6 .5]\n" +
         CacheQuad("-2 -2 0  2 -2 0  2 -2 5  -2 -2 5") + CacheQuad("-2 2 0  2 2 0  2 2 5  -2 2 5") +
         CacheQuad("-2 -2 5  2 -2 5  2 2 5  -2 2 5") +
         CacheQuad("-2 -2 0  -2 -2 5  -2 2 5  -2 2 0") + CacheQuad("2 -2 0  2 -2 5  2 2 5  2 2 0") +
         "AttributeBegin\nAreaLightSource \"area\" \"color L\" [3 3 3]\n" +
         CacheQuad("-1 1.9 2  1 1.9 2  1 1.9 4  -1 1.9 4") + "AttributeEnd\n" + more +
         "Translate 0 -1 3\nShape \"sphere\" \"float radius\" .8\nWorldEnd\n";
}
const std::string kTranslucentBlind =
    "AttributeBegin\nMaterial \"translucent\" \"color Kd\" [.8 .8 .8] \"color Ks\" [0 0 0]\n" +
    CacheQuad("-1.5 .5 1.5  1.5 .5 1.5  1.5 .5 4  -1.5 .5 4") + "AttributeEnd\n";
const std::string kGlossyFloor =
    "AttributeBegin\nMaterial \"plastic\" \"color Kd\" [.4 .4 .4] \"color Ks\" [.6 .6 .6] \"float "
    "roughness\" "
    ".1\n" +
    CacheQuad("-2 -1.99 0  2 -1.99 0  2 -1.99 5  -2 -1.99 5") + "AttributeEnd\n";
const std::string kMoving =
    "AttributeBegin\nActiveTransform EndTime\nTranslate .8 0 0\nActiveTransform All\nTranslate -1 "
    ".6 3\nShape \"sphere\" \"float radius\" .5\nAttributeEnd\n";

TEST(IrradianceCache, AgreesWithPathTracingOfTheSameDepth) {
  for (const std::string& more : {std::string(), kTranslucentBlind, kGlossyFloor, kMoving}) {
    // The bounds in pixels are for larger pictures.
    const std::string cached =
        "\"irradiancecache\" \"integer nsamples\" 256 \"float maxerror\" .1 \"float "
        "minpixelspacing\" .5";
    EXPECT_TRUE(
        AgreeInBlocks(.05, EstimateBlocks(CacheRoom(cached, 16, more)),
                      EstimateBlocks(CacheRoom("\"path\" \"integer maxdepth\" 3", 128, more))))
        << more;
  }
}

double Records(const std::string& parameters) {
  const std::string few = "\"irradiancecache\" \"integer nsamples\" 16 ";
  return RenderCached(CacheRoom(few + parameters, 1)).Counter("irradiance/records");
}

TEST(IrradianceCache, PlacesMoreRecordsForSmallerErrorsSpacingsAndAngles) {
  const std::string wide = "\"float maxpixelspacing\" 1000 \"float minpixelspacing\" 0 ";
  const double plain = Records(wide);
  EXPECT_GT(plain, 10);
  EXPECT_GT(Records(wide + "\"float maxerror\" .05"), 1.5 * plain);
  EXPECT_LT(Records(wide + "\"float maxerror\" .8"), plain);
  EXPECT_GT(Records("\"float minpixelspacing\" 0 \"float maxpixelspacing\" 1"), 1.2 * plain);
  EXPECT_LT(Records("\"float maxpixelspacing\" 1000 \"float minpixelspacing\" 20"), .8 * plain);
  EXPECT_GT(Records(wide + "\"float minweight\" 3"), 1.2 * plain);
  EXPECT_GT(Records(wide + "\"float maxangledifference\" 2"),
            1.05 * Records(wide + "\"float maxangledifference\" 60"));
}

TEST(IrradianceCache, TakesTheStatedNumberOfRaysForARecord) {
  const TestRender render = RenderCached(
      CacheRoom("\"irradiancecache\" \"integer nsamples\" 100 \"integer maxindirectdepth\" 1", 1));
  const double gathered = double(render.rays.counts[std::size_t(RayKind::Gather)]);
  EXPECT_NEAR(gathered / (100 * render.Counter("irradiance/records")), 1, .1);
}

TEST(IrradianceCache, FollowsMirrorsToItsSpecularDepth) {
  const std::string mirror = "AttributeBegin\nMaterial \"mirror\"\n" +
                             CacheQuad("-1.9 -1.9 4.9  1.9 -1.9 4.9  1.9 1.9 4.9  -1.9 1.9 4.9") +
                             "AttributeEnd\n";
  const std::string cached =
      "\"irradiancecache\" \"integer nsamples\" 64 \"integer "
      "maxspeculardepth\" ";
  const TestRender none = RenderCached(CacheRoom(cached + "0", 1, mirror));
  const TestRender one = RenderCached(CacheRoom(cached + "1", 1, mirror));
  const PixelBounds middle{9, 8, 15, 12};
  EXPECT_EQ(MeanRadiance(none.image, middle), 0);
  EXPECT_GT(MeanRadiance(one.image, middle), .1);
}

// Rays through the centres of pixels on the diagonals meet the edges of this box, where a point
// lies in the plane of the other wall. The lamp is outside.
TEST(IrradianceCache, SeesNoLightThroughTheEdgesOfARoom) {
  std::ostringstream box;
  for (const int axis : {0, 1, 2})
    for (const int side : {-2, 2}) {
      box << "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] \"point P\" [";
      for (const auto& [u, v] : {std::pair{-2, -2}, {2, -2}, {2, 2}, {-2, 2}}) {
        const int values[] = {side, u, v};
        for (const int c : {0, 1, 2}) box << values[(c + 3 - axis) % 3] << ' ';
      }
      box << "]\n";
    }
  const std::string scene =
      TestHeader("\"irradiancecache\" \"integer nsamples\" 512", 24, 18, 4) +
      "LookAt 0 0 -1.9  0 0 0  0 1 0\nCamera \"perspective\" \"float fov\" [60]\nWorldBegin\n"
      "Material \"matte\" \"color Kd\" [.5 .5 .5]\n" +
      box.str() +
      "AreaLightSource \"area\" \"color L\" [1 1 1]\nReverseOrientation\n"
      "Shape \"sphere\" \"float radius\" [3.7]\nWorldEnd\n";
  for (const std::uint64_t seed : {1, 2}) {
    const Image image = RenderCached(scene, seed).image;
    for (int y = 0; y < 18; ++y)
      for (int x = 0; x < 24; ++x) ASSERT_EQ(image.At(x, y, 1), 0) << x << ' ' << y;
  }
}

TEST(IrradianceCache, GivesTheSameBitsForAnyThreadsTilesAndCrop) {
  const std::string scene = CacheRoom("\"irradiancecache\" \"integer nsamples\" 64", 2,
                                      kTranslucentBlind + kGlossyFloor + kMoving);
  TestRenderOptions options;
  const Image one = RenderSceneText(scene, options).image;
  for (const int threads : {2, 4}) {
    options.threads = threads;
    options.tileSize = 5;
    options.tileOrder = TileOrder::Reversed;
    options.load.pixelBounds = PixelBounds{5, 3, 17, 20};
    const Image crop = RenderSceneText(scene, options).image;
    for (int y = 0; y < crop.Height(); ++y)
      for (int x = 0; x < crop.Width(); ++x)
        for (int c = 0; c < 4; ++c) ASSERT_EQ(crop.At(x, y, c), one.At(x + 5, y + 3, c));
  }
}

}  // namespace
}  // namespace exphoton
