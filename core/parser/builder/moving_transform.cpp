// SPDX-License-Identifier: BSD-2-Clause
// MotionBetween converts a pair of transformations to an AnimatedTransform, with errors and
// warnings.
#include "core/parser/builder/moving_transform.h"

#include "core/base/log.h"

namespace exphoton {

AnimatedTransform MotionBetween(const MovingTransform& transform, Interval times,
                                const std::string& what, const SourceLocation& where, Log& log) {
  const char* problem = "";
  const auto motion = AnimatedTransform::Between(transform.start, transform.end, times, &problem);
  if (!motion)
    throw Error(ExitStatus::Scene, what + " cannot move so: " + problem, where,
                "its transformations at StartTime and at EndTime are interpolated");
  if (motion->IsHalfTurn())
    log.Warning(what + " turns by half a turn: which way round is left to chance", where,
                "turn by less, 179 degrees for example");
  return *motion;
}

}  // namespace exphoton
