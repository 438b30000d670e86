// SPDX-License-Identifier: BSD-2-Clause
// EmbreeRoom is a set of triangles in Embree, with Embree's defaults for single rays. It is the
// opponent of the accelerators.
#pragma once

#include <embree3/rtcore.h>

#include <span>

#include "core/scene/primitive.h"

namespace exphoton {

class EmbreeRoom {
 public:
  // isRobust sets the flag that keeps rays from slipping between triangles. threads = 0: all.
  EmbreeRoom(const PrimitiveSet& set, bool isRobust, int threads = 1);
  ~EmbreeRoom();
  EmbreeRoom(const EmbreeRoom&) = delete;
  EmbreeRoom& operator=(const EmbreeRoom&) = delete;

  void Build();  // rebuilds from the vertices; the constructor builds, too
  Hit Intersect(const Ray& ray) const;
  bool Occluded(const Ray& ray) const;

 private:
  RTCDevice device_;
  RTCScene scene_;
  RTCGeometry geometry_;
};

}  // namespace exphoton
