// SPDX-License-Identifier: BSD-2-Clause
// Asking a surface at rest on behalf of one that moves.
#include "core/geometry/moving_emitter.h"

#include "core/geometry/placement.h"

namespace exphoton {

// A map that scales all axes by s scales areas by s^2, s running straight from end to end:
// Simpson's rule has its mean exactly. Where axes are scaled differently it is an estimate.
MovingEmitter::MovingEmitter(std::shared_ptr<const EmitterSurface> local, const Motion& motion)
    : local_(std::move(local)), motion_(motion), bounds_(motion.ApplyBounds(local_->Bounds())) {
  const auto scale = [&](Real time) {
    return std::pow(motion.At(time).VolumeScale(), 2. / 3);
  };
  const Interval times = motion.Times();
  const double mean =
      (scale(times.min) + 4 * scale(times.min / 2 + times.max / 2) + scale(times.max)) / 6;
  area_ = Real(mean * double(local_->Area()));
}

EmitterSample MovingEmitter::SamplePoint(Point2 u, Real uPart, Real time) const {
  const Transform toWorld = motion_.At(time);
  const EmitterSample local = local_->SamplePoint(u, uPart, time);
  return {PointToWorld(toWorld, local.point), local.uv,
          local.pdf / AreaScale(toWorld, local.point.ng)};
}

std::optional<EmitterSample> MovingEmitter::SampleToward(const SurfacePoint& ref, Point2 u,
                                                         Real uPart) const {
  const Transform toWorld = motion_.At(ref.time);
  const auto local = local_->SampleToward(PointToLocal(toWorld.Inverted(), ref), u, uPart);
  if (!local) return std::nullopt;
  EmitterSample sample{PointToWorld(toWorld, local->point), local->uv, 0};
  sample.point.time = ref.time;
  const Vector3 wi = NormalizeOr(sample.point.p - ref.p, Vector3());
  sample.pdf = local->pdf * SolidAngleScale(toWorld, wi);
  if (!(sample.pdf > 0) || !std::isfinite(sample.pdf)) return std::nullopt;
  return sample;
}

Real MovingEmitter::PdfToward(const SurfacePoint& ref, const Vector3& wi,
                              const SurfacePoint& on) const {
  const Transform toWorld = motion_.At(ref.time), toLocal = toWorld.Inverted();
  const Vector3 local = NormalizeOr(toLocal.ApplyVector(wi), Vector3());
  return local_->PdfToward(PointToLocal(toLocal, ref), local, PointToLocal(toLocal, on)) *
         SolidAngleScale(toWorld, wi);
}

}  // namespace exphoton
