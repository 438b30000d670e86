// SPDX-License-Identifier: BSD-2-Clause
// Pearson's chi-square test of a sampler against its density: TestPlane tests rectangles and
// TestDirections tests directions. `exphoton check-plugin` and the project's own tests use them.
// Samples that fail or fall outside the grid fill one more cell, whose expectation is the rest of
// the probability. The test therefore also detects a density that is too low or too high
// everywhere.
#pragma once

#include <functional>
#include <optional>

#include "core/math/chi_square.h"
#include "core/math/sampling/random.h"
#include "core/math/vec.h"

namespace exphoton {

struct ChiSquareResult {
  double statistic = 0;
  int degrees = 0;     // number of cells after pooling, minus one
  double pValue = 1;   // probability of a statistic this large if sampler and density agree
  double mass = 0;     // integral of the density over the grid
  int impossible = 0;  // samples at which the density is 0
  int samples = 0;
};

// Returns the least p-value that passes one of `testCount` tests, for a false-alarm rate over all
// of them (Sidak).
double SignificanceOf(double falseAlarms, int testCount);

struct ChiSquareOptions {
  int rows = 16, columns = 32;
  int samples = 100000;
  std::uint64_t seed = 1;
  // Levels of halving in the quadrature of a cell. Densities with edges need more.
  int quadratureDepth = 5;
};

struct PlaneGrid {
  Point2 min{0, 0}, max{1, 1};
};
// pdf is per unit area of the rectangle.
ChiSquareResult TestPlane(const PlaneGrid& grid,
                          const std::function<std::optional<Point2>(RandomStream&)>& sample,
                          const std::function<double(Point2)>& pdf,
                          const ChiSquareOptions& options = {});

// DirectionGrid covers all directions in a cone about the axis. 2: the whole sphere.
struct DirectionGrid {
  Vector3 axis{0, 0, 1};
  double oneMinusCosMax = 2;
};
// pdf is per solid angle. Directions have unit length. All cells have the same solid angle.
ChiSquareResult TestDirections(const DirectionGrid& grid,
                               const std::function<std::optional<Vector3>(RandomStream&)>& sample,
                               const std::function<double(const Vector3&)>& pdf,
                               const ChiSquareOptions& options = {});

}  // namespace exphoton
