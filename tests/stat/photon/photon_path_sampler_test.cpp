// SPDX-License-Identifier: BSD-2-Clause
// These tests check the random numbers of photon paths. Every pair of coordinates must fill the
// unit square evenly: within a request like a (0,2)-sequence, and between requests at least like
// independent numbers. Requests with the same order would give each seed a wrong mean, with any
// number of photons.
#include "integrators/photon/shooting/photon_path_sampler.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "tests/support/chi_square.h"

namespace exphoton {
namespace {

constexpr int kCoordinates = 14;  // five requests from sequences, two from the stream
constexpr int kPathCells = 16, kPaths = 16384;

using Path = std::array<Real, kCoordinates>;

std::vector<Path> MakePaths(std::uint64_t seed) {
  std::vector<Path> paths;
  const PhotonPathSequences sequences(seed, 0);
  for (int i = 0; i < kPaths; ++i) {
    PhotonPathSampler samples(sequences, std::uint64_t(i));
    Path path;
    for (std::size_t k = 0; k < kCoordinates; k += 2) {
      const Point2 u = samples.Next2D();
      path[k] = u.x;
      path[k + 1] = u.y;
    }
    paths.push_back(path);
  }
  return paths;
}

// Returns Pearson's statistic over kPathCells x kPathCells cells. Its mean is 255 for independent
// numbers.
double Statistic(const std::vector<Path>& paths, std::size_t a, std::size_t b) {
  std::array<int, kPathCells * kPathCells> counts{};
  for (const Path& path : paths)
    ++counts[std::size_t(int(path[a] * kPathCells) * kPathCells + int(path[b] * kPathCells))];
  const double expected = double(kPaths) / (kPathCells * kPathCells);
  double statistic = 0;
  for (const int count : counts) statistic += (count - expected) * (count - expected) / expected;
  return statistic;
}

// The 91 pairs for each of four seeds have a false-alarm rate of 1 % together.
TEST(PhotonPathSampler, FillsTheSquareOfAnyTwoCoordinates) {
  constexpr int kSeeds = 4;
  const double rate = 1 - std::pow(.99, 1.0 / (kSeeds * kCoordinates * (kCoordinates - 1) / 2));
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const std::vector<Path> paths = MakePaths(seed);
    for (std::size_t a = 0; a < kCoordinates; ++a) {
      for (std::size_t b = a + 1; b < kCoordinates; ++b) {
        const double statistic = Statistic(paths, a, b);
        EXPECT_GT(ChiSquareTail(statistic, kPathCells * kPathCells - 1), rate)
            << "coordinates " << a << " and " << b << ", seed " << seed << ": " << statistic;
      }
    }
  }
}

TEST(PhotonPathSampler, OfOneRequestFillsEveryCellAlike) {
  const std::vector<Path> paths = MakePaths(7);
  for (std::size_t request = 0; request < 10; request += 2)
    EXPECT_EQ(Statistic(paths, request, request + 1), 0);
}

TEST(PhotonPathSampler, DependsOnSeedAndPathAlone) {
  const PhotonPathSequences three(3, 5), four(4, 5);
  PhotonPathSampler a(three, 5), b(three, 5), other(four, 5), next(three, 6);
  const Point2 u = a.Next2D();
  EXPECT_EQ(u, b.Next2D());
  EXPECT_NE(u, other.Next2D());
  EXPECT_NE(u, next.Next2D());
}

// What follows the pairs of the sequences, and what roulette asks for beside them.
TEST(PhotonPathSampler, HasANewStreamWithEachSeedAndPath) {
  const PhotonPathSequences three(3, 5), four(4, 5);
  PhotonPathSampler a(three, 5), b(three, 5), other(four, 5), next(three, 6);
  for (PhotonPathSampler* path : {&a, &b, &other, &next})
    for (int pair = 0; pair < PhotonPathSequences::kPairs; ++pair) path->Next2D();
  const Point2 u = a.Next2D();
  EXPECT_EQ(u, b.Next2D());
  EXPECT_NE(u, other.Next2D());
  EXPECT_NE(u, next.Next2D());
  const Real v = a.Independent();
  EXPECT_EQ(v, b.Independent());
  EXPECT_NE(v, other.Independent());
  EXPECT_NE(v, next.Independent());
}

}  // namespace
}  // namespace exphoton
