// SPDX-License-Identifier: BSD-2-Clause
#include "tests/benchmark/rooms/room_photons.h"

#include <algorithm>

#include "core/math/sampling/sampling.h"
#include "tests/benchmark/rooms/room.h"
#include "tests/support/test_plugin.h"

namespace exphoton {
namespace {

std::vector<SurfacePlace> Hits(const PrimitiveSet& room, const Aggregate& accelerator,
                               const std::vector<Ray>& rays) {
  std::vector<SurfacePlace> places;
  for (const Ray& ray : rays) {
    const Hit hit = accelerator.Intersect(ray);
    if (!hit.IsHit()) continue;
    const SurfacePoint point = room.Point(ray, hit);
    places.push_back({point.p, FaceForward(point.ng, -ray.d)});
  }
  return places;
}

// Traces diffuse paths from a light under the ceiling. Each path leaves up to four photons.
void Shoot(const PrimitiveSet& room, const Aggregate& accelerator, std::size_t count,
           RoomPhotons* made) {
  RandomStream random(21);
  const auto u2 = [&] { return Point2{random.Uniform(), random.Uniform()}; };
  while (made->photons.size() < count) {
    Ray ray;
    ray.o = {random.Uniform() * 2 - 1, Real(3.95), random.Uniform() * 2 - 1};
    ray.d = Frame::FromZ({0, -1, 0}).ToWorld(SampleCosineHemisphere(u2()));
    for (int bounce = 0; bounce < 4 && made->photons.size() < count; ++bounce) {
      const Hit hit = accelerator.Intersect(ray);
      if (!hit.IsHit()) break;
      const SurfacePoint point = room.Point(ray, hit);
      const Normal3 n = FaceForward(point.ng, -ray.d);
      made->photons.push_back({point.p, Normalize(-ray.d), Spectrum(1)});
      made->seeds.push_back({point.p, n, Spectrum(Real(.5)), Spectrum()});
      ray = SpawnRay(point, Frame::FromZ(n).ToWorld(SampleCosineHemisphere(u2())));
    }
  }
}

// Spreads a coordinate in [-8, 8), as 10 bits, to every third bit.
std::uint32_t Spread(Real x) {
  auto bits = std::uint32_t(std::clamp((x + 8) * 64, Real(0), Real(1023)));
  bits = (bits | bits << 16) & 0x030000ff;
  bits = (bits | bits << 8) & 0x0300f00f;
  bits = (bits | bits << 4) & 0x030c30c3;
  return (bits | bits << 2) & 0x09249249;
}

}  // namespace

RoomPhotons ShootRoomPhotons(std::size_t count, std::size_t places) {
  TestPlugins plugins;
  const auto room = BenchmarkRoom(100000);
  const auto accelerator = plugins.MakeAccelerator(R"("bvh")", *room);
  RoomPhotons made;
  Shoot(*room, *accelerator, count, &made);
  const RaySets rays = MakeRaySets(*room, *accelerator, places);
  made.coherent = Hits(*room, *accelerator, rays.primary);
  made.scattered = Hits(*room, *accelerator, rays.secondBounce);
  return made;
}

std::vector<SurfacePlace> InMortonOrder(std::vector<SurfacePlace> places) {
  const auto code = [](const SurfacePlace& place) {
    return Spread(place.p.x) | Spread(place.p.y) << 1 | Spread(place.p.z) << 2;
  };
  std::sort(places.begin(), places.end(),
            [&](const SurfacePlace& a, const SurfacePlace& b) { return code(a) < code(b); });
  return places;
}

}  // namespace exphoton
