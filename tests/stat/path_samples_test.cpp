// SPDX-License-Identifier: BSD-2-Clause
// The numbers of photon paths: every pair of coordinates fills the square evenly, within a request
// as a (0,2)-sequence does and between requests at least as independent numbers do. Requests that
// keep the same order give a wrong mean for each seed, however many the photons.
#include "integrators/photon/path_samples.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "tests/support/chi_square.h"

namespace exphoton {
namespace {

constexpr int kCoordinates = 14;  // five requests from sequences, two from the stream
constexpr int kCells = 16, kPaths = 16384;

using Path = std::array<Real, kCoordinates>;

std::vector<Path> MakePaths(std::uint64_t seed) {
  std::vector<Path> paths;
  const PathSequences sequences(seed, 0);
  for (int i = 0; i < kPaths; ++i) {
    PathSamples samples(sequences, std::uint64_t(i));
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

// Pearson's statistic over kCells x kCells; 255 is its mean for independent numbers.
double Statistic(const std::vector<Path>& paths, std::size_t a, std::size_t b) {
  std::array<int, kCells * kCells> counts{};
  for (const Path& path : paths)
    ++counts[std::size_t(int(path[a] * kCells) * kCells + int(path[b] * kCells))];
  const double expected = double(kPaths) / (kCells * kCells);
  double statistic = 0;
  for (const int count : counts) statistic += (count - expected) * (count - expected) / expected;
  return statistic;
}

// Of 91 pairs for each of four seeds, at a false-alarm rate of 1 % together.
TEST(PathSamples, FillsTheSquareOfAnyTwoCoordinates) {
  constexpr int kSeeds = 4;
  const double rate = 1 - std::pow(.99, 1.0 / (kSeeds * kCoordinates * (kCoordinates - 1) / 2));
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const std::vector<Path> paths = MakePaths(seed);
    for (std::size_t a = 0; a < kCoordinates; ++a) {
      for (std::size_t b = a + 1; b < kCoordinates; ++b) {
        const double statistic = Statistic(paths, a, b);
        EXPECT_GT(ChiSquareTail(statistic, kCells * kCells - 1), rate)
            << "coordinates " << a << " and " << b << ", seed " << seed << ": " << statistic;
      }
    }
  }
}

TEST(PathSamples, OfOneRequestFillsEveryCellAlike) {
  const std::vector<Path> paths = MakePaths(7);
  for (std::size_t request = 0; request < 10; request += 2)
    EXPECT_EQ(Statistic(paths, request, request + 1), 0);
}

TEST(PathSamples, DependsOnSeedAndPathAlone) {
  const PathSequences three(3, 5), four(4, 5);
  PathSamples a(three, 5), b(three, 5), other(four, 5), next(three, 6);
  const Point2 u = a.Next2D();
  EXPECT_EQ(u, b.Next2D());
  EXPECT_NE(u, other.Next2D());
  EXPECT_NE(u, next.Next2D());
}

// What follows the pairs of the sequences, and what roulette asks for beside them.
TEST(PathSamples, HasANewStreamWithEachSeedAndPath) {
  const PathSequences three(3, 5), four(4, 5);
  PathSamples a(three, 5), b(three, 5), other(four, 5), next(three, 6);
  for (PathSamples* path : {&a, &b, &other, &next})
    for (int pair = 0; pair < PathSequences::kPairs; ++pair) path->Next2D();
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
