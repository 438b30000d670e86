// SPDX-License-Identifier: BSD-2-Clause
// EmitterSurface's default strategy samples points uniformly by area and converts the density to
// solid angle, dA = d^2 / |cos| dw. It computes in double, because squared distances leave the
// range of float.
#include "core/geometry/shape.h"

#include "core/geometry/vec3d.h"

namespace exphoton {
namespace {

// Returns the density per solid angle at ref of a point with density areaPdf. Returns 0 for an
// edge-on surface or a point at ref itself.
Real SolidAnglePdf(const SurfacePoint& ref, const SurfacePoint& on, Real areaPdf) {
  const Vec3d between = Vec3d(on.p) - Vec3d(ref.p);
  const double distance2 = Dot(between, between);
  const double cosTimesDistance = std::abs(Dot(Vec3d(on.ng), between));
  if (!(cosTimesDistance > 0) || !(distance2 > 0)) return 0;
  const double pdf = double(areaPdf) * distance2 * std::sqrt(distance2) / cosTimesDistance;
  return pdf <= double(std::numeric_limits<Real>::max()) ? Real(pdf) : 0;
}

}  // namespace

std::optional<EmitterSample> EmitterSurface::SampleToward(const SurfacePoint& ref, Point2 u,
                                                          Real uSubLight) const {
  EmitterSample sample = SamplePoint(u, uSubLight, ref.time);
  sample.point.time = ref.time;
  sample.pdf = SolidAnglePdf(ref, sample.point, sample.pdf);
  if (!(sample.pdf > 0)) return std::nullopt;
  return sample;
}

Real EmitterSurface::PdfToward(const SurfacePoint& ref, const Vector3& wi,
                               const SurfacePoint& on) const {
  (void)wi;
  const Real area = Area();
  return area > 0 ? SolidAnglePdf(ref, on, 1 / area) : 0;
}

}  // namespace exphoton
