// SPDX-License-Identifier: BSD-2-Clause
// The filter "gaussian" is exp(-alpha x^2) on each axis, lowered to reach 0 at the edge.
#include <cmath>

#include "core/plugin.h"
#include "core/sampling/filter_table.h"

namespace exphoton {
namespace {

struct Settings {
  Real xWidth = 2, yWidth = 2;
  Real alpha = 2;  // 1 / pixel^2
};

const ParamTable<Settings>& Parameters() {
  static const ParamTable<Settings> table{
      Param("xwidth", &Settings::xWidth, "half of the width").Range(1e-3, 100).Unit("pixels"),
      Param("ywidth", &Settings::yWidth, "half of the height").Range(1e-3, 100).Unit("pixels"),
      Param("alpha", &Settings::alpha, "rate of the falloff: exp(-alpha x^2)")
          .Range(1e-6, 1e4)
          .Unit("1/pixel^2")};
  return table;
}

// Computes exp(-alpha x^2) - exp(-alpha width^2) without cancellation for small alpha.
double Gaussian(double x, double width, double alpha) {
  const double toEdge = alpha * std::max(width * width - x * x, 0.);
  return -std::exp(-alpha * x * x) * std::expm1(-toEdge);
}

// The table ends where the Gaussian falls below exp(-100).
FilterTable MakeTable(Real width, Real alpha) {
  const double w = width, a = alpha;
  return {[w, a](double x) { return Gaussian(x, w, a); }, std::min(w, std::sqrt(100 / a))};
}

class GaussianFilter final : public Filter {
 public:
  explicit GaussianFilter(const Settings& s)
      : s_(s), x_(MakeTable(s.xWidth, s.alpha)), y_(MakeTable(s.yWidth, s.alpha)) {}

  Real XWidth() const override { return s_.xWidth; }
  Real YWidth() const override { return s_.yWidth; }
  Real Evaluate(Point2 p) const override {
    if (std::abs(p.x) > s_.xWidth || std::abs(p.y) > s_.yWidth) return 0;
    return Real(Gaussian(double(p.x), double(s_.xWidth), double(s_.alpha)) *
                Gaussian(double(p.y), double(s_.yWidth), double(s_.alpha)));
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
  return std::make_unique<GaussianFilter>(settings);
}

}  // namespace
}  // namespace exphoton

EXPHOTON_FILTER("gaussian", "Gaussian falloff")
