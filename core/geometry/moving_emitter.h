// SPDX-License-Identifier: BSD-2-Clause
// MovingEmitter: a surface that emits light while it moves. What is asked at a time is answered by
// the surface at rest in its own space, its densities changed as the map to the world then changes
// areas and solid angles; so that any affine motion is sampled exactly.
#pragma once

#include "core/geometry/shape.h"
#include "core/math/motion.h"

namespace exphoton {

class MovingEmitter final : public EmitterSurface {
 public:
  MovingEmitter(std::shared_ptr<const EmitterSurface> local, const Motion& motion);

  Real Area() const override { return area_; }
  Bounds3 Bounds() const override { return bounds_; }
  const char* EmitterProblem() const override { return local_->EmitterProblem(); }

  EmitterSample SamplePoint(Point2 u, Real uSubLight, Real time) const override;
  std::optional<EmitterSample> SampleToward(const SurfacePoint& ref, Point2 u,
                                            Real uSubLight) const override;
  Real PdfToward(const SurfacePoint& ref, const Vector3& wi, const SurfacePoint& on) const override;

 private:
  std::shared_ptr<const EmitterSurface> local_;
  Motion motion_;
  Real area_;
  Bounds3 bounds_;
};

}  // namespace exphoton
