// SPDX-License-Identifier: BSD-2-Clause
// These tests check photons of distant lights that start towards the points that the camera sees.
// Power times density must be one, no power may be lost, and a small object in a wide world must
// receive photons.
#include "integrators/photon/shooting/distant_light_targeting.h"

#include <gtest/gtest.h>

#include "core/math/sampling/low_discrepancy.h"
#include "tests/support/test_scene.h"

namespace exphoton {
namespace {

const Sphere3 kWorld{{100, -50, 3}, 1000};
constexpr double kShare = .02;
const Vector3 kDown = NormalizeOr(Vector3{1, 2, -3}, {});

// Returns points on a square about p with this side.
std::vector<Point3> Square(const Point3& p, Real side, std::uint32_t count) {
  std::vector<Point3> points;
  for (std::uint32_t i = 0; i < count; ++i) {
    const Point2 u = ScrambledSobol2(i, 7);
    points.push_back(p + Vector3{side * (u.x - Real(.5)), side * (u.y - Real(.5)), 0});
  }
  return points;
}

LightLeSample Uniform() {
  const Real area = kPi * kWorld.radius * kWorld.radius;
  return {Ray{kWorld.center, kDown}, Spectrum(area), 1 / area, 1};  // radiance 1
}

TEST(DistantLightTargeting, OfTooFewPointsIsNone) {
  EXPECT_TRUE(DistantLightTargeting().IsEmpty());
  EXPECT_TRUE(DistantLightTargeting(Square({0, 0, 0}, 1, 3), kWorld, kShare).IsEmpty());
  EXPECT_TRUE(DistantLightTargeting(Square({0, 0, 0}, 1, 100), Sphere3{}, kShare).IsEmpty());
}

// The mean power of photons that start within a disk must be the disk's area, because the radiance
// is 1. The test covers the whole world and parts near and far from the wanted points. With 2^18
// points the error is about .2 %, and 1 % in far parts.
TEST(DistantLightTargeting, LosesNoPowerAnywhere) {
  const Point3 wanted = kWorld.center + Vector3{300, 200, 0};
  const DistantLightTargeting targeting(Square(wanted, 4, 500), kWorld, kShare);
  const Frame frame = Frame::FromZ(-kDown);
  struct Part {
    Point3 center;
    Real radius;
    double tolerance;
  };
  const Part parts[]{{kWorld.center, 1000, .02},
                     {wanted, 2, .01},
                     {wanted, 30, .01},
                     {wanted + Vector3{40, 0, 0}, 20, .04},
                     {kWorld.center - Vector3{400, 0, 0}, 300, .04}};
  constexpr std::uint32_t kCount = 1 << 18;
  std::vector<double> power(std::size(parts), 0.0);
  for (std::uint32_t i = 0; i < kCount; ++i) {
    LightLeSample emission = Uniform();
    targeting.Redirect(&emission, ScrambledSobol2(i, 11));
    EXPECT_NEAR(double(emission.pdfPosition * emission.power.r), 1, 1e-4);
    for (std::size_t k = 0; k < std::size(parts); ++k) {
      const Vector3 d = emission.ray.o - parts[k].center;
      if (std::hypot(Dot(d, frame.x), Dot(d, frame.y)) < parts[k].radius)
        power[k] += double(emission.power.r) / kCount;
    }
  }
  for (std::size_t k = 0; k < std::size(parts); ++k) {
    const double area = double(kPi) * double(parts[k].radius) * double(parts[k].radius);
    EXPECT_NEAR(power[k] / area, 1, parts[k].tolerance) << k;
  }
}

// The gain is a median. The photons that start over the whole square give the mean gain, which
// is close to it.
TEST(DistantLightTargeting, GainsWhatPhotonsThatStartOverTheWantedPointsAreDenser) {
  for (const Real side : {Real(2), Real(20), Real(200)}) {
    const DistantLightTargeting targeting(Square(kWorld.center, side, 1000), kWorld, kShare);
    constexpr std::uint32_t kCount = 1 << 16;
    int over = 0;
    for (std::uint32_t i = 0; i < kCount; ++i) {
      LightLeSample emission = Uniform();
      emission.ray.d = {0, 0, -1};
      targeting.Redirect(&emission, ScrambledSobol2(i, 5));
      const Vector3 d = emission.ray.o - kWorld.center;
      over += std::max(std::abs(d.x), std::abs(d.y)) < side / 2;
    }
    const double share = double(side) * double(side) / (double(kPi) * 1e6);
    EXPECT_NEAR(over / (kCount * share) / targeting.Gain(), 1, .15) << side;
    EXPECT_GT(targeting.Gain(), 1 / (20 * share))
        << side;  // a twentieth of the largest possible gain
  }
  EXPECT_LT(DistantLightTargeting(Square(kWorld.center, 1800, 1000), kWorld, kShare).Gain(), 4);
}

TEST(DistantLightTargeting, OfPointsOnOneSpotIsFinite) {
  const DistantLightTargeting targeting(std::vector<Point3>(1000, kWorld.center), kWorld, kShare);
  for (std::uint32_t i = 0; i < 1000; ++i) {
    LightLeSample emission = Uniform();
    targeting.Redirect(&emission, ScrambledSobol2(i, 3));
    EXPECT_TRUE(emission.power.IsFinite());
    EXPECT_GT(emission.pdfPosition, 0);
  }
}

// Returns a plate of 2 x 2 at the middle of a plain of 2000 x 2000, seen from above.
std::string Plain(const std::string& light, const std::string& integrator) {
  return "LookAt 0 0 3  0 0 1  0 1 0\nCamera \"perspective\" \"float fov\" 20\nFilm \"image\" "
         "\"integer xresolution\" 16 \"integer yresolution\" 16\nPixelFilter \"box\"\nSampler "
         "\"lowdiscrepancy\" \"integer pixelsamples\" 4\nSurfaceIntegrator \"exphotonmap\" "
         "\"integer indirectphotons\" 20000 \"string show\" \"directphotons\" " +
         integrator + "\nWorldBegin\n" + light +
         "\nMaterial \"matte\" \"color Kd\" [.5 .5 .5]\nShape \"trianglemesh\" \"integer indices\" "
         "[0 1 2 0 2 3] \"point P\" [-1000 -1000 0 1000 -1000 0 1000 1000 0 -1000 1000 0]\n"
         "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] \"point P\" "
         "[-1 -1 1 1 -1 1 1 1 1 -1 1 1]\nWorldEnd\n";
}

// The irradiance is L cos(theta) for the sun and pi L for the sky, and the radiance is the
// irradiance times the reflectance .5 over pi. With about 10^4 photons on the plate and 50 per
// estimate, the mean over the picture is within 1 %.
TEST(DistantLightTargeting, CoversASmallObjectInAWideWorld) {
  const std::string sun =
      "LightSource \"distant\" \"color L\" [4 4 4] \"point from\" [3 0 4] \"point to\" [0 0 0]";
  const TestRender bySun = RenderSceneText(Plain(sun, ""));
  EXPECT_TRUE(bySun.Says("times denser"));
  EXPECT_NEAR(MeanRadiance(bySun.image), 4 * .8 * .5 / 3.14159265, .01);
  const TestRender bySky =
      RenderSceneText(Plain("LightSource \"infinite\" \"color L\" [1 1 1]", ""));
  EXPECT_NEAR(MeanRadiance(bySky.image), .5, .01);
}

TEST(DistantLightTargeting, IsLeftOutWhereItIsOfNoUse) {
  const std::string sun = "LightSource \"distant\" \"point from\" [0 0 3]";
  EXPECT_FALSE(RenderSceneText(Plain(sun, "\"string photonaim\" \"off\"")).Says("times denser"));
  EXPECT_FALSE(RenderSceneText(Plain("LightSource \"point\" \"point from\" [0 0 5]", ""))
                   .Says("times denser"));
}

TEST(DistantLightTargeting, IsSuggestedWhereItIsOffAndLightIsMissing) {
  const std::string sun = "LightSource \"distant\" \"point from\" [0 0 3]";
  const std::string words = "photons of distant lights are spread over the whole scene";
  const TestRender off = RenderSceneText(Plain(sun, "\"string photonaim\" \"off\""));
  EXPECT_TRUE(off.Says(words));
  EXPECT_FALSE(RenderSceneText(Plain(sun, "")).Says(words));
  EXPECT_FALSE(RenderSceneText(Plain("LightSource \"point\" \"point from\" [0 0 5]",
                                     "\"string photonaim\" \"off\""))
                   .Says(words));
}

TEST(CausticPhotons, AskedForInVainGiveANotice) {
  const auto render = [](const std::string& integrator) {
    return RenderSceneText(TestHeader(integrator + " \"integer indirectphotons\" 500", 4, 4, 1) +
                           FurnaceWorld(1, "\"matte\""));
  };
  EXPECT_TRUE(
      render("\"exphotonmap\" \"integer causticphotons\" 100")
          .Says("causticphotons 100: no photons are shot for caustics (no specular surface)"));
  EXPECT_FALSE(render("\"exphotonmap\" \"integer causticphotons\" 0").Says("causticphotons"));
  EXPECT_FALSE(render("\"exphotonmap\"").Says("causticphotons"));
}

}  // namespace
}  // namespace exphoton
