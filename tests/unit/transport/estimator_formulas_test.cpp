// SPDX-License-Identifier: BSD-2-Clause
// These tests compare single estimates with their formulas in double: light samples with MIS
// weights, estimates of direct light, shading-normal factors, and the marching of media with given
// random numbers.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "core/base/arena.h"
#include "core/math/sampling/random.h"
#include "core/sampling/sampler.h"
#include "core/scattering/lobes/lambert.h"
#include "core/scattering/lobes/microfacet.h"
#include "core/scattering/lobes/specular.h"
#include "core/transport/direct_lighting.h"
#include "core/transport/light_sample.h"
#include "core/transport/shading_normal.h"
#include "core/transport/volume_integrator.h"
#include "tests/support/scattering.h"
#include "tests/support/test_scene.h"

namespace exphoton {
namespace {

class EstimatorFormulas : public testing::Test {
 protected:
  void Load(const std::string& world, const std::string& options = {}) {
    loaded_ = LoadSceneText(options + "WorldBegin\n" + world + "WorldEnd\n");
  }
  const Scene& TheScene() const { return *loaded_.setup->scene; }
  LiContext Context() { return {TheScene(), samples_, arena_, rays_, 7}; }

  LoadedScene loaded_;
  CameraSamples samples_{SampleLayout()};
  Arena arena_;
  RayCounters rays_;
};

// A plane z = 0 with a tilted shading normal, seen from above.
SurfaceInteraction Receiver() {
  SurfaceInteraction si = TiltedSurface(Radians(20));
  si.wo = Normalize(Vector3(Real(-.3), Real(.2), 1));
  return si;
}

double Weight(double nf, double pf, double ng, double pg) {
  return nf * pf * nf * pf / (nf * pf * nf * pf + ng * pg * ng * pg);
}

// f L |wi.ns| weight / (probability pdf). Fog of optical depth .2 per unit is on the way.
TEST_F(EstimatorFormulas, OfALightSampleHaveTheWeightOfBothCounts) {
  Load(
      "Volume \"homogeneous\" \"point p0\" [-9 -9 1] \"point p1\" [9 9 2] \"color sigma_a\" [.2 .2 "
      ".2]\nAttributeBegin AreaLightSource \"area\" \"color L\" [3 2 1] Translate 0 0 4 "
      "ReverseOrientation Shape \"disk\" \"float radius\" 2 AttributeEnd\n");
  const Light& lamp = *TheScene().Lights()[0];
  const SurfaceInteraction si = Receiver();
  const Lambert matte({Real(.5), Real(.4), Real(.3)});
  const Microfacet gloss({Real(.2), Real(.3), Real(.4)}, Fresnel::None(), 4);
  const SpecularReflection mirror(Spectrum(Real(.1)), Fresnel::None());
  Bsdf bsdf(si);
  bsdf.Add(&matte);
  bsdf.Add(&gloss);
  bsdf.Add(&mirror);
  const ShadingPoint point{si, bsdf, {}, 0};
  RandomStream random(1);
  for (int i = 0; i < 50; ++i) {
    const Point2 place{random.Uniform(), random.Uniform()};
    const Real part = random.Uniform();
    const auto direct = lamp.SampleDirect(si, place, part);
    ASSERT_TRUE(direct);
    const double onNormal = std::abs(double(Dot(direct->wi, bsdf.Ns())));
    // The fog is one unit deep, seen at a slant.
    const double passed = std::exp(-.2 / double(direct->wi.z));
    for (const LobeSet lobes : {LobeSet::NonSpecular, LobeSet::All, LobeSet::Glossy}) {
      const Spectrum f = bsdf.f(si.wo, direct->wi, lobes);
      const double bsdfPdf = double(bsdf.Pdf(si.wo, direct->wi, lobes));
      for (const auto& [lights, bsdfs] : {std::pair{1, 1}, std::pair{8, 1}, std::pair{2, 5}}) {
        LiContext context = Context();
        const Spectrum sum =
            FromLightSample(point, {&lamp, Real(.3), place, part}, {lights, bsdfs}, lobes, context);
        const double pdf = .3 * double(direct->pdf);
        for (int c = 0; c < 3; ++c) {
          const double truth = double(f[c]) * (3 - c) * passed * onNormal / pdf *
                               Weight(lights, pdf, bsdfs, bsdfPdf);
          EXPECT_NEAR(double(sum[c]), truth, 1e-3 * truth + 1e-9);
        }
      }
    }
  }
}

// A delta light needs no weight, whatever the counts.
TEST_F(EstimatorFormulas, OfADeltaLightHaveNoWeight) {
  Load("LightSource \"point\" \"color I\" [3 2 1] \"point from\" [0 1 2]\n");
  const SurfaceInteraction si = Receiver();
  const Lambert matte({Real(.5), Real(.4), Real(.3)});
  Bsdf bsdf(si);
  bsdf.Add(&matte);
  const ShadingPoint point{si, bsdf, {}, 0};
  LiContext context = Context();
  const Light& light = *TheScene().Lights()[0];
  const Vector3 wi = Normalize(Vector3(0, 1, 2));
  const double cosine = double(Dot(wi, bsdf.Ns())) / 5;
  const Spectrum sum =
      FromLightSample(point, {&light, Real(.25), {}, 0}, {8, 2}, LobeSet::NonSpecular, context);
  const Spectrum direct = EstimateDirect(point, light, {}, context);
  for (int c = 0; c < 3; ++c) {
    const double truth = (.5 - .1 * c) / M_PI * (3 - c) * cosine;
    EXPECT_NEAR(double(sum[c]), truth / .25, 1e-5);
    EXPECT_NEAR(double(direct[c]), truth, 1e-5);
  }
  EXPECT_EQ(rays_.counts[std::size_t(RayKind::Shadow)], 2u);
  EXPECT_EQ(rays_.counts[std::size_t(RayKind::Bsdf)], 0u);
}

// One light sample and one BSDF sample, each with its weight.
TEST_F(EstimatorFormulas, OfDirectLightAreALightSampleAndABsdfSample) {
  Load("LightSource \"infinite\" \"color L\" [3 2 1]\n");
  const Light& sky = *TheScene().Lights()[0];
  const SurfaceInteraction si = Receiver();
  const Microfacet gloss({Real(.2), Real(.3), Real(.4)}, Fresnel::None(), 4);
  Bsdf bsdf(si);
  bsdf.Add(&gloss);
  const ShadingPoint point{si, bsdf, {}, 0};
  RandomStream random(2);
  const double lightPdf = 1 / (4 * M_PI);
  int both = 0;
  for (int i = 0; i < 60; ++i) {
    const DirectLightingVariates u{{random.Uniform(), random.Uniform()},
                                   random.Uniform(),
                                   {random.Uniform(), random.Uniform()},
                                   random.Uniform()};
    LiContext context = Context();
    const Spectrum light =
        FromLightSample(point, {&sky, 1, u.light, u.lightPart}, {}, LobeSet::NonSpecular, context);
    const auto sample = bsdf.Sample(si.wo, u.bsdf, u.bsdfLobe, LobeSet::NonSpecular);
    const Spectrum sum = EstimateDirect(point, sky, u, context);
    both += sample && !light.IsBlack();
    for (int c = 0; c < 3; ++c) {
      double truth = double(light[c]);
      if (sample)
        truth +=
            double(sample->throughput[c]) * (3 - c) * Weight(1, double(sample->pdf), 1, lightPdf);
      EXPECT_NEAR(double(sum[c]), truth, 1e-4 * truth + 1e-9);
    }
  }
  EXPECT_GT(both, 5);
}

TEST_F(EstimatorFormulas, OfAShadingPointAreThoseOfItsLamp) {
  Load(
      "AttributeBegin AreaLightSource \"area\" \"color L\" [3 2 1] Shape \"sphere\" "
      "AttributeEnd\n");
  SurfaceInteraction si = Receiver();
  EXPECT_EQ((ShadingPoint{si, Bsdf(si), {}, 0}).Le(), Spectrum());
  si.areaLight = static_cast<const AreaLight*>(TheScene().Lights()[0].get());
  EXPECT_EQ((ShadingPoint{si, Bsdf(si), {}, 0}).Le(), Spectrum(3, 2, 1));
  si.wo = -si.wo;
  EXPECT_EQ((ShadingPoint{si, Bsdf(si), {}, 0}).Le(), Spectrum());
}

// Veach 1997, eq. 5.19: |wo.ns| |wi.ng| / (|wo.ng| |wi.ns|).
TEST_F(EstimatorFormulas, OfTheShadingNormalFactor) {
  RandomStream random(3);
  const auto direction = [&] {
    const Real x = random.Uniform() - Real(.5), y = random.Uniform() - Real(.5);
    return Normalize(Vector3(x, y, random.Uniform() - Real(.5)));
  };
  for (int i = 0; i < 200; ++i) {
    const Vector3 wo = direction(), wi = direction();
    const Normal3 ng = Normal3(direction()), ns = Normal3(direction());
    const auto cosine = [](const Vector3& w, const Normal3& n) {
      return std::abs(double(w.x) * double(n.x) + double(w.y) * double(n.y) +
                      double(w.z) * double(n.z));
    };
    const double truth =
        std::min(cosine(wo, ns) * cosine(wi, ng) / (cosine(wo, ng) * cosine(wi, ns)), 100.);
    EXPECT_NEAR(double(ShadingNormalFactor(wo, wi, ng, ns)) / truth, 1, 1e-3);
    EXPECT_EQ(ShadingNormalFactor(wo, wi, ng, ng), 1);
  }
  EXPECT_EQ(ShadingNormalFactor({1, 0, 0}, {0, 0, 1}, {0, 0, 1}, {0, Real(.6), Real(.8)}), 0);
}

const std::string kMedium =
    "Volume \"exponential\" \"point p0\" [-9 -9 0] \"point p1\" [9 9 5] \"float a\" 1 \"float b\" "
    "-.4 \"vector updir\" [0 0 1] ";

// A medium that neither absorbs nor scatters: steps of equal length, each with one point at the
// same random place in it.
TEST_F(EstimatorFormulas, OfAMarchThroughAnEmittingMedium) {
  for (const double stepSize : {1., .8, 100.}) {
    Load(kMedium + "\"color Le\" [3 2 1]\n",
         "VolumeIntegrator \"emission\" \"float stepsize\" " + std::to_string(stepSize) + "\n");
    LiContext context = Context();
    for (std::uint64_t key = 0; key < 20; ++key) {
      const double offset = double(RandomStream(key).Uniform());
      const Ray ray{{0, 0, -1}, {0, 0, 1}, Real(4.5), 0};
      const Spectrum found = loaded_.setup->volumeIntegrator->Li(ray, context, RandomStream(key));
      // The medium is from z = 0 to the end of the ray at z = 3.5.
      const int steps = int(std::ceil(3.5 / stepSize));
      double sum = 0;
      for (int i = 0; i < steps; ++i) sum += std::exp(.4 * (i + offset) * 3.5 / steps);
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(double(found[c]) / (sum * (3 - c) * 3.5 / steps), 1, 1e-4) << stepSize;
    }
    EXPECT_FALSE(loaded_.setup->volumeIntegrator->ScattersLight());
  }
}

// Absorption up to each point: of density exp(.4 z), the integral is (exp(.4 z) - 1) / .4.
TEST_F(EstimatorFormulas, OfAMarchThroughAnAbsorbingMedium) {
  Load(kMedium + "\"color Le\" [3 2 1] \"color sigma_a\" [.1 .2 .3]\n",
       "VolumeIntegrator \"emission\"\n");
  LiContext context = Context();
  for (std::uint64_t key = 0; key < 20; ++key) {
    const double offset = double(RandomStream(key).Uniform());
    const Ray ray{{0, 0, -1}, {0, 0, 1}, Real(5.5), 0};
    const Spectrum found = loaded_.setup->volumeIntegrator->Li(ray, context, RandomStream(key));
    for (int c = 0; c < 3; ++c) {
      double sum = 0;  // the default steps of at most 1: five for a length of 4.5
      for (int i = 0; i < 5; ++i) {
        const double z = .9 * (i + offset), depth = (.1 + .1 * c) * (std::exp(.4 * z) - 1) / .4;
        sum += .9 * (3 - c) * std::exp(.4 * z - depth);
      }
      EXPECT_NEAR(double(found[c]) / sum, 1, 1e-4);
    }
  }
}

// Two lamps: each step takes one of them, half by power and half uniformly, and adds
// sigma_s phase L T / probability.
TEST_F(EstimatorFormulas, OfAMarchThroughAScatteringMedium) {
  Load(
      "LightSource \"point\" \"color I\" [30 20 10] \"point from\" [2 0 1]\nLightSource \"point\" "
      "\"color I\" [5 9 7] \"point from\" [0 3 4]\nVolume \"homogeneous\" \"point p0\" [-9 -9 0] "
      "\"point p1\" [9 9 5] \"float g\" .4 \"color sigma_s\" [.1 .2 .3] \"color sigma_a\" [.05 .05 "
      ".05] \"color Le\" [.01 .02 .03]\n",
      "VolumeIntegrator \"single\" \"float stepsize\" 2\n");
  EXPECT_TRUE(loaded_.setup->volumeIntegrator->ScattersLight());
  loaded_.setup->volumeIntegrator->Preprocess(TheScene());
  LiContext context = Context();
  const double intensity[2][3] = {{30, 20, 10}, {5, 9, 7}};
  const double place[2][3] = {{2, 0, 1}, {0, 3, 4}};
  const double y[2] = {double(Spectrum(30, 20, 10).Y()), double(Spectrum(5, 9, 7).Y())};
  const double first = .25 + .5 * y[0] / (y[0] + y[1]);
  int chosen[2] = {};
  for (std::uint64_t key = 0; key < 40; ++key) {
    RandomStream random(key);
    const double offset = double(random.Uniform());
    double sum[3] = {};
    for (int i = 0; i < 3; ++i) {  // three steps of 5/3
      const double z = (i + offset) * 5 / 3;
      const int light = double(random.Uniform()) < first ? 0 : 1;
      for (int k = 0; k < 3; ++k) random.Uniform();
      ++chosen[light];
      const double* at = place[light];
      const double d2 = at[0] * at[0] + at[1] * at[1] + (at[2] - z) * (at[2] - z);
      // Light from the lamp goes on along -z, towards the origin of the ray.
      const double cosine = (at[2] - z) / std::sqrt(d2);
      const double base = 1 + .16 - .8 * cosine;
      const double phase = (1 - .16) / (4 * M_PI * std::pow(base, 1.5));
      for (int c = 0; c < 3; ++c) {
        const double sigma = .15 + .1 * c;
        const double probability = light == 0 ? first : 1 - first;
        const double scattered = (.1 + .1 * c) * phase * intensity[light][c] / d2 *
                                 std::exp(-sigma * std::sqrt(d2)) / probability;
        sum[c] += std::exp(-sigma * z) * ((.01 + .01 * c) + scattered) * 5 / 3;
      }
    }
    const Ray ray{{0, 0, 0}, {0, 0, 1}, kInfinity, 0};
    const Spectrum found = loaded_.setup->volumeIntegrator->Li(ray, context, RandomStream(key));
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(double(found[c]) / sum[c], 1, 1e-3) << key;
  }
  EXPECT_GT(std::min(chosen[0], chosen[1]), 10);
}

}  // namespace
}  // namespace exphoton
