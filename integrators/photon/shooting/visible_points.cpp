// SPDX-License-Identifier: BSD-2-Clause
// VisiblePoints traces camera rays and one further bounce, to points where photons can be stored.
#include "integrators/photon/shooting/visible_points.h"

#include <optional>

#include "core/math/sampling/low_discrepancy.h"
#include "core/transport/shading_point.h"

namespace exphoton {
namespace {

constexpr int kMaxSpecularBounces = 16;
constexpr std::uint64_t kFilmKey = 0x7365656e31ull, kLensKey = 0x7365656e32ull,
                        kStreamKey = 0x7365656e33ull, kTimeKey = 0x7365656e34ull;

class VisiblePointTracer {
 public:
  VisiblePointTracer(const Scene& scene, Arena* arena, std::uint64_t key)
      : scene_(scene), arena_(arena), random_(key) {}

  // Returns the first hit with a non-specular lobe, following specular bounces.
  std::optional<ShadingPoint> Follow(RayDifferential ray) {
    for (int bounces = 0; bounces <= kMaxSpecularBounces; ++bounces) {
      const auto surface = scene_.Intersect(ray);
      if (!surface) return std::nullopt;
      const ShadingPoint point =
          MakeShadingPoint(*surface, ray, bounces, TransportMode::Radiance, arena_);
      if (point.bsdf.Has(LobeSet::NonSpecular)) return point;
      const auto next = Scattered(point, LobeSet::Specular);
      if (!next) return std::nullopt;
      ray = *next;
    }
    return std::nullopt;
  }

  std::optional<Ray> Scattered(const ShadingPoint& point, LobeSet lobes) {
    const Real x = random_.Uniform(), y = random_.Uniform();
    const auto sample = point.bsdf.Sample(point.Wo(), {x, y}, random_.Uniform(), lobes);
    if (!sample) return std::nullopt;
    return SpawnRay(point.surface, sample->wi);
  }

 private:
  const Scene& scene_;
  Arena* arena_;
  RandomStream random_;
};

VisiblePoint PointOf(const ShadingPoint& point) {
  return {point.surface.p, FaceForward(point.bsdf.Ng(), point.Wo())};
}

CameraSample SampleOf(std::uint32_t i, Point2i size, std::uint64_t seed, bool isMoving) {
  const Point2 film = ScrambledSobol2(i, HashKey({seed, kFilmKey}));
  CameraSample sample;
  sample.film = {film.x * Real(size.x), film.y * Real(size.y)};
  sample.lens = ScrambledSobol2(i, HashKey({seed, kLensKey}));
  if (isMoving) sample.time = ScrambledVanDerCorput(i, std::uint32_t(HashKey({seed, kTimeKey})));
  return sample;
}

}  // namespace

std::vector<VisiblePoint> VisiblePoints(const Scene& scene, const Camera& camera, Point2i size,
                                        std::uint64_t seed, std::uint32_t rays) {
  const bool isMoving = scene.Features().Needs(Feature::Motion);
  std::vector<VisiblePoint> points;
  Arena arena;
  for (std::uint32_t i = 0; i < rays; ++i) {
    arena.Reset();
    VisiblePointTracer tracer(scene, &arena, HashKey({seed, kStreamKey, i}));
    const auto seen = tracer.Follow(camera.GenerateRay(SampleOf(i, size, seed, isMoving), false));
    if (!seen) continue;
    points.push_back(PointOf(*seen));
    const auto onward = tracer.Scattered(*seen, LobeSet::NonSpecular);
    if (!onward) continue;
    if (const auto gathered = tracer.Follow(*onward)) points.push_back(PointOf(*gathered));
  }
  return points;
}

}  // namespace exphoton
