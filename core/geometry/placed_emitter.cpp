// SPDX-License-Identifier: BSD-2-Clause
// The densities of a local surface are scaled by the factors of placement.h.
#include "core/geometry/placed_emitter.h"

#include "core/geometry/placement.h"

namespace exphoton {

EmitterSample SamplePlacedPoint(const EmitterSurface& local, const Transform& toWorld, Point2 u,
                                Real uSubLight, Real time) {
  const EmitterSample sample = local.SamplePoint(u, uSubLight, time);
  return {PointToWorld(toWorld, sample.point), sample.uv,
          sample.pdf / AreaScale(toWorld, sample.point.ng)};
}

std::optional<EmitterSample> SamplePlacedToward(const EmitterSurface& local,
                                                const Transform& toWorld, const SurfacePoint& ref,
                                                Point2 u, Real uSubLight) {
  const auto inside = local.SampleToward(PointToLocal(toWorld.Inverted(), ref), u, uSubLight);
  if (!inside) return std::nullopt;
  EmitterSample sample{PointToWorld(toWorld, inside->point), inside->uv, 0};
  sample.point.time = ref.time;
  const Vector3 wi = NormalizeOr(sample.point.p - ref.p, Vector3());
  sample.pdf = inside->pdf * SolidAngleScale(toWorld, wi);
  if (!(sample.pdf > 0) || !std::isfinite(sample.pdf)) return std::nullopt;
  return sample;
}

Real PdfPlacedToward(const EmitterSurface& local, const Transform& toWorld, const SurfacePoint& ref,
                     const Vector3& wi, const SurfacePoint& on) {
  const Transform toLocal = toWorld.Inverted();
  const Vector3 inside = NormalizeOr(toLocal.ApplyVector(wi), Vector3());
  return local.PdfToward(PointToLocal(toLocal, ref), inside, PointToLocal(toLocal, on)) *
         SolidAngleScale(toWorld, wi);
}

Real PlacedArea(const EmitterSurface& local, const Transform& toWorld) {
  constexpr int kSide = 64;
  double sum = 0;
  for (int i = 0; i < kSide * kSide; ++i) {
    const Point2 u((Real(i % kSide) + Real(.5)) / kSide, (Real(i / kSide) + Real(.5)) / kSide);
    const Real part = (Real(i) + Real(.5)) / (kSide * kSide);  // of a mesh: all of its triangles
    const EmitterSample sample = local.SamplePoint(u, part, 0);
    sum += double(AreaScale(toWorld, sample.point.ng)) / double(sample.pdf);
  }
  return Real(sum / (kSide * kSide));
}

}  // namespace exphoton
