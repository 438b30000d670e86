// SPDX-License-Identifier: BSD-2-Clause
// Which of two hits wins: the nearer; of equally near ones that of the lower instance, then of the
// lower primitive. Inline for the loops of accelerators, so that all agree on every tie.
#pragma once

#include "core/scene/primitive.h"

namespace exphoton {

// Whether a hit at t of these ids wins over *hit. At the end of the search interval (no hit yet)
// nothing ties.
inline bool Wins(Real t, std::uint32_t instance, std::uint32_t primitive, const Hit& hit) {
  if (t != hit.t) return t < hit.t;
  if (!hit.IsHit()) return false;
  if (instance != hit.instance) return instance < hit.instance;
  return primitive < hit.primitive;
}

}  // namespace exphoton
