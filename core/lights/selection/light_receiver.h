// SPDX-License-Identifier: BSD-2-Clause
// LightReceiver is the place that a LightSampler chooses a light for. A surface adds its normals,
// because light from behind it does not count, and other light counts by its cosine.
#pragma once

#include "core/math/vec.h"

namespace exphoton {

struct LightReceiver {
  LightReceiver() = default;
  LightReceiver(const Point3& point) : p(point) {}
  LightReceiver(const Point3& point, const Normal3& side, const Normal3& shading)
      : p(point), n(side), ns(shading) {}

  Point3 p;    // in world space
  Normal3 n;   // geometric, unit; only light from its side counts. 0: light from both sides counts
  Normal3 ns;  // shading normal, unit, of either side; 0: light counts without its cosine
  Real distantProbability = -1;  // set by LightSampler::Prepared
};

}  // namespace exphoton
