// SPDX-License-Identifier: BSD-2-Clause
// MovingEmitter passes each query to the surface at rest, with the map at the query's time.
#include "core/geometry/moving_emitter.h"

#include "core/geometry/placed_emitter.h"

namespace exphoton {

namespace {

// A map that scales all axes by s scales areas by s^2.
double AreaAt(const EmitterSurface& local, const Transform& map) {
  if (map.SimilarityScale()) return std::pow(map.VolumeScale(), 2. / 3) * double(local.Area());
  return double(PlacedArea(local, map));
}

}  // namespace

// The mean over time is by Simpson's rule. It is exact if all axes are scaled by the same number,
// which is linear in time, or if only the place changes.
MovingEmitter::MovingEmitter(std::shared_ptr<const EmitterSurface> local, const Motion& motion)
    : local_(std::move(local)), motion_(motion), bounds_(motion.ApplyBounds(local_->Bounds())) {
  const auto area = [&](Real time) { return AreaAt(*local_, motion.At(time)); };
  const Interval times = motion.Times();
  area_ = Real((area(times.min) + 4 * area(times.min / 2 + times.max / 2) + area(times.max)) / 6);
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
