// SPDX-License-Identifier: BSD-2-Clause
// These tests compare density estimates with sums over all photons in double: which photons count,
// their weights by kernel, BSDF, shading normal and coat, and the radii of the maps.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "core/base/log.h"
#include "core/base/parallel.h"
#include "core/base/progress.h"
#include "core/math/sampling/random.h"
#include "core/scattering/lobes/fresnel_blend.h"
#include "core/scattering/lobes/lambert.h"
#include "core/scattering/lobes/microfacet.h"
#include "core/scattering/lobes/transmitted.h"
#include "core/transport/shading_point.h"
#include "integrators/photon/maps/photon_map_set.h"
#include "integrators/photon/radiance/radiance_photon_map.h"
#include "tests/support/scattering.h"

namespace exphoton {
namespace {

constexpr int kPaths[3] = {70, 50, 90};

// Photons near the plane z = 0, from both sides, no direction nearly along the plane.
std::vector<Photon> RandomPhotons(int count, std::uint64_t seed) {
  RandomStream random(seed);
  std::vector<Photon> photons;
  const auto between = [&] { return 2 * random.Uniform() - 1; };
  for (int i = 0; i < count; ++i) {
    const Real x = between(), y = between();
    Photon photon{{x, y, Real(.1) * between()}, {}, {}};
    const Real dx = between(), dy = between();
    const Real z = (Real(.5) + random.Uniform()) * (random.Uniform() < Real(.3) ? -1 : 1);
    photon.wi = Normalize(Vector3(dx, dy, z));
    photon.alpha = {random.Uniform(), 2 * random.Uniform(), 3 * random.Uniform()};
    photons.push_back(photon);
  }
  return photons;
}

// Estimate is a brute-force density estimate at the origin.
struct Estimate {
  struct Member {
    Photon photon;
    double distance2;
  };
  std::vector<Member> photons;
  double radius2;

  Estimate(const std::vector<Photon>& all, const Normal3& n, int k, double maxDistance,
           bool isOneSided) {
    for (const Photon& photon : all) {
      if (isOneSided && !(Dot(photon.wi, n) > 0)) continue;
      const double height = double(Dot(photon.p - Point3(), Vector3(n)));
      const double distance2 = std::max(double(LengthSquared(photon.p - Point3())),
                                        std::pow(height / double(PhotonMap::kFlatness), 2));
      if (distance2 <= maxDistance * maxDistance) photons.push_back({photon, distance2});
    }
    std::sort(photons.begin(), photons.end(),
              [](const Member& a, const Member& b) { return a.distance2 < b.distance2; });
    radius2 = maxDistance * maxDistance;
    if (photons.size() < std::size_t(k)) return;
    radius2 = photons[std::size_t(k) - 1].distance2;
    photons.resize(std::size_t(k) - 1);
  }
};

class PhotonEstimates : public testing::Test {
 protected:
  PhotonMapSet MapsOf(const PhotonSettings& settings, Real sceneRadius = 4) {
    PhotonPassResult result;
    for (std::size_t m = 0; m < 3; ++m) {
      for (const Photon& photon : photons_[m]) result.buffers[m].Add(photon);
      result.buffers[m].paths = kPaths[m];
    }
    PreprocessContext context{threads_, 1, log_, progress_, statistics_, false, nullptr, {}};
    return {&result, settings, sceneRadius, context};
  }

