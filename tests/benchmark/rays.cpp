// SPDX-License-Identifier: BSD-2-Clause
// rays measures the same rays through every accelerator and through Embree (3.13, single rays, with
// and without its robust flag), with one thread. All must agree on the hits before they are timed.
#include <cmath>
#include <map>
#include <stdexcept>

#include "tests/benchmark/contest.h"
#include "tests/benchmark/parts.h"
#include "tests/benchmark/rooms/embree_room.h"
#include "tests/benchmark/rooms/room.h"
#include "tests/support/test_plugin.h"

namespace exphoton {
namespace {

constexpr std::size_t kRays = 200000;
constexpr int kRounds = 21;

// Arrangement is a room with the accelerators and rays to measure. It is made once.
struct Arrangement {
  explicit Arrangement(const std::string& size)
      : room(size == "small" ? SmallRoom() : BenchmarkRoom(TriangleCountOf(size))),
        robust(*room, true),
        fast(*room, false),
        bvh(plugins.MakeAccelerator(R"("bvh")", *room)),
        avx2(plugins.MakeAccelerator(R"("bvh" "string vectors" "avx2")", *room)),
        portable(plugins.MakeAccelerator(R"("bvh" "string vectors" "portable")", *room)),
        kdtree(plugins.MakeAccelerator(R"("kdtree")", *room)),
        rays(MakeRaySets(*room, *bvh, kRays)) {}

  TestPlugins plugins;
  std::unique_ptr<PrimitiveSet> room;
  EmbreeRoom robust, fast;
  std::unique_ptr<Aggregate> bvh, avx2, portable, kdtree;
  RaySets rays;
};

const Arrangement& ArrangementOf(const std::string& size) {
  static std::map<std::string, std::unique_ptr<Arrangement>> made;
  auto& arrangement = made[size];
  if (!arrangement) arrangement = std::make_unique<Arrangement>(size);
  return *arrangement;
}

// Keeps the compiler from optimising the work away.
void Consume(double value) {
  [[maybe_unused]] static volatile double sink;
  sink = value;
}

template <class Accelerator>
Contestant Closest(const char* name, const Accelerator& accelerator, const std::vector<Ray>& rays) {
  return {name, [&accelerator, &rays] {
            double sum = 0;
            for (const Ray& ray : rays) sum += double(accelerator.Intersect(ray).t);
            Consume(sum);
          }};
}

template <class Accelerator>
Contestant Any(const char* name, const Accelerator& accelerator, const std::vector<Ray>& rays) {
  return {name, [&accelerator, &rays] {
            int sum = 0;
            for (const Ray& ray : rays) sum += accelerator.Occluded(ray);
            Consume(sum);
          }};
}

// Throws if the accelerators differ in any hit. Throws if Embree's distances differ by more than
// rounding for more than one ray in 1000; fewer rays than this touch an edge.
void CheckHits(const Arrangement& a, const std::vector<Ray>& rays) {
  std::size_t differing = 0, ours = 0;
  for (const Ray& ray : rays) {
    const Hit hit = a.bvh->Intersect(ray), other = a.robust.Intersect(ray);
    for (const Aggregate* tested : {a.avx2.get(), a.portable.get(), a.kdtree.get()}) {
      const Hit same = tested->Intersect(ray);
      ours += same.t != hit.t || same.primitive != hit.primitive;
    }
    if (!hit.IsHit() && !other.IsHit()) continue;
    differing += !(std::abs(hit.t - other.t) <= Real(1e-3) * (Real(.01) + hit.t));
  }
  if (ours > 0) throw std::runtime_error("the accelerators disagree");
  if (differing > rays.size() / 1000)
    throw std::runtime_error("Embree finds other hits: " + std::to_string(differing));
}

template <class Make>
Contest Race(const Arrangement& a, const std::vector<Ray>& rays, Make&& make) {
  CheckHits(a, rays);
  Contest contest{double(rays.size()) * 1e-6, "Mrays", {}, Clock::Thread};
  contest.contestants.push_back(make("bvh", *a.bvh));
  contest.contestants.push_back(make("bvh-avx2", *a.avx2));
  contest.contestants.push_back(make("bvh-portable", *a.portable));
  contest.contestants.push_back(make("kdtree", *a.kdtree));
  contest.contestants.push_back(make("embree-robust", a.robust));
  contest.contestants.push_back(make("embree", a.fast));
  return contest;
}

void AddSet(const std::string& size, const char* name, std::vector<Ray> RaySets::*set,
            bool isClosest) {
  AddContest("rays/" + size + "/" + name, kRounds, [size, set, isClosest] {
    const Arrangement& a = ArrangementOf(size);
    const std::vector<Ray>& rays = a.rays.*set;
    return Race(a, rays, [&](const char* contestant, const auto& accelerator) {
      return isClosest ? Closest(contestant, accelerator, rays)
                       : Any(contestant, accelerator, rays);
    });
  });
}

}  // namespace

void AddRays() {
  AddSet("small", "gather", &RaySets::gather, true);
  AddSet("small", "shadow", &RaySets::shadow, false);
  for (const char* size : {"266k", "1M"}) {
    AddSet(size, "primary", &RaySets::primary, true);
    AddSet(size, "bounce-1", &RaySets::firstBounce, true);
    AddSet(size, "bounce-2", &RaySets::secondBounce, true);
    AddSet(size, "shadow", &RaySets::shadow, false);
    AddSet(size, "any-hit", &RaySets::secondBounce, false);
  }
}

}  // namespace exphoton
