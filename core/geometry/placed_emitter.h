// SPDX-License-Identifier: BSD-2-Clause
// Sampling a surface through an affine map: a surface in its own space is sampled there, and the
// densities change as the map changes areas and solid angles. Exact for any invertible affine map.
// Points and directions outside are called "world" here.
#pragma once

#include <memory>

#include "core/geometry/shape.h"
#include "core/math/transform.h"

namespace exphoton {

// EmitterSurface's methods for `local` under the map; arguments and results are in world space.
// Densities per area are 1 / the area of `local`, divided by the local change of area.
EmitterSample SamplePlacedPoint(const EmitterSurface& local, const Transform& toWorld, Point2 u,
                                Real uSubLight, Real time);
std::optional<EmitterSample> SamplePlacedToward(const EmitterSurface& local,
                                                const Transform& toWorld, const SurfacePoint& ref,
                                                Point2 u, Real uSubLight);
Real PdfPlacedToward(const EmitterSurface& local, const Transform& toWorld, const SurfacePoint& ref,
                     const Vector3& wi, const SurfacePoint& on);

// A surface of one part (no mesh) that is placed once and stays there.
class PlacedEmitter final : public EmitterSurface {
 public:
  PlacedEmitter(std::unique_ptr<const EmitterSurface> local, const Transform& toWorld)
      : local_(std::move(local)), toWorld_(toWorld) {}

  // By quadrature (4096 points of the surface; relative error below 1e-3), at each call.
  Real Area() const override;
  Bounds3 Bounds() const override { return toWorld_.ApplyBounds(local_->Bounds()); }
  EmitterSample SamplePoint(Point2 u, Real uSubLight, Real time) const override {
    return SamplePlacedPoint(*local_, toWorld_, u, uSubLight, time);
  }
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
};

}  // namespace exphoton
