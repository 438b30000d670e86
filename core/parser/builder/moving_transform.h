// SPDX-License-Identifier: BSD-2-Clause
// MovingTransform is the current transformation at the two times given by TransformTimes.
// ActiveTimes selects which of the two transformations later directives change (ActiveTransform).
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

// Returns the motion from start to end over `times`. Throws Error(Scene) if they cannot be
// interpolated; `what` names the object in messages.
AnimatedTransform MotionBetween(const MovingTransform& transform, Interval times,
                                const std::string& what, const SourceLocation& where, Log& log);

}  // namespace exphoton
