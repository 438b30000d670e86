// SPDX-License-Identifier: BSD-2-Clause
// These tests compare participating media with closed forms: the Beer-Lambert law for every kind of
// ray and density, emission, and single scattering in a slab under parallel light.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/equivalence.h"
#include "tests/support/test_scene.h"

namespace exphoton {
namespace {

// Returns a narrow orthographic view along +z from the origin. The medium fills 1 <= z <= 4 and is
// far wider than the view.
std::string Header(const std::string& integrator, const std::string& volumeIntegrator) {
  return "Camera \"orthographic\" \"float screenwindow\" [-.1 .1 -.1 .1]\n"
         "Film \"image\" \"integer xresolution\" 4 \"integer yresolution\" 4\n"
         "PixelFilter \"box\"\nSampler \"random\" \"integer xsamples\" 4 \"integer ysamples\" 4\n"
         "SurfaceIntegrator " +
         integrator + "\nVolumeIntegrator " + volumeIntegrator + "\nWorldBegin\n";
}
std::string Slab(const std::string& kind, const std::string& parameters) {
  return "Volume \"" + kind + "\" \"point p0\" [-50 -50 1] \"point p1\" [50 50 4] " + parameters +
         "\n";
}
// This disk at z = 5 faces the camera.
const std::string kDisk =
    "AttributeBegin Translate 0 0 5 ReverseOrientation Shape \"disk\" \"float radius\" 3 "
    "AttributeEnd\n";
const std::string kEmitter = "AreaLightSource \"area\" \"color L\" [2 2 2]\n" + kDisk;
const std::string kBlackDisk = "Material \"matte\" \"color Kd\" [0 0 0]\n" + kDisk;

const char* const kIntegrators[] = {
    "\"whitted\"",
    "\"directlighting\"",
    "\"path\"",
    "\"bidirectional\"",
    "\"igi\" \"integer nlights\" 1",
    "\"irradiancecache\" \"integer nsamples\" 4",
    "\"photonmap\" \"integer indirectphotons\" 0 \"bool finalgather\" \"false\"",
    "\"exphotonmap\" \"integer indirectphotons\" 0 \"bool finalgather\" \"false\""};

// Density is one of the three kinds of density, with its integral along the view.
struct Density {
  std::string kind, parameters;
  double integral;
};
std::vector<Density> Densities() {
  return {
      {"homogeneous", "", 3},
      {"exponential", "\"float a\" 2 \"float b\" .5 \"vector updir\" [0 0 1]",
       4 * (1 - std::exp(-1.5))},
      {"exponential", "\"float a\" 2 \"float b\" .5 \"vector updir\" [0 1 0]", 6 * std::exp(-25.0)},
      // The density is linear between the cell centres 1.5, 2.5 and 3.5, and constant beyond them.
      {"volumegrid", "\"integer nz\" 3 \"float density\" [1 2 .5]", .5 + 1.5 + 1.25 + .25}};
}

TEST(Media, AbsorbWhatTheCameraSeesThroughThem) {
  for (const Density& density : Densities()) {
    for (const char* integrator : kIntegrators) {
      const TestRender render =
          RenderSceneText(Header(integrator, "\"emission\"") +
                          Slab(density.kind, "\"color sigma_a\" [.1 .2 .4] " + density.parameters) +
                          kEmitter + "WorldEnd\n");
      const double sigma[] = {.1, .2, .4};
      for (int c = 0; c < 3; ++c) {
        const double expected = 2 * std::exp(-sigma[c] * density.integral);
        EXPECT_NEAR(MeanChannel(render.image, std::string(1, "RGB"[c])), expected, 1e-5 * expected)
            << density.kind << " " << integrator << " channel " << c;
      }
    }
  }
}

TEST(Media, AbsorbTheSameAtEverySlant) {
  // The Volume's transformation scales the medium, and the camera looks along a diagonal.
  const TestRender render = RenderSceneText(
      "LookAt 0 0 0  0 .6 .8  0 1 0\n" + Header("\"directlighting\"", "\"emission\"") +
      "AttributeBegin Scale 2 2 2 Volume \"volumegrid\" \"point p0\" [-50 -50 .5] "
      "\"point p1\" [50 50 2] \"color sigma_a\" [.3 .3 .3] \"integer nz\" 3 "
      "\"float density\" [1 2 .5] AttributeEnd\n"
      "LightSource \"infinite\" \"color L\" [1 1 1]\nWorldEnd\n");
  EXPECT_NEAR(MeanRadiance(render.image), std::exp(-.3 * 3.5 / .8), 2e-4);
}

// Expects the radiance of the disk in the world from every integrator, and from photons that are
// stored on the disk.
void ExpectLitThroughMedia(const std::string& world, double expected, int photons,
                           double tolerance) {
  for (const char* integrator : kIntegrators) {
    const TestRender render = RenderSceneText(Header(integrator, "\"emission\"") + world);
    EXPECT_NEAR(MeanRadiance(render.image), expected, 1e-4 * expected) << integrator;
  }
  const std::string header =
      Header("\"photonmap\" \"bool directwithphotons\" \"true\" \"integer directphotons\" " +
                 std::to_string(photons) +
                 " \"integer indirectphotons\" 0 \"integer nused\" 8000 \"float maxdist\" 1",
             "\"emission\"");
  const auto measure = [&](std::uint64_t seed) {
    TestRenderOptions options;
    options.seed = seed;
    options.load.samplesPerPixel = 1;
    return MeanRadiance(RenderSceneText(header + world, options).image);
  };
  EXPECT_TRUE(IsWithin(tolerance, EstimateOverSeeds(measure), expected));
}
const char* const kLitDisk =
    "LightSource \"distant\" \"point from\" [0 0 0] \"point to\" [0 0 1]\n"
    "Material \"matte\" \"color Kd\" [.5 .5 .5]\n";

TEST(Media, AbsorbWhatLightsASurfaceBehindThem) {
  const std::string world = Slab("homogeneous", "\"color sigma_a\" [.3 .3 .3]") + kLitDisk;
  ExpectLitThroughMedia(world + kDisk + "WorldEnd\n", .5 / M_PI * std::exp(-.9) * std::exp(-.9),
                        100000, .01);
}

// Photons start near the surfaces, so the medium that they would cross before counts too.
TEST(Media, AbsorbTheLightOfPhotonsThatStartInside) {
  const std::string small =
      "AttributeBegin Translate 0 0 5 ReverseOrientation Shape \"disk\" \"float radius\" .7 "
      "AttributeEnd\n";
  const std::string scene =
      Header(
          "\"photonmap\" \"bool directwithphotons\" \"true\" \"integer directphotons\" 20000 "
          "\"integer indirectphotons\" 0 \"bool finalgather\" \"false\"",
          "\"emission\"") +
      Slab("homogeneous", "\"color sigma_a\" [.3 .3 .3]") + kLitDisk + small + "WorldEnd\n";
  EXPECT_NEAR(MeanRadiance(RenderSceneText(scene).image), .5 / M_PI * std::exp(-1.8), .03 * .0263);
}

// A small disk sees the light that a larger one reflects, and the camera sees the small one.
TEST(Media, AbsorbTheLightOfPathsThatStartInside) {
  const auto measure = [](const std::string& integrator, std::uint64_t seed) {
    TestRenderOptions options;
    options.seed = seed;
    const std::string scene =
        "LookAt 0 0 4.8 0 0 4 0 1 0\nCamera \"perspective\" \"float fov\" 20\n"
        "Film \"image\" \"integer xresolution\" 4 \"integer yresolution\" 4\n"
        "PixelFilter \"box\"\nSampler \"random\" \"integer xsamples\" 8 \"integer ysamples\" 8\n"
        "SurfaceIntegrator " +
        integrator + "\nVolumeIntegrator \"emission\"\nWorldBegin\n" +
        Slab("homogeneous", "\"color sigma_a\" [.3 .3 .3]") + kLitDisk +
        "AttributeBegin Translate 0 0 5 Shape \"disk\" \"float radius\" .7 AttributeEnd\n"
        "AttributeBegin Translate 0 0 4.5 Shape \"disk\" \"float radius\" .3 AttributeEnd\n"
        "WorldEnd\n";
    return MeanRadiance(RenderSceneText(scene, options).image);
  };
  const auto mean = [&](const std::string& integrator) {
    double sum = 0;
    for (std::uint64_t seed = 0; seed < 10; ++seed) sum += measure(integrator, seed) / 10;
    return sum;
  };
  const double expected = mean("\"path\" \"integer maxdepth\" 8");
  EXPECT_NEAR(mean("\"bidirectional\" \"integer maxdepth\" 8"), expected, .05 * expected);
  EXPECT_NEAR(mean("\"exphotonmap\" \"integer indirectphotons\" 20000"), expected, .05 * expected);
}

// The medium continues behind the disk. Only the medium in front of the disk may absorb, for
// every kind of ray.
TEST(Media, AbsorbOnlyOnTheWayToTheSurface) {
  const std::string world =
      "Volume \"homogeneous\" \"point p0\" [-50 -50 1] \"point p1\" [50 50 50] \"color sigma_a\" "
      "[.3 .3 .3]\n" +
      std::string(kLitDisk);
  ExpectLitThroughMedia(world + kDisk + "WorldEnd\n", .5 / M_PI * std::exp(-1.2) * std::exp(-1.2),
                        20000, .03);
}

// The medium lies behind a wide lamp. BSDF-sampled rays towards the light end at the lamp, so the
// irradiance is E = pi L R^2 / (R^2 + h^2).
TEST(Media, DoNotAbsorbTheLightOfALampBeforeThem) {
  const std::string world =
      "Volume \"homogeneous\" \"point p0\" [-900 -900 -900] \"point p1\" [900 900 -1.5] "
      "\"color sigma_a\" [1 1 1]\nAttributeBegin Translate 0 0 -1\n"
      "Material \"matte\" \"color Kd\" [0 0 0]\n"
      "AreaLightSource \"area\" \"color L\" [1 1 1] \"integer nsamples\" 4\n"
      "Shape \"disk\" \"float radius\" 20 AttributeEnd\n"
      "Material \"matte\" \"color Kd\" [.5 .5 .5]\n" +
      kDisk + "WorldEnd\n";
  for (const char* integrator : {"\"directlighting\"", "\"path\""}) {
    const auto measure = [&](std::uint64_t seed) {
      TestRenderOptions options;
      options.seed = seed;
      options.load.samplesPerPixel = 1024;
      return MeanRadiance(
          RenderSceneText(Header(integrator, "\"emission\"") + world, options).image);
    };
    EXPECT_TRUE(IsWithin(.01, EstimateOverSeeds(measure), .5 * 400 / 436)) << integrator;
  }
}

TEST(Media, EmitWithoutBias) {
  const double sigma = .7;
  const auto measure = [&](std::uint64_t seed) {
    TestRenderOptions options;
    options.seed = seed;
    return MeanRadiance(
        RenderSceneText(Header("\"directlighting\"", "\"emission\" \"float stepsize\" .3") +
                            Slab("homogeneous",
                                 "\"color sigma_a\" [.7 .7 .7] \"color Le\" "
                                 "[1 1 1]") +
                            kBlackDisk + "WorldEnd\n",
                        options)
            .image);
  };
  EXPECT_TRUE(IsWithin(.01, EstimateOverSeeds(measure), (1 - std::exp(-3 * sigma)) / sigma));
}

// Light travels at the angle theta to the view and is scattered once. The radiance is the integral
// of E sigma_s p exp(-sigma_t s (1 + 1 / cos theta)) over the depth s.
TEST(Media, ScatterParallelLightOnceAsTheSlabFormulaSays) {
  for (const double g : {0.0, .5, -.4}) {
    const double sigmaS = .3, sigmaT = .5, cosine = .8;
    const double base = 1 + g * g + 2 * g * cosine;
    const double phase = (1 - g * g) / (4 * 3.14159265358979 * base * std::sqrt(base));
    const double rate = sigmaT * (1 + 1 / cosine);
    const double expected = sigmaS * phase * (1 - std::exp(-3 * rate)) / rate;
    for (const char* integrator : {"\"directlighting\"", "\"path\""}) {
      const auto measure = [&](std::uint64_t seed) {
        TestRenderOptions options;
        options.seed = seed;
        const std::string coefficients =
            "\"color sigma_s\" [.3 .3 .3] \"color sigma_a\" "
            "[.2 .2 .2] \"float g\" " +
            std::to_string(g);
        return MeanRadiance(
            RenderSceneText(
                Header(integrator, "\"single\" \"float stepsize\" .25") +
                    Slab("homogeneous", coefficients) +
                    "LightSource \"distant\" \"point from\" [0 0 0] \"point to\" [.6 0 .8]\n" +
                    kBlackDisk + "WorldEnd\n",
                options)
                .image);
      };
      EXPECT_TRUE(IsWithin(.01, EstimateOverSeeds(measure), expected)) << g << integrator;
    }
  }
}

// Two lights shine at the same angle to the view from opposite sides, and one is three times as
// bright as the other. Together they must give four times the light of the dimmer light.
TEST(Media, ScatterTheLightOfEveryLight) {
  const double rate = .5 * (1 + 1 / .8);
  const double expected = 4 * .3 / (4 * M_PI) * (1 - std::exp(-3 * rate)) / rate;
  const auto measure = [&](std::uint64_t seed) {
    TestRenderOptions options;
    options.seed = seed;
    return MeanRadiance(
        RenderSceneText(
            Header("\"directlighting\"", "\"single\" \"float stepsize\" .25") +
                Slab("homogeneous", "\"color sigma_s\" [.3 .3 .3] \"color sigma_a\" [.2 .2 .2]") +
                "LightSource \"distant\" \"point from\" [0 0 0] \"point to\" [.6 0 .8]\n"
                "LightSource \"distant\" \"point from\" [0 0 0] \"point to\" [-.6 0 .8] "
                "\"color L\" [3 3 3]\n" +
                kBlackDisk + "WorldEnd\n",
            options)
            .image);
  };
  EXPECT_TRUE(IsWithin(.02, EstimateOverSeeds(measure), expected));
}

TEST(Media, LeftOutOfThePlanLeaveTheSceneAsItIsWithoutThem) {
  const std::string head = Header("\"path\"", "\"single\"");
  TestRenderOptions off;
  off.load.effects = "media=off";
  const std::string slab = Slab("homogeneous", "\"color sigma_s\" [.3 .3 .3]");
  const TestRender without = RenderSceneText(head + kEmitter + "WorldEnd\n");
  const TestRender left = RenderSceneText(head + slab + kEmitter + "WorldEnd\n", off);
  EXPECT_EQ(without.image.pixels, left.image.pixels);
  EXPECT_TRUE(left.Says("media"));
}

TEST(Media, LeaveLightAovsThatSumToThePicture) {
  TestRenderOptions options;
  options.aovs = kLightAovs;
  for (const char* integrator : kIntegrators) {
    const TestRender render = RenderSceneText(
        Header(integrator, "\"single\"") +
            Slab("homogeneous", "\"color sigma_s\" [.1 .2 .3] \"color Le\" [.1 .1 .1]") +
            "LightSource \"distant\" \"point from\" [0 0 0] \"point to\" [.6 0 .8]\n"
            "Material \"matte\" \"color Kd\" [.5 .5 .5]\n" +
            kDisk + "WorldEnd\n",
        options);
    for (const std::string channel : {"R", "G", "B"}) {
      double sum = 0;
      for (const char* aov : {"emission.", "direct.", "caustic.", "indirect.", "specular."})
        sum += MeanChannel(render.image, aov + channel);
      const double picture = MeanChannel(render.image, channel);
      EXPECT_GT(picture, 0);
      EXPECT_NEAR(sum, picture, 1e-5 * picture) << integrator;
    }
  }
}

TEST(Media, AreFiniteAtExtremeDensities) {
  for (const char* sigma : {"1e30", "1e-30", "0"}) {
    for (const Density& density : Densities()) {
      const std::string s(sigma);
      const TestRender render =
          RenderSceneText(Header("\"path\"", "\"single\" \"float stepsize\" 1e-2") +
                          Slab(density.kind, "\"color sigma_s\" [" + s + " " + s + " " + s + "] " +
                                                 density.parameters) +
                          kEmitter + "WorldEnd\n");
      EXPECT_EQ(render.result.nonFiniteSamples, 0);
      EXPECT_GE(MeanRadiance(render.image), 0);
    }
  }
}

// From sixteen lights on the light of a step is chosen by power and distance. The light that a fog
// scatters must still be the sum over the lights, and lights near the view must not be dots.
TEST(Media, ScatterTheSumOfManyLights) {
  std::vector<std::string> lights;
  for (int i = 0; i < 20; ++i)
    lights.push_back("LightSource \"point\" \"color I\" [1 1 1] \"point from\" [" +
                     std::to_string(i % 5 - 2) + ".3 " + std::to_string(i / 5 - 2) + ".4 " +
                     std::to_string(1 + i * 7 % 20 * .15) + "]\n");
  const std::string header = Header("\"directlighting\"", "\"single\" \"float stepsize\" .2") +
                             Slab("homogeneous", "\"color sigma_s\" [.1 .1 .1]");
  const auto mean = [&](const std::string& world, int samples) {
    return EstimateOverSeeds([&](std::uint64_t seed) {
      TestRenderOptions options;
      options.seed = seed;
      options.load.samplesPerPixel = samples;
      return MeanRadiance(RenderSceneText(header + world + "WorldEnd\n", options).image);
    });
  };
  double sum = 0;
  std::string all;
  for (const std::string& light : lights) {
    sum += mean(light, 16).mean;
    all += light;
  }
  EXPECT_TRUE(IsWithin(.02, mean(all, 256), sum));
}

}  // namespace
}  // namespace exphoton
