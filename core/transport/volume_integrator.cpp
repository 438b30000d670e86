// SPDX-License-Identifier: BSD-2-Clause
// MarchMedia: transmittance and radiance of the media along one ray segment.
#include "core/transport/volume_integrator.h"

namespace exphoton {

MediaSegment MarchMedia(const Ray& ray, const Point3* end, LiContext& context) {
  constexpr std::uint64_t kMediaStream = 0x6d65646961ull;
  Ray stretch = ray;
  stretch.d = NormalizeOr(ray.d, ray.d);
  stretch.tMax = end ? Distance(ray.o, *end) : kInfinity;
  MediaSegment segment{context.scene.Transmittance(stretch), {}};
  // Each segment has its own random stream, so that media do not shift any other random numbers.
  RandomStream random = context.Stream(kMediaStream + context.mediaSegments++);
  if (context.volume) segment.radiance = context.volume->Li(stretch, context, random);
  return segment;
}

}  // namespace exphoton
