// SPDX-License-Identifier: BSD-2-Clause
// The filter "sinc" is the ideal low-pass filter with tau lobes, windowed by the central lobe of a
// wider sinc (Lanczos).
#include <cmath>

#include "core/plugin.h"
#include "core/sampling/filter_table.h"

namespace exphoton {
namespace {

struct Settings {
  Real xWidth = 4, yWidth = 4;
  Real tau = 3;
};

const ParamTable<Settings>& Parameters() {
  static const ParamTable<Settings> table{
      Param("xwidth", &Settings::xWidth, "half of the width").Range(1e-3, 100).Unit("pixels"),
      Param("ywidth", &Settings::yWidth, "half of the height").Range(1e-3, 100).Unit("pixels"),
      Param("tau", &Settings::tau, "how many lobes lie within the width").Range(0.1, 64)};
  return table;
}

// x is in units of the width. The result is 0 beyond 1.
double WindowedSinc(double x, double tau) {
  if (x >= 1) return 0;
  const double a = M_PI * x;
  if (a < 1e-5) return 1;
  return std::sin(a * tau) / (a * tau) * (std::sin(a) / a);
}

FilterTable MakeTable(Real width, Real tau) {
  const double w = width, t = tau;
  return {[w, t](double x) { return WindowedSinc(x / w, t); }, w};
}

class SincFilter final : public Filter {
 public:
  explicit SincFilter(const Settings& s)
      : s_(s), x_(MakeTable(s.xWidth, s.tau)), y_(MakeTable(s.yWidth, s.tau)) {}

  Real XWidth() const override { return s_.xWidth; }
  Real YWidth() const override { return s_.yWidth; }
  Real Evaluate(Point2 p) const override {
    if (std::abs(p.x) > s_.xWidth || std::abs(p.y) > s_.yWidth) return 0;
    return Real(WindowedSinc(std::abs(double(p.x)) / double(s_.xWidth), double(s_.tau)) *
                WindowedSinc(std::abs(double(p.y)) / double(s_.yWidth), double(s_.tau)));
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
  return std::make_unique<SincFilter>(settings);
}

}  // namespace
}  // namespace exphoton

EXPHOTON_FILTER("sinc", "windowed sinc (Lanczos)")
