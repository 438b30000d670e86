// SPDX-License-Identifier: BSD-2-Clause
// NurbsSurface evaluates a non-uniform rational B-spline surface. Source: Piegl and Tiller 1997,
// "The NURBS Book", equations 2.5 (basis functions) and 4.11 (rational surfaces).
#pragma once

#include <vector>

#include "core/geometry/vec3d.h"

namespace exphoton {

// A value of one parameter. At a crease, the spans on its two sides have different tangents.
struct NurbsParameter {
  double value;
  bool isFromLeft;  // takes the span that ends at the value; otherwise the one that begins there

  NurbsParameter(double v, bool fromLeft = false) : value(v), isFromLeft(fromLeft) {}  // implicit
  friend bool operator==(const NurbsParameter&, const NurbsParameter&) = default;
};

// One direction of the parameter domain. The basis functions have degree order - 1; there are
// knots.size() - order of them.
struct NurbsBasis {
  int order = 2;              // >= 1
  std::vector<double> knots;  // not decreasing

  int Count() const { return int(knots.size()) - order; }
  double First() const { return knots[std::size_t(order - 1)]; }  // start of the valid domain
  double Last() const { return knots[std::size_t(Count())]; }     // end of the valid domain
  // Returns whether the slope may jump at t: t is a knot of multiplicity order - 1 or more.
  bool IsCrease(double t) const;
  // Returns at least `least` + 1 parameters from `from` to `to`, ascending, with at least
  // `perSpan` steps between knots. Every knot in between is one of them. A crease in between
  // appears twice, first from the left; one at the end appears from the left only.
  std::vector<NurbsParameter> Subdivide(double from, double to, int least, int perSpan) const;
  // Returns the index of the knot at which the span of t begins.
  int SpanOf(const NurbsParameter& t) const;
  // Writes the `order` basis functions that may differ from 0 at t, and their derivatives. Returns
  // the index of the first of them. At a knot of full multiplicity the values are exactly 0 and 1.
  int Evaluate(const NurbsParameter& t, std::vector<double>* values,
               std::vector<double>* slopes) const;
};

// A control point in homogeneous coordinates: p is the position times the weight w.
struct NurbsControl {
  Vec3d p;
  double w = 1;
};

struct NurbsPoint {
  Vec3d p;
  // Unit, along dp/du x dp/dv. Where this product vanishes, such as at a pole, it is the normal
  // slightly inside the span, or 0 where the product vanishes there, too.
  Vec3d normal;
};

struct NurbsSurface {
  NurbsBasis u, v;
  std::vector<NurbsControl> controls;  // u fastest: u.Count() x v.Count()

  NurbsPoint At(const NurbsParameter& s, const NurbsParameter& t) const;
};

}  // namespace exphoton
