// SPDX-License-Identifier: BSD-2-Clause
// NurbsSurface computes basis functions by the recursion of Cox and de Boor.
#include "shapes/mesh/nurbs_surface.h"

#include <algorithm>

namespace exphoton {

std::vector<double> NurbsBasis::Subdivide(double from, double to, int least, int perSpan) const {
  std::vector<double> ends{from};
  for (const double knot : knots)
    if (knot > ends.back() && knot < to) ends.push_back(knot);
  ends.push_back(to);
  const int spans = int(ends.size()) - 1, steps = std::max(perSpan, (least + spans - 1) / spans);
  std::vector<double> parameters{from};
  for (std::size_t i = 1; i < ends.size(); ++i) {
    for (int k = 1; k < steps; ++k)
      parameters.push_back(ends[i - 1] + (ends[i] - ends[i - 1]) * k / steps);
    parameters.push_back(ends[i]);
  }
  return parameters;
}

int NurbsBasis::Evaluate(double t, std::vector<double>* values, std::vector<double>* slopes) const {
  // The span that t lies in; the last one that is not empty if t is the end of the domain.
  const auto domain = knots.begin() + (order - 1);
  auto after = std::upper_bound(domain, knots.begin() + Count(), t);
  if (after == knots.begin() + Count() && t >= Last())
    after = std::lower_bound(domain, knots.begin() + Count(), Last());
  const int span = std::max(int(after - knots.begin()) - 1, order - 1);

  const auto knot = [this](int i) { return knots[std::size_t(i)]; };
  const auto at = [](std::vector<double>& list, int i) -> double& { return list[std::size_t(i)]; };
  values->assign(std::size_t(order), 0);
  slopes->assign(std::size_t(order), 0);
  values->front() = 1;
  for (int degree = 1; degree < order; ++degree) {
    if (degree == order - 1) {
      for (int i = 0; i < degree; ++i) {
        const int first = span - degree + 1 + i;
        const double slope = degree * at(*values, i) / (knot(first + degree) - knot(first));
        at(*slopes, i) -= slope;
        at(*slopes, i + 1) += slope;
      }
    }
    double carried = 0;
    for (int i = 0; i < degree; ++i) {
      const int first = span - degree + 1 + i;
      // A share of 0 or 1 leaves the values exact.
      const double share = (t - knot(first)) / (knot(first + degree) - knot(first));
      const double value = at(*values, i);
      at(*values, i) = carried + value * (1 - share);
      carried = value * share;
    }
    at(*values, degree) = carried;
  }
  return span - order + 1;
}

NurbsPoint NurbsSurface::At(double s, double t) const {
  std::vector<double> atS, atT, slopeS, slopeT;
  const int firstS = u.Evaluate(s, &atS, &slopeS), firstT = v.Evaluate(t, &atT, &slopeT);
  NurbsControl sum{{}, 0}, sumS{{}, 0}, sumT{{}, 0};
  const auto add = [](NurbsControl* to, const NurbsControl& control, double weight) {
    to->p = to->p + control.p * weight;
    to->w += control.w * weight;
  };
  for (std::size_t j = 0; j < atT.size(); ++j) {
    const std::size_t row = (std::size_t(firstT) + j) * std::size_t(u.Count());
    for (std::size_t i = 0; i < atS.size(); ++i) {
      const NurbsControl& control = controls[row + std::size_t(firstS) + i];
      add(&sum, control, atS[i] * atT[j]);
      add(&sumS, control, slopeS[i] * atT[j]);
      add(&sumT, control, atS[i] * slopeT[j]);
    }
  }
  const Vec3d p = sum.p * (1 / sum.w);
  const Vec3d alongS = sumS.p - p * sumS.w, alongT = sumT.p - p * sumT.w;
  return {p, NormalizeOrZero(Cross(alongS, alongT))};
}

}  // namespace exphoton
