// SPDX-License-Identifier: BSD-2-Clause
// NurbsSurface computes basis functions by the recursion of Cox and de Boor, and normals from
// derivatives that are larger than their rounding errors.
#include "shapes/mesh/nurbs_surface.h"

#include <algorithm>
#include <cmath>

namespace exphoton {

bool NurbsBasis::IsCrease(double t) const {
  const auto [first, last] = std::equal_range(knots.begin(), knots.end(), t);
  return last - first >= order - 1;
}

std::vector<NurbsParameter> NurbsBasis::Subdivide(double from, double to, int least,
                                                  int perSpan) const {
  std::vector<double> ends{from};
  for (const double knot : knots)
    if (knot > ends.back() && knot < to) ends.push_back(knot);
  ends.push_back(to);
  const int spans = int(ends.size()) - 1, steps = std::max(perSpan, (least + spans - 1) / spans);
  std::vector<NurbsParameter> parameters{from};
  for (std::size_t i = 1; i < ends.size(); ++i) {
    for (int k = 1; k < steps; ++k)
      parameters.push_back(ends[i - 1] + (ends[i] - ends[i - 1]) * k / steps);
    const bool isCrease = IsCrease(ends[i]);
    parameters.push_back({ends[i], isCrease});
    if (isCrease && i < ends.size() - 1) parameters.push_back(ends[i]);
  }
  return parameters;
}

int NurbsBasis::SpanOf(const NurbsParameter& t) const {
  // The end of the domain lies in the last span that is not empty.
  const bool isFromLeft = t.isFromLeft || t.value >= Last();
  const auto begin = knots.begin() + (order - 1), end = knots.begin() + Count();
  const auto after = isFromLeft ? std::lower_bound(begin, end, std::min(t.value, Last()))
                                : std::upper_bound(begin, end, t.value);
  return std::max(int(after - knots.begin()) - 1, order - 1);
}

int NurbsBasis::Evaluate(const NurbsParameter& t, std::vector<double>* values,
                         std::vector<double>* slopes) const {
  const int span = SpanOf(t);
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
      const double share = (t.value - knot(first)) / (knot(first + degree) - knot(first));
      const double value = at(*values, i);
      at(*values, i) = carried + value * (1 - share);
      carried = value * share;
    }
    at(*values, degree) = carried;
  }
  return span - order + 1;
}

namespace {

// A weighted sum of control points. The sums of absolute values bound the terms that cancel.
struct ControlSum {
  Vec3d p;
  double w = 0, sizeOfP = 0, sizeOfW = 0;

  void Add(const NurbsControl& control, double weight) {
    p = p + control.p * weight;
    w += control.w * weight;
    sizeOfP += Length(control.p) * std::abs(weight);
    sizeOfW += control.w * std::abs(weight);
  }
};

// A point with its two derivatives times the weight.
struct SurfaceFrame {
  Vec3d p, across;  // across: the product of the derivatives
  bool isCollapsedS = false, isCollapsedT = false, isSingular = false;
};

// Control points are rounded to single precision or to the digits of a file. A smaller part of
// their sum is a rounding error.
constexpr double kControlNoise = 1e-6;

SurfaceFrame FrameAt(const NurbsSurface& surface, const NurbsParameter& s,
                     const NurbsParameter& t) {
  std::vector<double> atS, atT, slopeS, slopeT;
  const int firstS = surface.u.Evaluate(s, &atS, &slopeS);
  const int firstT = surface.v.Evaluate(t, &atT, &slopeT);
  ControlSum sum, sumS, sumT;
  for (std::size_t j = 0; j < atT.size(); ++j) {
    const std::size_t row = (std::size_t(firstT) + j) * std::size_t(surface.u.Count());
    for (std::size_t i = 0; i < atS.size(); ++i) {
      const NurbsControl& control = surface.controls[row + std::size_t(firstS) + i];
      sum.Add(control, atS[i] * atT[j]);
      sumS.Add(control, slopeS[i] * atT[j]);
      sumT.Add(control, atS[i] * slopeT[j]);
    }
  }
  const Vec3d p = sum.p * (1 / sum.w);
  const Vec3d alongS = sumS.p - p * sumS.w, alongT = sumT.p - p * sumT.w;
  const auto isNoise = [&](const Vec3d& derivative, const ControlSum& terms) {
    return Length(derivative) <= kControlNoise * (terms.sizeOfP + Length(p) * terms.sizeOfW);
  };
  SurfaceFrame frame{p, Cross(alongS, alongT)};
  frame.isCollapsedS = isNoise(alongS, sumS);
  frame.isCollapsedT = isNoise(alongT, sumT);
  frame.isSingular = frame.isCollapsedS || frame.isCollapsedT ||
                     Length(frame.across) <= kControlNoise * Length(alongS) * Length(alongT);
  return frame;
}

// Returns the parameter that is moved by this part of its span into the span.
NurbsParameter MovedInside(const NurbsBasis& basis, const NurbsParameter& t, double part) {
  const auto span = std::size_t(basis.SpanOf(t));
  const double first = basis.knots[span], last = basis.knots[span + 1];
  const double step = (last - first) * part;
  return t.value < (first + last) / 2 ? t.value + step : t.value - step;
}

}  // namespace

NurbsPoint NurbsSurface::At(const NurbsParameter& s, const NurbsParameter& t) const {
  const SurfaceFrame frame = FrameAt(*this, s, t);
  SurfaceFrame regular = frame;
  // An edge along s that is collapsed to a point becomes regular when t moves. If this does not
  // suffice, both parameters move. The step balances the turn of the normal along it and the
  // rounding of the control points. If no step suffices, control points lie closer together than
  // rounding errors, and the frame at the point is as good as any.
  bool movesS = frame.isCollapsedT || !frame.isCollapsedS;
  bool movesT = frame.isCollapsedS || !frame.isCollapsedT;
  for (const double part : {0x1p-10, 0x1p-8, 0x1p-6, 0x1p-4}) {
    if (!regular.isSingular) break;
    regular =
        FrameAt(*this, movesS ? MovedInside(u, s, part) : s, movesT ? MovedInside(v, t, part) : t);
    movesS = movesT = true;
  }
  return {frame.p, NormalizeOrZero((regular.isSingular ? frame : regular).across)};
}

}  // namespace exphoton
