// SPDX-License-Identifier: BSD-2-Clause
// AnimatedTransform interpolates between two transformations over a time interval and is constant
// before and after it. Both ends are decomposed into translation, rotation and stretch. Translation
// and stretch change linearly; the rotation turns at constant speed by the shortest way.
// docs/decisions/0010-motion.md derives the bounds.
#pragma once

#include "core/math/polar_decomposition.h"
#include "core/math/transform.h"

namespace exphoton {

class AnimatedTransform {
 public:
  AnimatedTransform() = default;                                    // identity, at rest
  AnimatedTransform(const Transform& at) : start_(at), end_(at) {}  // at rest

  // Makes the animation from `start` at times.min to `end` at times.max. Returns nullopt if no
  // interpolation avoids singular matrices; *problem then holds the reason, as the end of a
  // sentence.
  static std::optional<AnimatedTransform> Between(const Transform& start, const Transform& end,
                                                  Interval times, const char** problem);

  bool Moves() const { return moves_; }
  // Returns whether the transformation changes during the interval.
  bool MovesWithin(Interval interval) const {
    return moves_ && interval.min < interval.max && interval.min < times_.max &&
           times_.min < interval.max;
  }
  // Returns whether the rotation is half a turn. Both directions are then equally short, and
  // rounding decides between them.
  bool IsHalfTurn() const;

  Transform At(Real time) const;
  const Transform& Start() const { return start_; }
  const Transform& End() const { return end_; }
  Interval Times() const { return times_; }

  // Returns a box that contains the images of `box` at all times.
  Bounds3 ApplyBounds(const Bounds3& box) const;

 private:
  Transform Within(double u) const;  // 0 <= u <= 1 from start to end
  Transform Compose(const Matrix3& linear, const Matrix3& inverse, double u) const;

  Transform start_, end_;
  Interval times_{0, 0};
  bool moves_ = false;
  bool isTranslation_ = false;  // both ends have the same linear part
  Matrix3 rotation_{};          // at the start
  AxisAngle relativeRotation_;  // from rotation_ to the rotation at the end
  Matrix3 stretches_[2]{};      // at start and end
};

}  // namespace exphoton
