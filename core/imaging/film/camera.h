// SPDX-License-Identifier: BSD-2-Clause
// Camera is the interface of cameras (plugins). It maps a point on the film, a point on the lens
// and a time to a ray in world space.
#pragma once

#include <optional>

#include "core/geometry/ray.h"
#include "core/math/animated_transform.h"

namespace exphoton {

struct CameraSample {
  Point2 film;    // in pixels from the full image's top left corner; pixel (0,0) covers [0,1)^2
  Point2 lens;    // in [0,1)^2
  Real time = 0;  // in [0,1), from shutter open to shutter close
};

// The data that a camera plugin receives besides its parameters.
struct CameraContext {
  AnimatedTransform cameraToWorld;
  int xResolution = 0, yResolution = 0;  // of the full image
};

class Camera {
 public:
  virtual ~Camera() = default;

  // Returns a ray of unit direction. tMax is finite if the camera has a yon distance. The
  // differentials, if requested, are for a step of one pixel.
  virtual RayDifferential GenerateRay(const CameraSample& sample, bool withDifferentials) const = 0;

  virtual bool HasLens() const { return false; }  // whether it uses lens samples
  // Returns the shutter interval, from shutteropen to shutterclose.
  virtual Interval Shutter() const { return {0, 0}; }
  // Returns whether the camera moves during the interval.
  virtual bool MovesWithin(Interval interval) const { return (void)interval, false; }
  virtual const Transform& CameraToWorld() const = 0;  // at shutter open
  // Returns the depth of a point in world space at this time, in camera units: z in camera space,
  // or the distance if the camera sees all directions.
  virtual Real Depth(const Point3& p, Real time) const {
    return (void)time, CameraToWorld().Inverted().ApplyPoint(p).z;
  }
  // World to normalised device coordinates, for the EXR attribute; identity if there is none.
  virtual Matrix4 WorldToNdc() const { return {}; }
  // The same for rays through one point of the lens: a point of the world is projected to the film
  // place whose ray meets it. `point` is in the unit disk, and (0, 0) is the centre: SampleDisk of
  // CameraSample::lens. Along each axis, the place must depend linearly on the point. nullopt: the
  // camera does not know it, so lamps out of focus are left to chance.
  virtual std::optional<Matrix4> WorldToNdcThrough(Point2 point) const {
    return (void)point, std::nullopt;
  }
};

}  // namespace exphoton
