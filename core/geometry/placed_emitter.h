// SPDX-License-Identifier: BSD-2-Clause
// PlacedEmitter samples a surface through an affine map. It samples the surface in local space and
// scales the densities by the change of area and solid angle. This is exact for any invertible
// affine map. The space after the map is called "world" here.
#pragma once

#include <memory>

#include "core/geometry/shape.h"
#include "core/math/transform.h"

namespace exphoton {

// These are EmitterSurface's methods for `local` under the map. Arguments and results are in world
// space. Densities in area measure are 1 / the area of `local`, divided by the local change of
// area.
EmitterSample SamplePlacedPoint(const EmitterSurface& local, const Transform& toWorld, Point2 u,
                                Real uSubLight, Real time);
std::optional<EmitterSample> SamplePlacedToward(const EmitterSurface& local,
                                                const Transform& toWorld, const SurfacePoint& ref,
                                                Point2 u, Real uSubLight);
Real PdfPlacedToward(const EmitterSurface& local, const Transform& toWorld, const SurfacePoint& ref,
                     const Vector3& wi, const SurfacePoint& on);

// Returns the area of `local` under the map. Integrates numerically with 4096 points of the
// surface. The relative error is below 1e-3.
Real PlacedArea(const EmitterSurface& local, const Transform& toWorld);

// PlacedEmitter is a surface of one part (not a mesh) that is placed once and does not move.
class PlacedEmitter final : public EmitterSurface {
 public:
  PlacedEmitter(std::unique_ptr<const EmitterSurface> local, const Transform& toWorld)
      : local_(std::move(local)), toWorld_(toWorld), area_(PlacedArea(*local_, toWorld_)) {}

  Real Area() const override { return area_; }
  Bounds3 Bounds() const override { return toWorld_.ApplyBounds(local_->Bounds()); }
  EmitterSample SamplePoint(Point2 u, Real uSubLight, Real time) const override {
    return SamplePlacedPoint(*local_, toWorld_, u, uSubLight, time);
  }
  bool IsSampledUniformly() const override { return false; }
  std::optional<EmitterSample> SampleToward(const SurfacePoint& ref, Point2 u,
                                            Real uSubLight) const override {
    return SamplePlacedToward(*local_, toWorld_, ref, u, uSubLight);
  }
  Real PdfToward(const SurfacePoint& ref, const Vector3& wi,
                 const SurfacePoint& on) const override {
    return PdfPlacedToward(*local_, toWorld_, ref, wi, on);
  }

 private:
  std::unique_ptr<const EmitterSurface> local_;
  Transform toWorld_;
  Real area_;
};

}  // namespace exphoton
