// SPDX-License-Identifier: BSD-2-Clause
// builds measures the construction of accelerators and photon trees with one thread, and of
// accelerators also with two.
#include "core/spatial/point_tree.h"
#include "tests/benchmark/contest.h"
#include "tests/benchmark/parts.h"
#include "tests/benchmark/rooms/embree_room.h"
#include "tests/benchmark/rooms/nanoflann_map.h"
#include "tests/benchmark/rooms/room.h"
#include "tests/benchmark/rooms/room_photons.h"
#include "tests/support/test_plugin.h"

namespace exphoton {
namespace {

constexpr int kRounds = 7;

Contest Accelerators(const std::string& size) {
  auto plugins = std::make_shared<TestPlugins>();
  const std::size_t count = TriangleCountOf(size);
  const std::shared_ptr<PrimitiveSet> room = BenchmarkRoom(count);
  auto embree = std::make_shared<EmbreeRoom>(*room, true);
  return {double(room->TriangleCount()) * 1e-6,
          "Mtriangles",
          {{"bvh", [=] { plugins->MakeAccelerator(R"("bvh")", *room); }},
           {"bvh-2-threads", [=] { plugins->MakeAccelerator(R"("bvh")", *room, 2); }},
           {"kdtree", [=] { plugins->MakeAccelerator(R"("kdtree")", *room); }},
           {"embree-robust", [=] { embree->Build(); }}},
          Clock::Wall};
}

Contest PhotonTrees(const std::string& size) {
  auto points = std::make_shared<std::vector<Point3>>();
  auto threads = std::make_shared<ThreadPool>(1);
  for (const Photon& photon : ShootRoomPhotons(TriangleCountOf(size), 1).photons)
    points->push_back(photon.p);
  return {double(points->size()) * 1e-6,
          "Mphotons",
          {{"exphoton",
            [=] {
              BlockStore<PointBlock> store;
              store.Reserve(points->size());
              for (const Point3& p : *points) {
                const OrientedPoint point{p, 0};
                store.Append({&point, 1});
              }
              PointTree<PointBlock> tree(std::move(store), *threads);
            }},
           {"nanoflann", [=] { NanoflannMap tree(*points); }}},
          Clock::Wall};
}

}  // namespace

void AddBuilds() {
  for (const std::string size : {"266k", "1M"})
    AddContest("builds/" + size + "-triangles", kRounds, [size] { return Accelerators(size); });
  for (const std::string size : {"100k", "1M"})
    AddContest("builds/" + size + "-photons", kRounds, [size] { return PhotonTrees(size); });
}

}  // namespace exphoton
