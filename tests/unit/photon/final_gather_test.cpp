// SPDX-License-Identifier: BSD-2-Clause
// These tests check the final gather of a constant environment. The result must be the reflectance
// of the non-specular lobes, with any specular lobes beside them and with any guiding photons.
#include "integrators/photon/gather/final_gather.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "core/math/sampling/sampling.h"
#include "core/scattering/lobes/lambert.h"
#include "core/scattering/lobes/microfacet.h"
#include "core/scattering/lobes/oren_nayar.h"
#include "core/scattering/lobes/specular.h"
#include "tests/support/test_plugin.h"
#include "tests/support/test_scene.h"

namespace exphoton {
namespace {

// Sky gives the radiance of each direction.
class Sky {
 public:
  explicit Sky(std::function<Real(const Vector3&)> radiance) : radiance_(std::move(radiance)) {}

  struct Segment {
    Vector3 d;
  };
  Segment Trace(const Ray& ray) const { return {ray.d}; }
  void LookUp(std::span<Segment>) const {}
  Spectrum Read(const Segment& segment) const { return Spectrum(radiance_(segment.d)); }

 private:
  std::function<Real(const Vector3&)> radiance_;
};
const Sky kUniform([](const Vector3&) { return Real(1); });

struct Gathered {
  double mean, variance;
  double error;  // 4 standard errors of the mean
};

// The light that a trial returns: of a gather that is not shared, or of the parts of a shared one.
enum class Part { Unshared, Sum, Own, HandedOver };

struct GatherTrial {
  Real angleDegrees, rrThreshold;
  int count;
  Part part = Part::Unshared;
  Real throughput = 1;  // of the path to the surface
};

SurfaceInteraction SeenFloor() {
  SurfaceInteraction surface;
  surface.ng = surface.shading.n = {0, 0, 1};
  surface.dpdu = surface.shading.dpdu = {1, 0, 0};
  surface.dpdv = surface.shading.dpdv = {0, 1, 0};
  surface.wo = Normalize(Vector3(Real(.3), Real(.2), 1));
  return surface;
}

// Gathers the light of the sky over `count` independent sets of gather samples. Photons from the
// given directions guide the gather.
template <class AddLobes>
Gathered GatherSky(const Sky& sky, const std::vector<Vector3>& guideDirections,
                   const GatherTrial& trial, const AddLobes& addLobes) {
  const auto& [angleDegrees, rrThreshold, count, part, throughput] = trial;
  static const LoadedScene scene = LoadSceneText("WorldBegin\nShape \"sphere\"\nWorldEnd\n");
  PhotonBuffer buffer;
  buffer.farthest = Real(1e5);  // the directions are the same from everywhere in a cell
  for (const Vector3& w : guideDirections) buffer.Add({{0, 0, 0}, w, Spectrum(1), 1});
  buffer.paths = 1;
  ThreadPool threads(1);
  const PhotonMap guide(std::move(buffer), threads);

  PhotonSettings settings;
  settings.gatherSampling = GatherSampling::Photons;
  settings.gatherAngle = angleDegrees;
  settings.rrThreshold = rrThreshold;
  settings.finalGatherSamples = 32;
  FinalGather gather(settings);
  gather.Prepare(guide);
  SampleLayout layout;
  gather.RequestSamples(true, &layout);
  CameraSamples samples(layout);
  TestPlugins plugins;
  const auto sampler = plugins.MakeSampler(R"("random")");

  Arena arena;
  RayCounters rays;
  double sum = 0, sum2 = 0;
  for (int i = 0; i < count; ++i) {
    arena.Reset();
    sampler->Generate({0, {0, 0}, i}, &samples);
    const SurfaceInteraction surface = SeenFloor();
    ShadingPoint point{surface, Bsdf(surface), RayDifferential(), 0};
    point.throughput = Spectrum(throughput);
    addLobes(&point.bsdf, &arena);
    LiContext context{*scene.setup->scene, samples, arena, rays, std::uint64_t(i)};
    GatherRecords handedOver;
    if (part != Part::Unshared) context.gathers = &handedOver;
    double x = double(gather.Gather(point, context, sky).g);
    if (part == Part::HandedOver) x = 0;
    if (part == Part::Own) handedOver.clear();
    for (const GatherRecord& record : handedOver) x += double((record.light * record.weight).g);
    sum += x;
    sum2 += x * x;
  }
  const double mean = sum / count;
  const double variance = std::max(0.0, sum2 / count - mean * mean);
  return {mean, variance, 4 * std::sqrt(variance / count)};
}

// Gathers radiance 1 from every direction.
template <class AddLobes>
Gathered GatherConstant(const std::vector<Vector3>& guideDirections, Real angleDegrees, int count,
                        const AddLobes& addLobes) {
  return GatherSky(kUniform, guideDirections, {angleDegrees, PhotonSettings().rrThreshold, count},
                   addLobes);
}

std::vector<Vector3> UpperDirections(int count) {
  std::vector<Vector3> directions;
  RandomStream random(21);
  for (int i = 0; i < count; ++i)
    directions.push_back(SampleCosineHemisphere({random.Uniform(), random.Uniform()}));
  return directions;
}

// Returns fifty photons in groups of five from the same direction, so that cones of every angle are
// followed. Narrow cones are followed because light is dense in them. The widest cones are followed
// because they hold more light than the BSDF samples near the horizon.
std::vector<Vector3> Clusters() {
  std::vector<Vector3> directions;
  const std::vector<Vector3> upper = UpperDirections(10);
  for (std::size_t i = 0; i < upper.size(); ++i) {
    const Real height = i % 2 ? 1 : Real(.05);
    const Vector3 w = Normalize(Vector3(upper[i].x, upper[i].y, height * upper[i].z));
    directions.insert(directions.end(), 5, w);
  }
  return directions;
}

constexpr double kTolerance = .005;

TEST(FinalGather, HandsOverTheDiffusePartForSharing) {
  const auto plastic = [](Bsdf* bsdf, Arena* arena) {
    bsdf->Add(arena->Make<Lambert>(Spectrum(Real(.3), Real(.5), 0)));
    bsdf->Add(arena->Make<OrenNayar>(Spectrum(0, Real(.1), Real(.1)), Radians(Real(20))));
    bsdf->Add(arena->Make<Microfacet>(Spectrum(Real(.4)), Fresnel::None(), 20));
  };
  const Gathered whole = GatherSky(kUniform, Clusters(), {10, 0, 2000}, plastic);
  const Gathered divided = GatherSky(kUniform, Clusters(), {10, 0, 2000, Part::Sum}, plastic);
  EXPECT_NEAR(divided.mean, whole.mean, 1e-5);
  EXPECT_NEAR(divided.variance, whole.variance, 1e-4 * whole.variance);
}

TEST(FinalGather, KeepsTheGlossyPartForThePixelAlone) {
  const auto gloss = [](Bsdf* bsdf, Arena* arena) {
    bsdf->Add(arena->Make<Microfacet>(Spectrum(Real(.8)), Fresnel::None(), 20));
  };
  const auto plastic = [&](Bsdf* bsdf, Arena* arena) {
    bsdf->Add(arena->Make<Lambert>(Spectrum(Real(.3), Real(.5), 0)));
    gloss(bsdf, arena);
  };
  const Gathered glossy = GatherSky(kUniform, {}, {10, 0, 2000}, gloss);
  const Gathered own = GatherSky(kUniform, {}, {10, 0, 2000, Part::Own}, plastic);
  const Gathered shared = GatherSky(kUniform, {}, {10, 0, 2000, Part::HandedOver}, plastic);
  EXPECT_NEAR(own.mean, glossy.mean, own.error + glossy.error);
  EXPECT_LT(own.error + glossy.error, .02);
  EXPECT_NEAR(shared.mean, .5, shared.error);
  EXPECT_LT(shared.error, .02);
}

TEST(FinalGather, HandsOverTheThroughputOfThePath) {
  const auto matte = [](Bsdf* bsdf, Arena* arena) {
    bsdf->Add(arena->Make<Lambert>(Spectrum(Real(.5))));
  };
  const Gathered seen = GatherSky(kUniform, {}, {10, 0, 100, Part::HandedOver, Real(.25)}, matte);
  EXPECT_NEAR(seen.mean, .25 * .5, 1e-5);
}

TEST(FinalGather, OfADiffuseSurfaceBringsItsReflectanceAtEveryAngle) {
  for (Real angle : {Real(.001), Real(.1), Real(1), Real(10), Real(45), Real(90)}) {
    const Gathered g = GatherConstant(Clusters(), angle, 30000, [](Bsdf* bsdf, Arena* arena) {
      bsdf->Add(arena->Make<Lambert>(Spectrum(Real(.8))));
    });
    EXPECT_LE(std::abs(g.mean - .8) + g.error, .8 * kTolerance) << angle << " degrees";
    const double least = angle < 1 ? 0 : 1e-5;  // narrow cones cover too small a part of the sky
    EXPECT_GT(g.variance, least) << "rays follow the BSDF alone at " << angle << " degrees";
  }
}

TEST(FinalGather, BesideASpecularLobeBringsTheDiffusePartAlone) {
  const Gathered g = GatherConstant(Clusters(), 10, 30000, [](Bsdf* bsdf, Arena* arena) {
    bsdf->Add(arena->Make<Lambert>(Spectrum(Real(.5))));
    bsdf->Add(arena->Make<SpecularReflection>(Spectrum(Real(.3)), Fresnel::None()));
  });
  EXPECT_LE(std::abs(g.mean - .5) + g.error, .5 * kTolerance);
}

TEST(FinalGather, GuidedByOneDirectionOnlyIsStillUnbiased) {
  const std::vector<Vector3> same(50, Normalize(Vector3(1, 0, 1)));
  const Gathered g = GatherConstant(same, 10, 20000, [](Bsdf* bsdf, Arena* arena) {
    bsdf->Add(arena->Make<Lambert>(Spectrum(Real(.8))));
  });
  EXPECT_LE(std::abs(g.mean - .8) + g.error, .8 * 2 * kTolerance);
}

TEST(FinalGather, WithEveryPhotonBelowTheHorizonFollowsTheBsdfAlone) {
  const std::vector<Vector3> below(50, Vector3(0, 0, -1));
  const Gathered g = GatherConstant(below, 10, 200, [](Bsdf* bsdf, Arena* arena) {
    bsdf->Add(arena->Make<Lambert>(Spectrum(Real(.8))));
  });
  EXPECT_NEAR(g.mean, .8, 1e-4);  // every cosine-sampled ray returns exactly rho
}

// Returns how many of 32 gather rays go towards the patch on average. Of fifty photons,
// photonsFromThere come from the patch, and the others come from directions far apart.
double RaysTowards(const Vector3& patch, int photonsFromThere) {
  std::vector<Vector3> guide(std::size_t(photonsFromThere), patch);
  for (int i = 0; int(guide.size()) < 50; ++i)
    guide.push_back(SampleCosineHemisphere({(Real(i % 7) + Real(.5)) / 7, (Real(i / 7) + 1) / 9}));
  int towards = 0;
  const Sky sky([&](const Vector3& d) {
    towards += Dot(d, patch) > std::cos(Radians(Real(2.1)));
    return Real(1);
  });
  constexpr int kGathers = 500;
  GatherSky(sky, guide, {2, 0, kGathers},
            [](Bsdf* bsdf, Arena* arena) { bsdf->Add(arena->Make<Lambert>(Spectrum(Real(.8)))); });
  return double(towards) / kGathers;
}

TEST(FinalGather, AsManyRaysFollowPhotonsAsThereIsLightWhereTheyLead) {
  const Vector3 patch = Normalize(Vector3(1, Real(.1), 1));
  const double byBsdf = .1;  // upper bound
  for (const auto& [photons, rays] :
       {std::pair{1, 0}, {2, 2}, {3, 2}, {4, 4}, {10, 8}, {13, 16}, {25, 16}, {50, 16}}) {
    const double towards = RaysTowards(patch, photons);
    EXPECT_GE(towards, rays) << photons << " of 50 photons";
    EXPECT_LE(towards, rays + byBsdf) << photons << " of 50 photons";
  }
}

// Nearly all photons come from a small bright patch. A BSDF-sampled ray to the patch has a very
// small weight, but carries much radiance.
TEST(FinalGather, RouletteSparesRaysTowardsWhatPhotonsFoundBright) {
  const Vector3 patch = Normalize(Vector3(1, 0, 1));
  const Sky sky([&](const Vector3& d) { return Dot(d, patch) > Real(.99) ? Real(100) : Real(.1); });
  const std::vector<Vector3> guide(50, patch);
  const auto gather = [&](Real threshold) {
    return GatherSky(sky, guide, {10, threshold, 20000}, [](Bsdf* bsdf, Arena* arena) {
      bsdf->Add(arena->Make<Lambert>(Spectrum(Real(.8))));
    });
  };
  const Gathered all = gather(0), some = gather(Real(.05));
  EXPECT_NEAR(some.mean, all.mean, all.error + some.error);
  EXPECT_LT(some.variance, 1.1 * all.variance);
}

TEST(FinalGather, RouletteKeepsTheMeanWhereItEndsMostRays) {
  const Gathered g = GatherSky(kUniform, Clusters(), {10, 2, 120000}, [](Bsdf* bsdf, Arena* arena) {
    bsdf->Add(arena->Make<Lambert>(Spectrum(Real(.8))));
  });
  EXPECT_LE(std::abs(g.mean - .8) + g.error, .8 * 2 * kTolerance);
}

}  // namespace
}  // namespace exphoton
