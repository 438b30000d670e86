// SPDX-License-Identifier: BSD-2-Clause
// These tests compare density estimates of uniform photons on a plane with the exact density, for
// both kernels and both regimes (k photons found, fewer found). Each test repeats over independent
// maps and requires |mean - truth| + 4 standard errors <= tolerance. The false-alarm rate is below
// 1e-4 per case.
#include <gtest/gtest.h>

#include <cmath>

#include "core/math/sampling/random.h"
#include "integrators/photon/maps/density_kernel.h"
#include "integrators/photon/maps/photon_map.h"

namespace exphoton {
namespace {

struct Statistic {
  double mean = 0, standardError = 0;
};

// The photons are a Poisson process with a mean density of 60 on [-half, half]^2. The density is
// estimated at the origin.
constexpr double kDensity = 60;
PhotonMap PoissonMap(Real half, std::uint64_t seed) {
  RandomStream random(HashKey({seed, 99}));
  // The number of exponential waiting times before `expected` has a Poisson distribution.
  PhotonBuffer buffer;
  const double expected = kDensity * 4 * double(half) * double(half);
  for (double t = 0;;) {
    t -= std::log(1 - double(random.Uniform()));
    if (t > expected) break;
    const Point3 p{half * (2 * random.Uniform() - 1), half * (2 * random.Uniform() - 1), 0};
    buffer.Add({p, {0, 0, 1}, Spectrum(1)});
  }
  buffer.paths = 1;
  ThreadPool threads(1);
  return PhotonMap(std::move(buffer), threads);
}

template <class Estimate>
Statistic OverMaps(int maps, Real half, const Estimate& estimate) {
  double sum = 0, sum2 = 0;
  for (int i = 0; i < maps; ++i) {
    const double x = estimate(PoissonMap(half, std::uint64_t(i)));
    sum += x;
    sum2 += x * x;
  }
  const double mean = sum / maps, variance = std::max(0.0, sum2 / maps - mean * mean);
  return {mean, std::sqrt(variance / maps)};
}

double KernelEstimate(const PhotonMap& map, DensityKernel kernel, int k, Real maxDistance) {
  Arena arena;
  const auto around = map.Find({{0, 0, 0}, {0, 0, 1}, k, maxDistance, true}, &arena);
  double sum = 0;
  for (const Real distance2 : around.distance2)
    sum += double(KernelDisk(kernel, around.radius2).Weight(distance2));
  return sum;
}

class PlaneEstimate : public testing::TestWithParam<std::tuple<int, DensityKernel>> {};

TEST_P(PlaneEstimate, IsUnbiasedWhetherTheKPhotonsAreFoundOrNot) {
  const auto [k, kernel] = GetParam();
  const int maps = 600000 / k;
  // On average, the radii hold k / 2, k, and 6 k photons.
  for (double expected : {.5, 1.0, 6.0}) {
    const Real radius = Real(std::sqrt(expected * k / (kDensity * 3.14159265)));
    const Statistic s = OverMaps(
        maps, radius, [&](const PhotonMap& map) { return KernelEstimate(map, kernel, k, radius); });
    EXPECT_LE(std::abs(s.mean / kDensity - 1) + 4 * s.standardError / kDensity, .02)
        << "k " << k << ", expected photons in the radius " << expected * k;
  }
}

INSTANTIATE_TEST_SUITE_P(Kernels, PlaneEstimate,
                         testing::Combine(testing::Values(3, 10, 50),
                                          testing::Values(DensityKernel::Constant,
                                                          DensityKernel::Simpson)));

TEST(DensityKernels, IntegrateToOneOverTheirDisk) {
  const double r = 1.7;
  const KernelDisk constant(DensityKernel::Constant, Real(r * r));
  const KernelDisk simpson(DensityKernel::Simpson, Real(r * r));
  double ofConstant = 0, ofSimpson = 0;
  const int rings = 20000;
  for (int i = 0; i < rings; ++i) {
    const double d = (i + .5) / rings * r, area = 2 * 3.14159265358979 * d * r / rings;
    ofConstant += area * double(constant.Weight(Real(d * d)));
    ofSimpson += area * double(simpson.Weight(Real(d * d)));
  }
  EXPECT_NEAR(ofConstant, 1, 1e-4);
  EXPECT_NEAR(ofSimpson, 1, 1e-4);
  // The weight is 3 (1 - 1/4)^2 / (pi r^2) halfway out, and 0 beyond r.
  EXPECT_NEAR(simpson.Weight(Real(r * r / 4)), 3 * .5625 / (3.14159265358979 * r * r), 1e-6);
  EXPECT_EQ(simpson.Weight(Real(r * r * 1.01)), 0);
}

}  // namespace
}  // namespace exphoton
