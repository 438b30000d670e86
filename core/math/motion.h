// SPDX-License-Identifier: BSD-2-Clause
// Motion gives the transformation of a moving thing at each time. It combines the thing's own
// motion with the motion of the whole that contains it, such as an instance whose object has moving
// shapes.
#pragma once

#include "core/math/animated_transform.h"

namespace exphoton {

class Motion {
 public:
  explicit Motion(const AnimatedTransform& own, const AnimatedTransform& whole = {})
      : own_(own), whole_(whole), isPart_(whole.Moves() || !whole.Start().IsIdentity()) {}

  // Returns the motion of the same thing as a part of a whole that is placed, or moves, elsewhere.
  Motion PlacedBy(const AnimatedTransform& whole) const { return Motion(own_, whole); }

  // Returns the transformation from the thing's own space to world space.
  Transform At(Real time) const {
    return isPart_ ? whole_.At(time) * own_.At(time) : own_.At(time);
  }
  Transform Start() const { return isPart_ ? whole_.Start() * own_.Start() : own_.Start(); }
  bool Moves() const { return own_.Moves() || whole_.Moves(); }
  Interval Times() const { return own_.Moves() ? own_.Times() : whole_.Times(); }
  bool MovesWithin(Interval interval) const {
    return own_.MovesWithin(interval) || whole_.MovesWithin(interval);
  }
  // Returns a box that contains the images of `box` at all times.
  Bounds3 ApplyBounds(const Bounds3& box) const {
    const Bounds3 bounds = own_.ApplyBounds(box);
    return isPart_ ? whole_.ApplyBounds(bounds) : bounds;
  }

  // Returns the transformation from world space at `time` to world space at the motion's start. It
  // maps a hit at `time` to the place of the same surface point when the motion began.
  Transform ToStart(Real time) const { return Start() * At(time).Inverted(); }

 private:
  AnimatedTransform own_, whole_;
  bool isPart_;
};

}  // namespace exphoton
