// SPDX-License-Identifier: BSD-2-Clause
// EnvironmentMap is a function on the sphere, given by a latitude-longitude image and bilinear
// between texels. The polar angle is measured from +z, which is the top row. The azimuth is
// measured about z from x, which is the left edge. Columns wrap around.
#pragma once

#include <array>
#include <vector>

#include "core/math/sampling/distribution.h"
#include "core/math/spectrum.h"

namespace exphoton {

// Directions are sampled by the mean value in each cell, uniformly in solid angle within a cell.
// The density is positive wherever the value is.
class EnvironmentMap {
 public:
  // `texels` holds width * height values, at least one, row by row from +z.
  EnvironmentMap(std::vector<Spectrum> texels, int width, int height);

  // Returns the largest value of each channel. Unlike the integral, it cannot underflow to 0.
  const Spectrum& Largest() const { return largest_; }
  // Returns the sum over the cells of mean times solid angle. It is off by a few per cent for
  // coarse images. The light "infinite" uses it as its power.
  Spectrum CellIntegral() const { return {Real(cells_[0]), Real(cells_[1]), Real(cells_[2])}; }
  // Returns the integral of Evaluate over the sphere.
  Spectrum Integral() const;

  // Returns the largest value of Evaluate / Pdf for each channel. Takes a pass over all texels.
  Spectrum LargestWeight() const;

  // Directions are unit vectors in the space of the map.
  Spectrum Evaluate(const Vector3& w) const;
  Vector3 Sample(Point2 u) const;
  Real Pdf(const Vector3& w) const;  // density of Sample per solid angle

 private:
  // Position in texels: x in [0, width], y in [0, height].
  struct Coordinates {
    double x, y;
  };
  Coordinates ToMap(const Vector3& w) const;
  double OneMinusCosOfRow(int row) const;
  double CellSolidAngle(int row) const;
  Spectrum Texel(int x, int y) const;
  Spectrum CellMean(int x, int y) const;

  std::vector<Spectrum> texels_;
  int width_, height_;
  std::array<double, 3> cells_{};
  Spectrum largest_;
  PiecewiseConstant2D distribution_;
};

}  // namespace exphoton
