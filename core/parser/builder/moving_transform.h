// SPDX-License-Identifier: BSD-2-Clause
// The current transformation at the two times that TransformTimes names, and which of the two
// directives change (ActiveTransform).
#pragma once

#include <string>

#include "core/base/error.h"
#include "core/math/animated_transform.h"

namespace exphoton {

class Log;

struct MovingTransform {
  Transform start, end;

  bool Moves() const { return !(start == end); }
  MovingTransform Inverted() const { return {start.Inverted(), end.Inverted()}; }
};

enum class ActiveTimes { All, Start, End };

// The motion from one to the other. Throws Error(Scene) where there is none: `what` cannot move so.
AnimatedTransform MotionBetween(const MovingTransform& transform, Interval times,
                                const std::string& what, const SourceLocation& where, Log& log);

}  // namespace exphoton
