// SPDX-License-Identifier: BSD-2-Clause
// Camera: the interface of cameras (plugins): a point on the film, on the lens and in time becomes
// a ray in world space.
#pragma once

#include "core/geometry/ray.h"
#include "core/math/animated_transform.h"

namespace exphoton {

struct CameraSample {
  Point2 film;    // in pixels from the full image's top left corner; pixel (0,0) spans [0,1)^2
  Point2 lens;    // in [0,1)^2
  Real time = 0;  // in [0,1), between shutter open and close
};

// What a camera plugin is created with besides its parameters.
struct CameraContext {
  AnimatedTransform cameraToWorld;
  int xResolution = 0, yResolution = 0;  // of the full image
};

class Camera {
 public:
  virtual ~Camera() = default;

  // A ray of unit direction; tMax is finite where the camera has a yon. With differentials for
  // one pixel's step if asked.
  virtual RayDifferential GenerateRay(const CameraSample& sample, bool withDifferentials) const = 0;

  virtual bool HasLens() const { return false; }  // draws lens samples
  // The times of its rays: from shutteropen to shutterclose.
  virtual Interval Shutter() const { return {0, 0}; }
  // Whether it is not the same at all times of the interval.
  virtual bool MovesWithin(Interval interval) const { return (void)interval, false; }
  virtual const Transform& CameraToWorld() const = 0;  // as the shutter opens
  // World to normalised device coordinates, for the EXR attribute; identity where there is none.
  virtual Matrix4 WorldToNdc() const { return {}; }
};

}  // namespace exphoton
