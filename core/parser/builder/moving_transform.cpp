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
    throw Error(ExitStatus::Scene, what + " cannot move this way: " + problem, where,
                "its transformations at StartTime and at EndTime are interpolated");
  if (motion->IsHalfTurn())
    log.Warning(what + " rotates by half a turn: both directions are equally short", where,
                "rotate by less, for example 179 degrees");
  return *motion;
}

}  // namespace exphoton
