// SPDX-License-Identifier: BSD-2-Clause
// MovingEmitter is a surface that emits light while it moves. The surface at rest in its own space
// answers each query. Densities are scaled by the change of area and solid angle under the map to
// world space at the query's time, so any affine motion is sampled exactly.
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
  bool IsSampledUniformly() const override { return false; }
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
