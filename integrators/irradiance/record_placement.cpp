// SPDX-License-Identifier: BSD-2-Clause
// PlaceRecords: rounds of pixels. All points of a round are tested against the records of earlier
// rounds in parallel. Points that fail become records in small groups, and each group is tested
// again against the records of the groups before it.
#include "integrators/irradiance/record_placement.h"

#include <algorithm>
#include <span>

#include "core/base/parallel.h"
#include "core/base/progress.h"
#include "core/imaging/film/camera.h"
#include "core/transport/specular/specular_bounce.h"
#include "integrators/photon/maps/rest_pose.h"

namespace exphoton {
namespace {

constexpr std::uint64_t kRayStream = 0x69637261, kSpecularStream = 0x69637370;
constexpr std::int64_t kSmallestRound = 64, kLargestRound = 8192;  // pixels
constexpr std::size_t kGroup = 16;                                 // records computed together

// A visible point at which irradiance is needed.
struct CachePoint {
  SurfacePoint surface;
  Normal3 n;
  const Motion* motion = nullptr;
  Real footprint = 0;  // side of a pixel's area on the surface; 0: unknown

  Point3 RestPoint() const { return RestPose(motion, surface.time).Point(surface.p); }
  Normal3 RestNormal() const { return RestPose(motion, surface.time).Normal(n); }
};

// Returns the pixel that the index has in an order from coarse to fine over a square of
// 2^levels x 2^levels: the bits of x and y are taken in turn, highest first.
Point2i PixelOfOrder(std::uint64_t index, int levels) {
  Point2i pixel{0, 0};
  for (int b = 0; b < levels; ++b) {
    const int digit = int((index >> (2 * b)) & 3);
    pixel.x |= (digit & 1) << (levels - 1 - b);
    pixel.y |= ((digit >> 1) ^ (digit & 1)) << (levels - 1 - b);
  }
  return pixel;
}

class Placement {
 public:
  Placement(const Scene& scene, const IrradianceSettings& settings,
            const IndirectRadiance& incident, PreprocessContext& context)
      : scene_(scene),
        settings_(settings),
        incident_(incident),
        context_(context),
        workers_(std::size_t(context.threads.Count())),
        cache_(Radians(settings.maxAngleDifference), BoundingSphere(scene.WorldBounds()).radius) {}

  IrradianceCache Run() {
    if (!context_.camera || context_.resolution.x < 1 || context_.resolution.y < 1)
      return std::move(cache_);
    int levels = 0;
    while ((1 << levels) < std::max(context_.resolution.x, context_.resolution.y)) ++levels;
    const std::int64_t end = std::int64_t(1) << (2 * levels);
    context_.progress.Begin("Placing irradiance records", end);
    for (std::int64_t first = 0; first < end;) {
      const std::int64_t count =
          std::min(std::clamp(first / 4, kSmallestRound, kLargestRound), end - first);
      AddRound(first, count, levels);
      first += count;
      context_.progress.SetDone(first);
    }
    context_.progress.End();
    for (const Worker& worker : workers_) context_.statistics.AddRays(worker.rays);
    return std::move(cache_);
  }

 private:
  struct Worker {
    Arena arena;
    RayCounters rays;
  };

  template <class Work>  // void(LiContext&)
  void WithContext(std::uint64_t key, int worker, const Work& work) {
    Worker& mine = workers_[std::size_t(worker)];
    mine.arena.Reset();
    const CameraSamples samples{SampleLayout()};
    LiContext li{scene_, samples, mine.arena, mine.rays, key};
    li.volume = context_.volume;
    work(li);
  }

  bool IsCovered(const CachePoint& point) const {
    const auto found = cache_.Find(point.RestPoint(), point.RestNormal());
    return found.weight > 0 && found.weight >= settings_.minWeight;
  }

  void AddRound(std::int64_t first, std::int64_t count, int levels) {
    context_.CheckStop();
    std::vector<std::vector<CachePoint>> found(static_cast<std::size_t>(count));
    context_.threads.For(count, [&](std::int64_t i, int worker) {
      const Point2i pixel = PixelOfOrder(std::uint64_t(first + i), levels);
      if (pixel.x >= context_.resolution.x || pixel.y >= context_.resolution.y) return;
      const std::uint64_t key = HashKey({context_.seed, kSpecularStream, std::uint64_t(first + i)});
      std::vector<CachePoint>& points = found[std::size_t(i)];
      WithContext(key, worker, [&](LiContext& li) { FindPoints(pixel, li, &points); });
      std::erase_if(points, [&](const CachePoint& point) { return IsCovered(point); });
    });
    std::vector<CachePoint> open;
    for (const auto& points : found) open.insert(open.end(), points.begin(), points.end());
    for (std::size_t next = 0; next < open.size();) {
      std::vector<CachePoint> group;
      for (; next < open.size() && group.size() < kGroup; ++next)
        if (!IsCovered(open[next])) group.push_back(open[next]);
      AddRecords(group);
    }
  }

