// SPDX-License-Identifier: BSD-2-Clause
// The filter "box" weights all points of a rectangle equally.
#include <cmath>

#include "core/plugin.h"

namespace exphoton {
namespace {

struct Settings {
  Real xWidth = Real(.5), yWidth = Real(.5);
};

const ParamTable<Settings>& Parameters() {
  static const ParamTable<Settings> table{
      Param("xwidth", &Settings::xWidth, "half of the width").Range(1e-3, 100).Unit("pixels"),
      Param("ywidth", &Settings::yWidth, "half of the height").Range(1e-3, 100).Unit("pixels")};
  return table;
}

class BoxFilter final : public Filter {
 public:
  explicit BoxFilter(const Settings& s) : s_(s) {}

  Real XWidth() const override { return s_.xWidth; }
  Real YWidth() const override { return s_.yWidth; }
  Real Evaluate(Point2 p) const override {
    return std::abs(p.x) <= s_.xWidth && std::abs(p.y) <= s_.yWidth ? Real(1) : Real(0);
  }
  FilterSample Sample(Point2 u) const override {
    return {{(2 * u.x - 1) * s_.xWidth, (2 * u.y - 1) * s_.yWidth}, 1};
  }

 private:
  Settings s_;
};

std::unique_ptr<Filter> Create(const Settings& settings, const NoContext&) {
  return std::make_unique<BoxFilter>(settings);
}

}  // namespace
}  // namespace exphoton

EXPHOTON_FILTER("box", "constant over a rectangle")
