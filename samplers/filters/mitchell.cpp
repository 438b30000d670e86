// SPDX-License-Identifier: BSD-2-Clause
// The filter "mitchell" uses the piecewise cubics of Mitchell and Netravali 1988, "Reconstruction
// Filters in Computer Graphics", stretched to the given width. Its negative lobes sharpen edges.
#include <cmath>

#include "core/plugin.h"
#include "core/sampling/filter_table.h"

namespace exphoton {
namespace {

struct Settings {
  Real xWidth = 2, yWidth = 2;
  Real b = Real(1. / 3), c = Real(1. / 3);
};

const ParamTable<Settings>& Parameters() {
  static const ParamTable<Settings> table{
      Param("xwidth", &Settings::xWidth, "half of the width").Range(1e-3, 100).Unit("pixels"),
      Param("ywidth", &Settings::yWidth, "half of the height").Range(1e-3, 100).Unit("pixels"),
      Param("B", &Settings::b, "blur; B + 2C = 1 is best").Range(0, 1),
      Param("C", &Settings::c, "ringing").Range(0, 1)};
  return table;
}

// Evaluates equation 8 of the paper. x is in units of half the width; the result is 0 beyond 2.
double Cubic(double x, double b, double c) {
  if (x >= 2) return 0;
  if (x > 1)
    return (((-b - 6 * c) * x + (6 * b + 30 * c)) * x + (-12 * b - 48 * c)) * x / 6 +
           (8 * b + 24 * c) / 6;
  return ((12 - 9 * b - 6 * c) * x + (-18 + 12 * b + 6 * c)) * x * x / 6 + (6 - 2 * b) / 6;
}

FilterTable MakeTable(Real width, const Settings& s) {
  const double scale = 2 / double(width), b = s.b, c = s.c;
  return {[=](double x) { return Cubic(x * scale, b, c); }, double(width)};
}

class MitchellFilter final : public Filter {
 public:
  explicit MitchellFilter(const Settings& s)
      : s_(s), x_(MakeTable(s.xWidth, s)), y_(MakeTable(s.yWidth, s)) {}

  Real XWidth() const override { return s_.xWidth; }
  Real YWidth() const override { return s_.yWidth; }
  Real Evaluate(Point2 p) const override {
    if (std::abs(p.x) > s_.xWidth || std::abs(p.y) > s_.yWidth) return 0;
    return Real(Cubic(std::abs(double(p.x) * 2 / double(s_.xWidth)), double(s_.b), double(s_.c)) *
                Cubic(std::abs(double(p.y) * 2 / double(s_.yWidth)), double(s_.b), double(s_.c)));
  }
  FilterSample Sample(Point2 u) const override {
    const FilterTable::Value x = x_.Sample(u.x), y = y_.Sample(u.y);
    return {{x.x, y.x}, x.weight * y.weight};
  }

 private:
  Settings s_;
  FilterTable x_, y_;
};

std::unique_ptr<Filter> Create(const Settings& settings, const NoContext&) {
  return std::make_unique<MitchellFilter>(settings);
}

}  // namespace
}  // namespace exphoton

EXPHOTON_FILTER("mitchell", "Mitchell and Netravali's cubics")
