// SPDX-License-Identifier: BSD-2-Clause
// MovingEmitter passes each query to the surface at rest, with the map at the query's time.
#include "core/geometry/moving_emitter.h"

#include "core/geometry/placed_emitter.h"

namespace exphoton {

// A map that scales all axes by s scales areas by s^2. s is linear in time, so Simpson's rule gives
// the mean exactly. If axes are scaled differently, the mean is an estimate.
MovingEmitter::MovingEmitter(std::shared_ptr<const EmitterSurface> local, const Motion& motion)
    : local_(std::move(local)), motion_(motion), bounds_(motion.ApplyBounds(local_->Bounds())) {
  const auto scale = [&](Real time) { return std::pow(motion.At(time).VolumeScale(), 2. / 3); };
  const Interval times = motion.Times();
  const double mean =
      (scale(times.min) + 4 * scale(times.min / 2 + times.max / 2) + scale(times.max)) / 6;
  area_ = Real(mean * double(local_->Area()));
}

EmitterSample MovingEmitter::SamplePoint(Point2 u, Real uSubLight, Real time) const {
  return SamplePlacedPoint(*local_, motion_.At(time), u, uSubLight, time);
}

std::optional<EmitterSample> MovingEmitter::SampleToward(const SurfacePoint& ref, Point2 u,
                                                         Real uSubLight) const {
  return SamplePlacedToward(*local_, motion_.At(ref.time), ref, u, uSubLight);
}

Real MovingEmitter::PdfToward(const SurfacePoint& ref, const Vector3& wi,
                              const SurfacePoint& on) const {
  return PdfPlacedToward(*local_, motion_.At(ref.time), ref, wi, on);
}

}  // namespace exphoton