  void AddRecords(std::span<const CachePoint> group) {
    context_.CheckStop();
    std::vector<IrradianceRecord> records(group.size());
    const std::uint64_t firstNumber = cache_.Size();
    context_.threads.For(std::int64_t(group.size()), [&](std::int64_t i, int worker) {
      const std::uint64_t number = firstNumber + std::uint64_t(i);
      const std::uint64_t key = HashKey({context_.seed, kRayStream, number});
      WithContext(key, worker, [&](LiContext& li) {
        records[std::size_t(i)] = MakeRecord(group[std::size_t(i)], li);
      });
    });
    for (const IrradianceRecord& record : records) cache_.Insert(record);
  }

  IrradianceRecord MakeRecord(const CachePoint& point, LiContext& li) const {
    const IrradianceEstimate estimate = EstimateIrradiance({point.surface, point.n, settings_.rays},
                                                           incident_, li.Stream(kRayStream), li);
    IrradianceRecord record;
    record.p = point.RestPoint();
    record.n = point.RestNormal();
    record.irradiance = estimate.irradiance;
    record.rotation = estimate.rotation;
    record.translation = estimate.translation;
    const RestPose rest(point.motion, point.surface.time);
    for (std::size_t c = 0; c < 3; ++c) {
      if (!rest.IsMoved()) break;
      record.rotation[c] = Length(record.rotation[c]) * rest.Direction(record.rotation[c]);
      record.translation[c] = Length(record.translation[c]) * rest.Direction(record.translation[c]);
    }
    SetRadius(point, estimate.meanDistance, &record);
    return record;
  }

  // The radius is the distance to the surroundings times maxerror, within bounds in pixels. Where
  // irradiance would double or vanish within this distance, the gradient bounds it instead.
  void SetRadius(const CachePoint& point, Real meanDistance, IrradianceRecord* record) const {
    Real wanted = meanDistance;
    for (std::size_t c = 0; c < 3; ++c) {
      const Real slope = Length(record->translation[c]);
      wanted = std::min(wanted, SafeDivide(record->irradiance[int(c)], slope, kInfinity));
    }
    wanted *= settings_.maxError;
    const Real world = BoundingSphere(scene_.WorldBounds()).radius;
    Real radius = std::min(wanted, std::max(world, std::numeric_limits<Real>::min()));
    if (point.footprint > 0) {
      const Real least = settings_.minPixelSpacing * point.footprint;
      radius = std::max(std::min(radius, settings_.maxPixelSpacing * point.footprint), least);
    }
    record->radius = radius;
    // A gradient that was found over a smaller distance does not hold over a larger one.
    if (wanted < radius)
      for (Vector3& gradient : record->translation) gradient *= wanted / radius;
  }

  // Follows a camera ray through the pixel, with one random specular lobe at each point. Rays
  // through the centres of pixels would meet the edges of a room exactly if its camera is on its
  // axis. A point on an edge lies in the plane of the other wall, so its rays do not meet this
  // wall.
  void FindPoints(Point2i pixel, LiContext& li, std::vector<CachePoint>* points) const {
    RandomStream random = li.Stream(kSpecularStream);
    CameraSample sample;
    sample.film.x = Real(pixel.x) + random.Uniform();
    sample.film.y = Real(pixel.y) + random.Uniform();
    sample.lens = {Real(.5), Real(.5)};
    if (scene_.Features().Needs(Feature::Motion)) sample.time = Real(.5);
    RayDifferential ray = context_.camera->GenerateRay(sample, true);
    for (int depth = 0;; ++depth) {
      const auto hit = li.Intersect(ray, depth == 0 ? RayKind::Camera : RayKind::Specular);
      if (!hit || !hit->material) return;
      const ShadingPoint point =
          MakeShadingPoint(*hit, ray, depth, TransportMode::Radiance, &li.arena);
      const IrradianceSides sides(point);
      SurfaceInteraction surface = *hit;
      surface.ComputeDifferentials(ray);
      const Real area = surface.hasDifferentials ? Length(Cross(surface.dpdx, surface.dpdy)) : 0;
      const Real footprint = std::isfinite(area) ? std::sqrt(area) : 0;
      for (const auto& n : {sides.reflection, sides.transmission})
        if (n) points->push_back({*hit, *n, hit->motion, footprint});
      if (depth == settings_.maxSpecularDepth || !point.bsdf.Has(LobeSet::Specular)) return;
      const Point2 u{random.Uniform(), random.Uniform()};
      const auto bounce = SampleSpecularRay(point, LobeSet::Specular, u, random.Uniform());
      if (!bounce) return;
      ray = bounce->ray;
    }
  }

  const Scene& scene_;
  const IrradianceSettings& settings_;
  const IndirectRadiance& incident_;
  PreprocessContext& context_;
  std::vector<Worker> workers_;
  IrradianceCache cache_;
};

}  // namespace

IrradianceSides::IrradianceSides(const ShadingPoint& point) {
  const Normal3 n = Dot(point.bsdf.Ng(), point.Wo()) < 0 ? -point.bsdf.Ns() : point.bsdf.Ns();
  if (point.bsdf.Has(LobeSet::DiffuseReflection)) reflection = n;
  if (point.bsdf.Has(LobeSet::DiffuseTransmission)) transmission = -n;
}

IrradianceCache PlaceRecords(const Scene& scene, const IrradianceSettings& settings,
                             const IndirectRadiance& incident, PreprocessContext& context) {
  return Placement(scene, settings, incident, context).Run();
}

}  // namespace exphoton
