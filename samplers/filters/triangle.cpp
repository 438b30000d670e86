// SPDX-License-Identifier: BSD-2-Clause
// The filter "triangle" falls linearly from the centre to the edge, on each axis.
#include <cmath>

#include "core/plugin.h"

namespace exphoton {
namespace {

struct Settings {
  Real xWidth = 2, yWidth = 2;
};

const ParamTable<Settings>& Parameters() {
  static const ParamTable<Settings> table{
      Param("xwidth", &Settings::xWidth, "half of the width").Range(1e-3, 100).Unit("pixels"),
      Param("ywidth", &Settings::yWidth, "half of the height").Range(1e-3, 100).Unit("pixels")};
  return table;
}

// Inverts the cumulative distribution of a triangle on [-1, 1].
Real InvertTriangle(Real u) {
  return u < Real(.5) ? std::sqrt(2 * u) - 1 : 1 - SafeSqrt(2 * (1 - u));
}

class TriangleFilter final : public Filter {
 public:
  explicit TriangleFilter(const Settings& s) : s_(s) {}

  Real XWidth() const override { return s_.xWidth; }
  Real YWidth() const override { return s_.yWidth; }
  Real Evaluate(Point2 p) const override {
    return std::max(Real(0), s_.xWidth - std::abs(p.x)) *
           std::max(Real(0), s_.yWidth - std::abs(p.y));
  }
  FilterSample Sample(Point2 u) const override {
    return {{InvertTriangle(u.x) * s_.xWidth, InvertTriangle(u.y) * s_.yWidth}, 1};
  }

 private:
  Settings s_;
};

std::unique_ptr<Filter> Create(const Settings& settings, const NoContext&) {
  return std::make_unique<TriangleFilter>(settings);
}

}  // namespace
}  // namespace exphoton

EXPHOTON_FILTER("triangle", "linear falloff")
