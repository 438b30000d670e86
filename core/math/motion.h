// SPDX-License-Identifier: BSD-2-Clause
// Motion: where a thing that moves is at each time: its own motion, and the motion of what it is a
// part of (an instance whose object has moving shapes).
#pragma once

#include "core/math/animated_transform.h"

namespace exphoton {

class Motion {
 public:
  explicit Motion(const AnimatedTransform& own, const AnimatedTransform& whole = {})
      : own_(own), whole_(whole), isPart_(whole.Moves() || !whole.Start().IsIdentity()) {}

  // The same thing as a part of something that stands, or moves, elsewhere.
  Motion PlacedBy(const AnimatedTransform& whole) const { return Motion(own_, whole); }

  // From the thing's own space to the world.
  Transform At(Real time) const {
    return isPart_ ? whole_.At(time) * own_.At(time) : own_.At(time);
  }
  Transform Start() const { return isPart_ ? whole_.Start() * own_.Start() : own_.Start(); }
  bool Moves() const { return own_.Moves() || whole_.Moves(); }
  Interval Times() const { return own_.Moves() ? own_.Times() : whole_.Times(); }
  bool MovesWithin(Interval interval) const {
    return own_.MovesWithin(interval) || whole_.MovesWithin(interval);
  }
  // Holds the images of the box at all times.
  Bounds3 ApplyBounds(const Bounds3& box) const {
    const Bounds3 bounds = own_.ApplyBounds(box);
    return isPart_ ? whole_.ApplyBounds(bounds) : bounds;
  }

  // From the world at `time` to the world at the motion's start: where what a ray meets now was
  // when everything began to move.
  Transform ToStart(Real time) const { return Start() * At(time).Inverted(); }

 private:
  AnimatedTransform own_, whole_;
  bool isPart_;
};

}  // namespace exphoton
