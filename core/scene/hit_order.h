// SPDX-License-Identifier: BSD-2-Clause
// Wins decides which of two hits is first. The nearer hit wins; ties go to the lower instance, then
// to the lower primitive. It is inline for the loops of accelerators, so that all accelerators
// resolve ties equally.
#pragma once

#include "core/scene/primitive.h"

namespace exphoton {

// Returns whether a hit at t with these ids wins over `hit`. Without a hit so far, hit.t is the end
// of the search interval, and a hit exactly there does not count.
inline bool Wins(Real t, std::uint32_t instance, std::uint32_t primitive, const Hit& hit) {
  if (t != hit.t) return t < hit.t;
  if (!hit.IsHit()) return false;
  if (instance != hit.instance) return instance < hit.instance;
  return primitive < hit.primitive;
}

}  // namespace exphoton
