// SPDX-License-Identifier: BSD-2-Clause
// lookups measures searches for the k nearest photons and the nearest radiance photon, in the
// photon maps and in nanoflann, with one thread. Both must find the same neighbours before they are
// timed.
#include <cmath>
#include <map>
#include <stdexcept>

#include "core/base/log.h"
#include "core/base/parallel.h"
#include "core/base/progress.h"
#include "core/base/statistics.h"
#include "tests/benchmark/contest.h"
#include "tests/benchmark/parts.h"
#include "tests/benchmark/rooms/nanoflann_map.h"
#include "tests/benchmark/rooms/room.h"
#include "tests/benchmark/rooms/room_photons.h"

namespace exphoton {
namespace {

constexpr int kNearest = 50, kRounds = 15;
constexpr std::size_t kPlaces = 40000;

struct PhotonArrangement {
  explicit PhotonArrangement(const std::string& size)
      : made(ShootRoomPhotons(TriangleCountOf(size), kPlaces)),
        map(PhotonBuffer(made.photons, 1), threads),
        directions(Directions()),
        opponent(Positions()),
        seedOpponent(SeedPositions()) {
    Arena arena;
    std::vector<Real> radii;
    for (std::size_t i = 0; i < made.scattered.size(); i += 16) {
      const NearPoints near = map.Nearest(made.scattered[i].p, kNearest, &arena);
      radii.push_back(std::sqrt(near.distance2[near.farthest]));
      arena.Reset();
    }
    std::nth_element(radii.begin(), radii.begin() + std::ptrdiff_t(radii.size() / 2), radii.end());
    tight = radii[radii.size() / 2];
  }
  // The positions come from the map, because the map may round positions and directions.
  std::vector<Point3> Positions() const {
    std::vector<Point3> points;
    for (std::uint32_t i = 0; i < map.Size(); ++i) points.push_back(map.Position(i));
    return points;
  }
  std::vector<Vector3> Directions() const {
    std::vector<Vector3> directions;
    for (std::uint32_t i = 0; i < map.Size(); ++i) directions.push_back(map.Direction(i));
    return directions;
  }

  std::vector<Point3> SeedPositions() const {
    std::vector<Point3> points;
    for (const RadiancePhotonSite& seed : made.seeds) points.push_back(seed.p);
    return points;
  }

