// SPDX-License-Identifier: BSD-2-Clause
// NurbsSurface evaluates a non-uniform rational B-spline surface. Source: Piegl and Tiller 1997,
// "The NURBS Book", equations 2.5 (basis functions) and 4.11 (rational surfaces).
#pragma once

#include <vector>

#include "core/geometry/vec3d.h"

namespace exphoton {

// One direction of the parameter domain. The basis functions have degree order - 1; there are
// knots.size() - order of them.
struct NurbsBasis {
  int order = 2;              // >= 1
  std::vector<double> knots;  // not decreasing

  int Count() const { return int(knots.size()) - order; }
  double First() const { return knots[std::size_t(order - 1)]; }  // start of the valid domain
  double Last() const { return knots[std::size_t(Count())]; }     // end of the valid domain
  // Returns at least `least` + 1 parameters from `from` to `to`, ascending, with at least
  // `perSpan` steps between knots. Every knot in between is one of them.
  std::vector<double> Subdivide(double from, double to, int least, int perSpan) const;
  // Writes the `order` basis functions that may differ from 0 at t, and their derivatives. Returns
  // the index of the first of them. At a knot of full multiplicity the values are exactly 0 and 1.
  int Evaluate(double t, std::vector<double>* values, std::vector<double>* slopes) const;
};

// A control point in homogeneous coordinates: p is the position times the weight w.
struct NurbsControl {
  Vec3d p;
  double w = 1;
};

struct NurbsPoint {
  Vec3d p;
  Vec3d normal;  // unit, along dp/du x dp/dv; 0 where the surface is singular
};

struct NurbsSurface {
  NurbsBasis u, v;
  std::vector<NurbsControl> controls;  // u fastest: u.Count() x v.Count()

  NurbsPoint At(double s, double t) const;
};

}  // namespace exphoton