  ThreadPool threads_{1};
  Log log_{Log::Level::Normal, Log::Sink::Memory};
  ProgressReporter progress_{ProgressReporter::Mode::Quiet};
  Statistics statistics_;
  Arena arena_;
  std::vector<Photon> photons_[3] = {RandomPhotons(400, 1), RandomPhotons(300, 2),
                                     RandomPhotons(200, 3)};
};

double Kernel(DensityKernel kernel, double distance2, double radius2) {
  if (kernel == DensityKernel::Constant) return 1 / (M_PI * radius2);
  return 3 / (M_PI * radius2) * std::pow(1 - distance2 / radius2, 2);
}

struct Surface {
  const char* name;
  Real tilt;  // of the shading normal, in degrees
  std::vector<const Bxdf*> lobes;
};

// Returns the radiance that the photons of one map add. Every photon adds
// K f alpha |wi.ns| / |wi.ng| / N, unless it is on different sides of the two normals.
std::array<double, 3> ScatteredSum(const Estimate& estimate, DensityKernel kernel,
                                   const ShadingPoint& point, double paths) {
  std::array<double, 3> sum{};
  for (const auto& [photon, distance2] : estimate.photons) {
    const double onNs = double(Dot(photon.wi, point.bsdf.Ns())), onNg = double(photon.wi.z);
    if ((onNs > 0) != (onNg > 0)) continue;
    const Spectrum f = point.bsdf.f(point.Wo(), photon.wi, LobeSet::NonSpecular);
    const double weight =
        Kernel(kernel, distance2, estimate.radius2) * std::abs(onNs / onNg) / paths;
    for (std::size_t c = 0; c < 3; ++c)
      sum[c] += weight * double(f[int(c)]) * double(photon.alpha[int(c)]);
  }
  return sum;
}

// Calls visit(point, isSheet) for the surface as seen from its front and from its back.
template <class Visit>
void SeeBothSides(const Surface& surface, const Visit& visit) {
  for (const Vector3 wo :
       {Normalize(Vector3(Real(.3), Real(.2), 1)), Normalize(Vector3(Real(.1), Real(-.2), -1))}) {
    SurfaceInteraction si =
        surface.tilt == 0 ? FlatSurface() : TiltedSurface(Radians(surface.tilt));
    si.wo = wo;
    Bsdf bsdf(si);
    bool isSheet = false;
    for (const Bxdf* lobe : surface.lobes) {
      bsdf.Add(lobe);
      isSheet = isSheet || lobe->Matches(LobeSet::Transmission);
    }
    const Normal3 smooth = si.ng;  // the tilt is a bump
    visit(ShadingPoint{si, bsdf, {}, 0, Spectrum(1), smooth}, isSheet);
  }
}

TEST_F(PhotonEstimates, AreSumsOfKernelTimesScatteredPower) {
  const Spectrum r(Real(.6), Real(.3), Real(.2)), t(Real(.1), Real(.5), Real(.4));
  const Lambert matte(r);
  const Transmitted<Lambert> sheet{Lambert(t)};
  const Microfacet gloss(t, Fresnel::Dielectric(1, Real(1.5)), 5);
  const BlendedDiffuse base(r, t);
  const BlendedGloss coat(t, 5, 9);
  const std::vector<Surface> surfaces{
      {"matte", 0, {&matte}},           {"tilted matte", 25, {&matte}},
      {"sheet", 0, {&matte, &sheet}},   {"tilted sheet", 25, {&matte, &sheet}},
      {"plastic", 0, {&matte, &gloss}}, {"tilted plastic", 25, {&matte, &gloss}},
      {"coated", 0, {&base, &coat}},    {"coated base", 25, {&base}}};
  for (const auto& [kernel, k] :
       {std::pair(DensityKernel::Constant, 30), std::pair(DensityKernel::Constant, 1000),
        std::pair(DensityKernel::Simpson, 30), std::pair(DensityKernel::Simpson, 1000)}) {
    PhotonSettings settings;
    settings.kernel = kernel;
    settings.nUsed = k;
    settings.maxDist = Real(.7);
    const PhotonMapSet maps = MapsOf(settings);
    for (const Surface& surface : surfaces) {
      SCOPED_TRACE(surface.name + (", " + std::to_string(k)) + " photons");
      SeeBothSides(surface, [&, kernel = kernel, k = k](const ShadingPoint& point, bool isSheet) {
        const Normal3 n(0, 0, point.Wo().z > 0 ? Real(1) : Real(-1));
        const auto expectSum = [](const Spectrum& radiance, const std::array<double, 3>& sum) {
          for (std::size_t c = 0; c < 3; ++c)
            EXPECT_NEAR(double(radiance[int(c)]), sum[c], 3e-3 * sum[c] + 1e-7);
        };
        std::array<double, 3> all{};
        for (std::size_t m = 0; m < 3; ++m) {
          const auto sum = ScatteredSum(Estimate(photons_[m], n, k, .7, !isSheet), kernel, point,
                                        double(kPaths[m]));
          expectSum(maps.Radiance(PhotonKind(m), point, &arena_), sum);
          for (std::size_t c = 0; c < 3; ++c) all[c] += sum[c];
        }
        expectSum(maps.Radiance(point, &arena_), all);
        // No lobe that is left out counts.
        EXPECT_TRUE(maps.Radiance(point, &arena_, LobeSet::Specular).IsBlack());
      });
    }
  }
}

// Returns the squared radius of the own disk of the photon at p. Runs of 64 photons in the order of
// the map share a spacing, which 32 neighbours of the middle one show.
double OwnDisk2(const PhotonMap& map, const Point3& p, int k, double most2) {
  std::uint32_t at = 0;
  while (map.Position(at) != p) ++at;
  const auto middle = std::min(at / 64 * 64 + 32, std::uint32_t(map.Size()) - 1);
  std::vector<double> distances2;
  for (std::uint32_t i = 0; i < map.Size(); ++i)
    distances2.push_back(double(LengthSquared(map.Position(i) - map.Position(middle))));
  std::nth_element(distances2.begin(), distances2.begin() + 31, distances2.end());
  return std::min(PhotonMap::kOwnDisk * k * distances2[31] / 32, most2);
}

TEST_F(PhotonEstimates, OfIrradianceAreThoseOfAllMaps) {
  const ShadingNormals bump{Normal3(0, 0, 1), Normal3(Real(.6), 0, Real(.8))};
  using Case = std::pair<bool, ShadingNormals>;
  for (const auto& [isCoated, normals] :
       {Case(false, {}), Case(true, {}), Case(false, bump), Case(true, bump)}) {
    for (const int k : {30, 1000}) {
      PhotonSettings settings;
      settings.nUsed = k;
      settings.maxDist = Real(.7);
      const PhotonMapSet maps = MapsOf(settings);
      for (const Normal3 n : {Normal3(0, 0, 1), Normal3(0, 0, -1)}) {
        double sum[3] = {}, weights = 0, radii = 0;
        for (std::size_t m = 0; m < 3; ++m) {
          const Estimate estimate(photons_[m], n, k, .7, true);
          double part[3] = {}, largest2 = 0;
          for (const auto& [photon, distance2] : estimate.photons) {
            const double disk2 = OwnDisk2(maps.Map(PhotonKind(m)), photon.p, k, estimate.radius2);
            if (distance2 > disk2) continue;
            largest2 = std::max(largest2, disk2);
            const double onFlat = std::abs(double(photon.wi.z));
            const double onBump = std::abs(.6 * double(photon.wi.x) + .8 * double(photon.wi.z));
            const double x = 1 - onFlat / 2;
            double passed = isCoated ? (1 - std::pow(x, 5)) * 28 / 23 : 1;
            if (normals.HasBumps()) passed *= std::min(onBump / onFlat, std::max(k / 2., 4.));
            for (int c = 0; c < 3; ++c) part[c] += passed * double(photon.alpha[c]) / disk2;
          }
          for (int c = 0; c < 3; ++c) {
            part[c] /= kPaths[m] * M_PI;
            sum[c] += part[c];
          }
          const double y = double(Spectrum(Real(part[0]), Real(part[1]), Real(part[2])).Y());
          weights += y;
          radii += y * std::sqrt(std::min(estimate.radius2, largest2 / PhotonMap::kOwnDisk));
        }
        const auto found = maps.EstimateIrradiance({0, 0, 0}, n, &arena_, isCoated, normals);
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(double(found.e[c]), sum[c], 3e-3 * sum[c]);
        EXPECT_NEAR(double(found.radius), radii / weights, 1e-3);
      }
    }
  }
}

// On this bump the cosine is 31 times as large as on the flat surface.
TEST_F(PhotonEstimates, LimitTheLightOfPhotonsAlongABump) {
  const ShadingNormals bump{Normal3(0, 0, 1), Normal3(Real(.6), 0, Real(.8))};
  for (auto& photons : photons_) photons.clear();
  for (int i = 0; i < 100; ++i)
    photons_[0].push_back({{Real(i % 10) / 10, Real(i / 10) / 10, 0},
                           Normalize(Vector3(1, 0, Real(.02))),
                           Spectrum(1)});
  for (const auto& [k, most] : {std::pair(8, 4.), std::pair(20, 10.), std::pair(80, 30.8)}) {
    PhotonSettings settings;
    settings.nUsed = k;
    settings.maxDist = 1;
    const PhotonMapSet maps = MapsOf(settings);
    const Point3 p{Real(.53), Real(.51), 0};
    const double flat = double(maps.EstimateIrradiance(p, {0, 0, 1}, &arena_).e.g);
    const double bumped = double(maps.EstimateIrradiance(p, {0, 0, 1}, &arena_, false, bump).e.g);
    EXPECT_GT(flat, 0);
    EXPECT_NEAR(bumped / flat, most, .01 * most) << k;
  }
}

TEST_F(PhotonEstimates, CountThePhotonsOfTheirDisks) {
  PhotonSettings settings;
  settings.nUsed = 30;
  settings.maxDist = Real(.7);
  const PhotonMapSet maps = MapsOf(settings);
  const Lambert matte(Spectrum(Real(.5)));
  const Transmitted<Lambert> sheet{matte};
  for (const bool isSheet : {false, true}) {
    for (const Real side : {Real(1), Real(-1)}) {
      SurfaceInteraction si = FlatSurface();
      si.wo = {0, 0, side};
      Bsdf bsdf(si);
      bsdf.Add(&matte);
      if (isSheet) bsdf.Add(&sheet);
      double density = 0;
      for (const auto& photons : photons_) {
        const Estimate estimate(photons, {0, 0, side}, 30, .7, !isSheet);
        density += double(estimate.photons.size()) / (M_PI * estimate.radius2);
      }
      EXPECT_NEAR(maps.PhotonDensity({si, bsdf, {}, 0}, &arena_), density, 1e-3 * density);
    }
  }
}

// The largest radius is the given one, or what nine of ten photons need, or a part of the scene's
// radius: a hundredth for fewer photons than an estimate uses, else a millionth.
TEST_F(PhotonEstimates, HaveARadiusOfTheirOwnMap) {
  PhotonSettings settings;
  settings.nUsed = 20;
  settings.maxDist = Real(.25);
  EXPECT_EQ(MapsOf(settings).MaxDistance(PhotonKind::Caustic), Real(.25));
  settings.maxDist.reset();
  const PhotonMapSet maps = MapsOf(settings);
  for (std::size_t m = 0; m < 3; ++m) {
    std::vector<double> radii;  // of every photon: the distance of its 20th neighbour
    for (const Photon& a : photons_[m]) {
      std::vector<double> distances;
      for (const Photon& b : photons_[m]) distances.push_back(double(Distance(a.p, b.p)));
      std::nth_element(distances.begin(), distances.begin() + 20, distances.end());
      radii.push_back(distances[20]);
    }
    std::sort(radii.begin(), radii.end());
    const double radius = double(maps.MaxDistance(PhotonKind(m)));
    if (photons_[m].size() <= 256) {
      EXPECT_NEAR(radius, radii[std::size_t(.9 * double(radii.size() - 1))], 1e-5);
    } else {  // estimated from a sample of the photons
      EXPECT_GT(radius, radii[radii.size() * 8 / 10]);
      EXPECT_LT(radius, radii[radii.size() * 97 / 100]);
    }
  }
  // Twenty photons at one point, and fewer than twenty.
  photons_[0].assign(21, Photon{{0, 0, 0}, {0, 0, 1}, Spectrum(1)});
  photons_[1].assign(19, Photon{{0, 0, 0}, {0, 0, 1}, Spectrum(1)});
  const PhotonMapSet few = MapsOf(settings, 7);
  EXPECT_NEAR(double(few.MaxDistance(PhotonKind::Direct)) / 7e-6, 1, 1e-4);
  EXPECT_NEAR(double(few.MaxDistance(PhotonKind::Caustic)) / .07, 1, 1e-4);
}

// Sites are computed in chunks of 256. A pane has a radiance photon on each side, unless nothing
// needs what it transmits.
TEST_F(PhotonEstimates, MakeARadiancePhotonOfEverySite) {
  const PhotonSettings settings;
  const PhotonMapSet maps = MapsOf(settings);
  PreprocessContext context{threads_, 1, log_, progress_, statistics_, false, nullptr, {}};
  const Spectrum half(Real(.5));
  for (const std::size_t count : {1, 255, 256, 257, 513}) {
    std::vector<RadiancePhotonSite> sites(count, {{0, 0, 0}, {0, 0, 1}, half, Spectrum()});
    EXPECT_EQ(RadiancePhotonMap(sites, maps, settings, true, context).Size(), count);
    for (RadiancePhotonSite& site : sites) site.transmittance = half;
    EXPECT_EQ(RadiancePhotonMap(sites, maps, settings, true, context).Size(), 2 * count);
    EXPECT_EQ(RadiancePhotonMap(sites, maps, settings, false, context).Size(), count);
  }
}

// A radiance photon is valid within the radius of its estimate times radiancereach.
TEST_F(PhotonEstimates, ReachAsFarAsTheirParameterSays) {
  PhotonSettings settings;
  const PhotonMapSet maps = MapsOf(settings);
  PreprocessContext context{threads_, 1, log_, progress_, statistics_, false, nullptr, {}};
  Real radius = 0;  // of the estimate, which does not depend on the reach
  for (const Real reach : {Real(1), Real(.5), Real(3)}) {
    settings.radianceReach = reach;
    std::vector<RadiancePhotonSite> sites(1, {{0, 0, 0}, {0, 0, 1}, Spectrum(1), Spectrum()});
    const RadiancePhotonMap map(sites, maps, settings, false, context);
    const auto find = [&](Real x) {
      const RadiancePhotonMap::Place place{{x, 0, 0}, {0, 0, 1}};
      std::optional<RadiancePhotonMap::Entry> found;
      map.Find({&place, 1}, &found);
      return found;
    };
    ASSERT_TRUE(find(0));
    if (reach == 1) radius = std::sqrt(find(0)->radius2);
    EXPECT_GT(radius, 0);
    EXPECT_NEAR(std::sqrt(find(0)->radius2), radius, Real(1e-5) * radius) << reach;
    EXPECT_TRUE(find(Real(.99) * reach * radius)) << reach;
    EXPECT_FALSE(find(Real(1.01) * reach * radius)) << reach;
  }
}

}  // namespace
}  // namespace exphoton
