// SPDX-License-Identifier: BSD-2-Clause
// These tests check the Hilbert-curve order of photons by direction: it contains every photon, and
// similar directions are adjacent.
#include "integrators/photon/gather/hilbert_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "core/math/sampling/random.h"
#include "core/math/sampling/sampling.h"

namespace exphoton {
namespace {

// Returns photons from all over the sphere, at positions that are independent of their directions.
PhotonMap ScatteredMap(int count) {
  RandomStream random(5);
  std::vector<Photon> photons;
  for (int i = 0; i < count; ++i) {
    const Vector3 w = SampleUniformSphere({random.Uniform(), random.Uniform()});
    photons.push_back(
        {{random.Uniform(), random.Uniform(), random.Uniform()}, w, Spectrum(Real(1))});
  }
  ThreadPool threads(1);
  return PhotonMap(PhotonBuffer(photons, count), threads);
}

std::vector<std::uint32_t> AllOf(const PhotonMap& map) {
  std::vector<std::uint32_t> photons(map.Size());
  std::iota(photons.begin(), photons.end(), 0u);
  return photons;
}

// Returns the mean angle between each direction and the next direction, in radians.
double MeanAngle(const PhotonMap& map, std::span<const std::uint32_t> photons) {
  double sum = 0;
  for (std::size_t i = 1; i < photons.size(); ++i) {
    const Real cosine = Dot(map.Direction(photons[i - 1]), map.Direction(photons[i]));
    sum += std::acos(std::clamp(double(cosine), -1., 1.));
  }
  return sum / double(photons.size() - 1);
}

TEST(DirectionOrder, HoldsEveryPhotonOnce) {
  const PhotonMap map = ScatteredMap(300);
  const std::vector<std::uint32_t> photons = AllOf(map);
  Arena arena;
  const auto ordered = HilbertOrder(map, photons, &arena);
  EXPECT_TRUE(std::is_permutation(ordered.begin(), ordered.end(), photons.begin(), photons.end()));
}

TEST(DirectionOrder, KeepsLikeDirectionsTogether) {
  const PhotonMap map = ScatteredMap(4096);
  const std::vector<std::uint32_t> photons = AllOf(map);
  Arena arena;
  EXPECT_GT(MeanAngle(map, photons), Radians(Real(60)));  // in storage order
  // Each cell of the curve holds about sixteen photons. Most photons follow a photon of the same
  // cell or of the cell before.
  EXPECT_LT(MeanAngle(map, HilbertOrder(map, photons, &arena)), Radians(Real(9)));
}

TEST(DirectionOrder, LeavesPhotonsOfOneDirectionAsTheyWere) {
  const std::vector<Photon> photons(50, Photon{{1, 2, 3}, {0, 0, 1}, Spectrum(1)});
  ThreadPool threads(1);
  const PhotonMap map(PhotonBuffer(photons, 1), threads);
  const std::vector<std::uint32_t> given{7, 3, 41, 12};
  Arena arena;
  const auto ordered = HilbertOrder(map, given, &arena);
  EXPECT_TRUE(std::equal(ordered.begin(), ordered.end(), given.begin(), given.end()));
}

TEST(DirectionOrder, OfNothingIsNothing) {
  const PhotonMap map = ScatteredMap(10);
  Arena arena;
  EXPECT_TRUE(HilbertOrder(map, {}, &arena).empty());
}

}  // namespace
}  // namespace exphoton