  ThreadPool threads{1};
  RoomPhotons made;
  PhotonMap map;
  std::vector<Vector3> directions;
  NanoflannMap opponent, seedOpponent;
  Real tight;  // radius that holds k photons at half of the places
};

const PhotonArrangement& ArrangementOf(const std::string& size) {
  static std::map<std::string, std::unique_ptr<PhotonArrangement>> made;
  auto& arrangement = made[size];
  if (!arrangement) arrangement = std::make_unique<PhotonArrangement>(size);
  return *arrangement;
}

struct Found {
  std::size_t count;
  Real radius2;
};

// Searches like PhotonMap::Find: it finds photons from the front, in a region flattened along the
// normal. If k photons are found, the farthest of them gives the radius.
Found FindWithNanoflann(const PhotonArrangement& a, const SurfacePlace& place, Real radius) {
  NanoflannMap::Near buffer[kNearest];
  const auto near = a.opponent.Nearest(
      place.p, kNearest, radius * radius, buffer, [&](std::uint32_t i, float distance2) {
        const Real height = Dot(a.opponent.At(i) - place.p, place.n);
        const Real flat2 = Square(height * (1 / PhotonMap::kFlatness));
        if (!(Dot(a.directions[i], place.n) > 0)) return kInfinity;
        return std::max(distance2, flat2);
      });
  if (near.size() < kNearest) return {near.size(), radius * radius};
  return {near.size() - 1, near[0].distance2};
}

Found FindWithMap(const PhotonArrangement& a, const SurfacePlace& place, Real radius,
                  Arena* arena) {
  const auto around = a.map.Find({place.p, place.n, kNearest, radius, true}, arena);
  arena->Reset();
  return {around.photons.size(), around.radius2};
}

Contest KNearest(const std::string& size, Real radii, bool isInOrder) {
  const PhotonArrangement& a = ArrangementOf(size);
  const Real radius = radii * a.tight;
  auto places = std::make_shared<std::vector<SurfacePlace>>(
      isInOrder ? InMortonOrder(a.made.scattered) : a.made.scattered);
  auto arena = std::make_shared<Arena>();
  for (const SurfacePlace& place : *places) {
    const Found own = FindWithMap(a, place, radius, arena.get());
    const Found other = FindWithNanoflann(a, place, radius);
    if (own.count != other.count || std::abs(own.radius2 / other.radius2 - 1) > Real(1e-4))
      throw std::runtime_error("other neighbours than nanoflann's");
  }
  const auto work = [&a, places, radius](auto&& find) {
    double sum = 0;
    for (const SurfacePlace& place : *places) sum += double(find(a, place, radius).radius2);
    if (sum < 0) throw std::logic_error("negative radii");  // prevents dead-code elimination
  };
  return {double(places->size()) * 1e-3,
          "k",
          {{"exphoton",
            [=] {
              work([&](const auto& m, const auto& place, Real r) {
                return FindWithMap(m, place, r, arena.get());
              });
            }},
           {"nanoflann", [=] { work(FindWithNanoflann); }}},
          Clock::Thread};
}

// RadianceArrangement is a radiance photon map with the same number of entries. An entry whose
// normal has a positive cosine with the query's normal is valid at any distance.
struct RadianceArrangement {
  explicit RadianceArrangement(const PhotonArrangement& photons) : made(photons.made) {
    ThreadPool threads(1);
    Log log(Log::Level::Normal, Log::Sink::Memory);
    ProgressReporter progress(ProgressReporter::Mode::Quiet);
    Statistics statistics;
    PreprocessContext context{threads, 0, log, progress, statistics, false, nullptr, Point2i()};
    PhotonSettings settings;
    settings.kernel = DensityKernel::Simpson;
    settings.radianceReach = 1000;
    settings.radianceNormal = 0;
    settings.nUsed = 2;  // only the positions of entries matter here
    settings.maxDist = Real(10);
    PhotonPassResult result;
    result[PhotonKind::Direct] = PhotonBuffer(std::span(made.photons).first(1000), 1);
    const PhotonMapSet maps(&result, settings, 10, context);
    std::vector<RadiancePhotonSite> seeds = made.seeds;
    map = RadiancePhotonMap(seeds, maps, settings, false, context);
  }
  const RoomPhotons& made;
  RadiancePhotonMap map;
};

const RadianceArrangement& RadianceOf(const std::string& size) {
  static std::map<std::string, std::unique_ptr<RadianceArrangement>> made;
  auto& arrangement = made[size];
  if (!arrangement) arrangement = std::make_unique<RadianceArrangement>(ArrangementOf(size));
  return *arrangement;
}

Real NearestWithMap(const RadianceArrangement& radiance, const SurfacePlace& place) {
  const auto entry = radiance.map.Find({place.p, place.n});
  return entry ? std::sqrt(entry->distance2) : kInfinity;
}

Real NearestWithNanoflann(const PhotonArrangement& a, const SurfacePlace& place) {
  NanoflannMap::Near buffer[1];
  const auto near =
      a.seedOpponent.Nearest(place.p, 1, 1e30f, buffer, [&](std::uint32_t i, float distance2) {
        return Dot(a.made.seeds[i].n, place.n) > 0 ? distance2 : kInfinity;
      });
  return near.empty() ? kInfinity : std::sqrt(near[0].distance2);
}

Contest OneNearest(const std::string& size, std::vector<SurfacePlace> RoomPhotons::*set) {
  const PhotonArrangement& a = ArrangementOf(size);
  const RadianceArrangement& radiance = RadianceOf(size);
  const std::vector<SurfacePlace>& places = a.made.*set;
  for (const SurfacePlace& place : places) {
    const Real own = NearestWithMap(radiance, place), other = NearestWithNanoflann(a, place);
    if (!(std::abs(own - other) <= Real(1e-4) * other))
      throw std::runtime_error("another nearest entry than nanoflann's");
  }
  const auto work = [&places](auto&& find) {
    double sum = 0;
    for (const SurfacePlace& place : places) sum += double(find(place));
    if (sum < 0) throw std::logic_error("negative distances");
  };
  return {double(places.size()) * 1e-3,
          "k",
          {{"exphoton",
            [=, &radiance] {
              work([&](const auto& place) { return NearestWithMap(radiance, place); });
            }},
           {"nanoflann",
            [=, &a] { work([&](const auto& place) { return NearestWithNanoflann(a, place); }); }}},
          Clock::Thread};
}

}  // namespace

void AddLookups() {
  for (const std::string size : {"100k", "1M"}) {
    const std::string part = "lookups/" + size;
    AddContest(part + "/50-tight", kRounds, [size] { return KNearest(size, 1, false); });
    AddContest(part + "/50-wide", kRounds, [size] { return KNearest(size, 3, false); });
    AddContest(part + "/50-wide-morton", kRounds, [size] { return KNearest(size, 3, true); });
    AddContest(part + "/1-scattered", kRounds,
               [size] { return OneNearest(size, &RoomPhotons::scattered); });
    AddContest(part + "/1-coherent", kRounds,
               [size] { return OneNearest(size, &RoomPhotons::coherent); });
  }
}

}  // namespace exphoton
