// SPDX-License-Identifier: BSD-2-Clause
// TestPlane and TestDirections count samples per cell, integrate the density over the cells, pool
// rare cells and evaluate the tail of the distribution.
#include "core/app/checks/chi_square.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace exphoton {
namespace {

using Density = std::function<double(double, double)>;

struct Rectangle {
  double x0, y0, dx, dy;
};

double TensorSum(const Density& f, const Rectangle& cell) {
  const auto& [x0, y0, dx, dy] = cell;
  // Gauss-Legendre quadrature uses 3 x 3 points.
  constexpr double kNode = 0.7745966692414834;
  const double node[3] = {(1 - kNode) / 2, 0.5, (1 + kNode) / 2};
  constexpr double kWeight[3] = {5.0 / 18, 8.0 / 18, 5.0 / 18};
  double sum = 0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      sum += kWeight[i] * kWeight[j] * f(x0 + node[i] * dx, y0 + node[j] * dy);
  return sum * dx * dy;
}

// Halves a cell until its quarters agree with the whole.
double Integrate(const Density& f, const Rectangle& cell, int depth, double whole, int level = 0) {
  const double hx = cell.dx / 2, hy = cell.dy / 2;
  const auto part = [&](int i) {
    return Rectangle{cell.x0 + (i & 1) * hx, cell.y0 + (i >> 1) * hy, hx, hy};
  };
  double quarter[4], sum = 0;
  for (int i = 0; i < 4; ++i) {
    quarter[i] = TensorSum(f, part(i));
    sum += quarter[i];
  }
  // The first levels are always halved, because a small bright part may lie between the points.
  constexpr int kAlways = 2;
  if (depth <= 0 || (level >= kAlways && std::abs(sum - whole) <= 1e-4 * std::abs(sum))) return sum;
  sum = 0;
  for (int i = 0; i < 4; ++i) sum += Integrate(f, part(i), depth - 1, quarter[i], level + 1);
  return sum;
}

struct Cell {
  double expected, observed;
};

// Compares counts with expectations. Cells with an expectation below 5 are pooled.
ChiSquareResult Compare(std::vector<Cell> cells, double mass) {
  ChiSquareResult result;
  result.mass = mass;
  std::sort(cells.begin(), cells.end(),
            [](const Cell& a, const Cell& b) { return a.expected < b.expected; });
  Cell pooled{0, 0};
  int used = 0;
  const auto add = [&](const Cell& cell) {
    const double difference = cell.observed - cell.expected;
    result.statistic += difference * difference / cell.expected;
    ++used;
  };
  for (const Cell& cell : cells) {
    if (pooled.expected >= 5 || (pooled.expected == 0 && cell.expected >= 5)) {
      if (pooled.expected > 0) add(pooled);
      pooled = {0, 0};
      add(cell);
    } else {
      pooled.expected += cell.expected;
      pooled.observed += cell.observed;
    }
  }
  if (pooled.expected > 0) add(pooled);
  result.degrees = std::max(used - 1, 0);
  result.pValue = used > 1 ? ChiSquareTail(result.statistic, used - 1) : 1;
  return result;
}

ChiSquareResult TestRectangle(
    const Rectangle& area,
    const std::function<std::optional<std::pair<double, double>>(RandomStream&)>& sample,
    const Density& pdf, const ChiSquareOptions& options) {
  const int rows = options.rows, columns = options.columns;
  const double samples = options.samples;
  std::vector<Cell> cells(std::size_t(rows * columns) + 1, Cell{0, 0});
  const double dx = area.dx / rows, dy = area.dy / columns;
  double mass = 0;
  for (int i = 0; i < rows; ++i) {
    for (int j = 0; j < columns; ++j) {
      const Rectangle cell{area.x0 + i * dx, area.y0 + j * dy, dx, dy};
      const double p = Integrate(pdf, cell, options.quadratureDepth, TensorSum(pdf, cell));
      cells[std::size_t(i * columns + j)].expected = p * samples;
      mass += p;
    }
  }
  RandomStream random(options.seed);
  int impossible = 0;
  for (int k = 0; k < options.samples; ++k) {
    const auto where = sample(random);
    std::size_t cell = cells.size() - 1;
    if (where) {
      impossible += !(pdf(where->first, where->second) > 0);
      const int i = int(std::floor((where->first - area.x0) / dx));
      const int j = int(std::floor((where->second - area.y0) / dy));
      if (i >= 0 && i < rows && j >= 0 && j < columns) cell = std::size_t(i * columns + j);
    }
    cells[cell].observed += 1;
  }
  // If the rest is no larger than the error of the quadrature, its cell cannot be tested.
  const double rest = 1 - mass;
  cells.back().expected = std::max(rest, 0.0) * samples;
  if (rest <= 1e-3 && cells.back().observed <= 2e-3 * samples) cells.pop_back();
  ChiSquareResult result = Compare(std::move(cells), mass);
  result.impossible = impossible;
  result.samples = options.samples;
  return result;
}

}  // namespace

double SignificanceOf(double falseAlarms, int testCount) {
  return -std::expm1(std::log1p(-falseAlarms) / testCount);
}

ChiSquareResult TestPlane(const PlaneGrid& grid,
                          const std::function<std::optional<Point2>(RandomStream&)>& sample,
                          const std::function<double(Point2)>& pdf,
                          const ChiSquareOptions& options) {
  const Rectangle area{double(grid.min.x), double(grid.min.y), double(grid.max.x - grid.min.x),
                       double(grid.max.y - grid.min.y)};
  const auto draw = [&](RandomStream& random) -> std::optional<std::pair<double, double>> {
    const auto p = sample(random);
    if (!p) return std::nullopt;
    return std::pair{double(p->x), double(p->y)};
  };
  const auto density = [&](double x, double y) { return pdf({Real(x), Real(y)}); };
  return TestRectangle(area, draw, density, options);
}

ChiSquareResult TestDirections(const DirectionGrid& grid,
                               const std::function<std::optional<Vector3>(RandomStream&)>& sample,
                               const std::function<double(const Vector3&)>& pdf,
                               const ChiSquareOptions& options) {
  const Frame frame = Frame::FromZ(NormalizeOr(grid.axis, {0, 0, 1}));
  constexpr double kTwoPi = 6.283185307179586;
  // The coordinates are 1 - cos(theta) and phi. Solid angle is their product measure.
  const auto draw = [&](RandomStream& random) -> std::optional<std::pair<double, double>> {
    const auto w = sample(random);
    if (!w) return std::nullopt;
    const double x = double(Dot(*w, frame.x)), y = double(Dot(*w, frame.y));
    const double z = double(Dot(*w, frame.z)), sin2 = x * x + y * y;
    const double oneMinusCos = z > 0 ? sin2 / (1 + std::sqrt(std::max(1 - sin2, 0.0))) : 1 - z;
    const double phi = std::atan2(y, x);
    return std::pair{std::clamp(oneMinusCos, 0.0, std::nextafter(2.0, 0.0)),
                     phi < 0 ? std::min(phi + kTwoPi, std::nextafter(kTwoPi, 0.0)) : phi};
  };
  const auto density = [&](double oneMinusCos, double phi) {
    const double sin = std::sqrt(std::max(oneMinusCos * (2 - oneMinusCos), 0.0));
    return pdf(Normalize(frame.ToWorld(
        Vector3(Real(sin * std::cos(phi)), Real(sin * std::sin(phi)), Real(1 - oneMinusCos)))));
  };
  return TestRectangle({0, 0, grid.oneMinusCosMax, kTwoPi}, draw, density, options);
}

}  // namespace exphoton
