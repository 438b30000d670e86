// SPDX-License-Identifier: BSD-2-Clause
// Walls finds surfaces between two places that are close together. A density estimate takes the
// photons around a point for light at this point. A wall without thickness between them would let
// light through (docs/theory/exphotonmap.md, section 6, bias 9).
#pragma once

#include "core/math/vec.h"

namespace exphoton {

class Scene;
struct Ray;

// Surfaces that transmit specularly are no walls: light is alike on both sides of a pane.
class Walls {
 public:
  static constexpr Real kLift = Real(.05);

  // A point on a surface, and the unit direction into the free space before it: the normal on the
  // side in question, or the direction from which a photon arrived.
  struct Place {
    Point3 p;
    Vector3 free;
  };

  Walls() = default;  // there are no walls
  // The scene must outlive this object. Where shapes move, maps hold the photons of all times in
  // one pose (rest_pose.h), in which shapes need not have been together. Then there are no walls.
  explicit Walls(const Scene& scene);

  // The other functions need walls that exist.
  bool Exist() const { return scene_ != nullptr; }
  // Returns whether a surface blocks the segment between the places. Both ends move into the free
  // space by kLift times the distance, so that a curved surface does not come between its points.
  // False for places so close together that rounding would decide.
  bool AreBetween(const Place& a, const Place& b) const;
  // The same for a way round the edge of a solid on which both places may lie: both ends move into
  // the free space by the whole distance. False if a surface blocks the move of an end.
  bool AreBetweenRoundAnEdge(const Place& a, const Place& b) const;
  // Returns whether there is a surface close to the tangent plane of a place, at this distance (>
  // 0) in direction `along` (unit, in the plane).
  bool SurfaceContinues(const Place& from, const Vector3& along, Real distance) const;

 private:
  bool Blocks(const Ray& ray) const;
  // Returns whether a surface blocks the segment between the ends, which move by `lift` times their
  // distance.
  bool BlockLifted(const Place& a, const Place& b, Real lift) const;

  const Scene* scene_ = nullptr;
  bool hasGlass_ = false;
};

}  // namespace exphoton
