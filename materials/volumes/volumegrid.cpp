// SPDX-License-Identifier: BSD-2-Clause
// The medium "volumegrid" interpolates densities on a grid trilinearly between cell centres.
// Between planes through cell centres the density along a ray is a cubic, which two-point Gauss
// quadrature integrates exactly.
#include <array>

#include "materials/volumes/common/box_medium.h"

namespace exphoton {
namespace {

struct Settings : MediumSettings {
  int nx = 1, ny = 1, nz = 1;
  std::vector<Real> density{1};

  void Validate() const {
    const std::size_t cells = std::size_t(nx) * std::size_t(ny) * std::size_t(nz);
    if (density.size() != cells)
      throw ParamError{"density",
                       "has " + std::to_string(density.size()) +
                           " values, but nx ny nz = " + std::to_string(cells),
                       "one value a cell, x first"};
    for (const Real value : density)
      if (!(value >= 0)) throw ParamError{"density", "must not be negative", ""};
  }
};

constexpr int kMaxCells = 4096;  // per axis

const ParamTable<Settings>& Parameters() {
  static const ParamTable<Settings> table{
      MediumParameters(), Param("nx", &Settings::nx, "cells in x").Range(1, kMaxCells),
      Param("ny", &Settings::ny, "cells in y").Range(1, kMaxCells),
      Param("nz", &Settings::nz, "cells in z").Range(1, kMaxCells),
      Param("density", &Settings::density, "one a cell, x first")};
  return table;
}

class Grid {
 public:
  explicit Grid(const Settings& s)
      : count_{s.nx, s.ny, s.nz},
        density_(s.density),
        box_(s.p0, s.p1),
        isZero_(std::ranges::all_of(density_, [](Real value) { return value == 0; })) {}

  bool IsZero() const { return isZero_; }

  double At(const Point3& p) const {
    std::array<double, 3> cell;
    for (int axis = 0; axis < 3; ++axis) cell[axis] = ToCells(p, axis);
    return Trilinear(cell);
  }

  double Integral(const Point3& o, const Vector3& d, Interval part) const {
    std::array<double, 3> start, slope;
    for (int axis = 0; axis < 3; ++axis) {
      start[axis] = ToCells(o, axis);
      const double extent = double(box_.max[axis]) - double(box_.min[axis]);
      slope[axis] = extent > 0 ? double(d[axis]) / extent * count_[axis] : 0;
    }
    const double end = double(part.max);
    double sum = 0, t = double(part.min);
    // A piece ends where the ray crosses the next plane through cell centres, on any axis.
    const int pieces = count_[0] + count_[1] + count_[2] + 6;
    for (int i = 0; i < pieces && t < end; ++i) {
      double next = end;
      for (int axis = 0; axis < 3; ++axis) {
        if (slope[axis] == 0) continue;
        const double at = start[axis] + slope[axis] * t;
        const double slack = 1e-9 * (1 + std::abs(at));
        const double plane =
            slope[axis] > 0 ? std::floor(at + slack) + 1 : std::ceil(at - slack) - 1;
        const double crossing = (plane - start[axis]) / slope[axis];
        if (crossing > t) next = std::min(next, crossing);
      }
      if (i == pieces - 1) next = end;
      sum += Piece(start, slope, t, next);
      t = next;
    }
    return sum;
  }

 private:
  // Returns a grid coordinate; the centre of cell 0 is at 0.
  double ToCells(const Point3& p, int axis) const {
    const double extent = double(box_.max[axis]) - double(box_.min[axis]);
    if (!(extent > 0)) return 0;
    return (double(p[axis]) - double(box_.min[axis])) / extent * count_[axis] - .5;
  }

  double Piece(const std::array<double, 3>& start, const std::array<double, 3>& slope, double t0,
               double t1) const {
    const double middle = (t0 + t1) / 2, half = (t1 - t0) / 2, offset = half / std::sqrt(3.0);
    double sum = 0;
    for (const double t : {middle - offset, middle + offset}) {
      std::array<double, 3> cell;
      for (int axis = 0; axis < 3; ++axis) cell[axis] = start[axis] + slope[axis] * t;
      sum += Trilinear(cell);
    }
    return half * sum;
  }

  double Value(const std::array<int, 3>& cell) const {
    std::array<int, 3> c;
    for (int axis = 0; axis < 3; ++axis) c[axis] = std::clamp(cell[axis], 0, count_[axis] - 1);
    return double(density_[(std::size_t(c[2]) * std::size_t(count_[1]) + std::size_t(c[1])) *
                               std::size_t(count_[0]) +
                           std::size_t(c[0])]);
  }

  double Trilinear(const std::array<double, 3>& at) const {
    std::array<int, 3> low;
    std::array<double, 3> share;
    for (int axis = 0; axis < 3; ++axis) {
      const double clamped = std::clamp(at[axis], -1.0, double(count_[axis]));
      low[axis] = int(std::floor(clamped));
      share[axis] = clamped - low[axis];
    }
    double sum = 0;
    for (int corner = 0; corner < 8; ++corner) {
      std::array<int, 3> cell = low;
      double weight = 1;
      for (int axis = 0; axis < 3; ++axis) {
        const bool isHigh = corner >> axis & 1;
        cell[axis] += isHigh;
        weight *= isHigh ? share[axis] : 1 - share[axis];
      }
      sum += weight * Value(cell);
    }
    return sum;
  }

  std::array<int, 3> count_;
  std::vector<Real> density_;
  Bounds3 box_;
  bool isZero_;  // all densities are 0
};

std::unique_ptr<Medium> Create(const Settings& settings, const MediumContext& context) {
  return std::make_unique<BoxMedium<Grid>>(settings, context, Grid(settings));
}

}  // namespace
}  // namespace exphoton

EXPHOTON_VOLUME("volumegrid", "a medium with densities on a grid")
