// SPDX-License-Identifier: BSD-2-Clause
// AnimatedTransform: a transformation that changes between two times, and stays as it is before and
// after. Both ends are taken apart into translation, rotation and stretch; translations and
// stretches run straight, the rotation turns evenly by the shortest way. Derivation of the bounds:
// docs/decisions/0010-motion.md.
#pragma once

#include "core/math/polar_decomposition.h"
#include "core/math/transform.h"

namespace exphoton {

class AnimatedTransform {
 public:
  AnimatedTransform() = default;                                    // identity, at rest
  AnimatedTransform(const Transform& at) : start_(at), end_(at) {}  // at rest

  // From `start` at times.min to `end` at times.max. Where there is no way from one to the other
  // that keeps clear of singular matrices: nullopt, and *problem says why, as a sentence's end.
  static std::optional<AnimatedTransform> Between(const Transform& start, const Transform& end,
                                                  Interval times, const char** problem);

  bool Moves() const { return moves_; }
  // Whether it is not the same at all times of the interval.
  bool MovesWithin(Interval interval) const {
    return moves_ && interval.min < interval.max && interval.min < times_.max &&
           times_.min < interval.max;
  }
  // Whether it turns by half a turn, so that either way round is as short: which is taken, rounding
  // decides.
  bool IsHalfTurn() const;

  Transform At(Real time) const;
  const Transform& Start() const { return start_; }
  const Transform& End() const { return end_; }
  Interval Times() const { return times_; }

  // Holds the images of the box at all times.
  Bounds3 ApplyBounds(const Bounds3& box) const;

 private:
  Transform Within(double u) const;  // 0 <= u <= 1 from start to end
  Transform Compose(const Matrix3& linear, const Matrix3& inverse, double u) const;

  Transform start_, end_;
  Interval times_{0, 0};
  bool moves_ = false;
  bool isTranslation_ = false;  // both ends have the same linear part
  Matrix3 rotation_{};          // at the start
  Turn turn_;                   // from there to the rotation at the end
  Matrix3 stretches_[2]{};      // at start and end
};

}  // namespace exphoton
