// SPDX-License-Identifier: BSD-2-Clause
// What media do to one stretch of a path.
#include "core/transport/volume_integrator.h"

namespace exphoton {

MediaSegment MarchMedia(const Ray& ray, const Point3* end, LiContext& context) {
  constexpr std::uint64_t kMediaStream = 0x6d65646961ull;
  Ray stretch = ray;
  stretch.d = NormalizeOr(ray.d, ray.d);
  stretch.tMax = end ? Distance(ray.o, *end) : kInfinity;
  MediaSegment segment{context.scene.Transmittance(stretch), {}};
  // Each stretch of a path has its own numbers, so that they move nothing else.
  RandomStream random = context.Stream(kMediaStream + context.mediaSegments++);
  if (context.volume) segment.radiance = context.volume->Li(stretch, context, random);
  return segment;
}

}  // namespace exphoton
