// SPDX-License-Identifier: BSD-2-Clause
#include "tests/benchmark/rooms/room.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/math/sampling/random.h"
#include "core/math/sampling/sampling.h"

namespace exphoton {
namespace {

constexpr int kBodies = 12;
constexpr Real kWidth = 8, kHeight = 4, kDepth = 6;

void AddBox(const Point3& min, const Point3& max, TriangleMesh* mesh) {
  const auto base = std::uint32_t(mesh->p.size());
  for (int i = 0; i < 8; ++i)
    mesh->p.push_back({i & 1 ? max.x : min.x, i & 2 ? max.y : min.y, i & 4 ? max.z : min.z});
  constexpr std::uint32_t kSides[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                          {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  for (const auto& side : kSides) {
    mesh->indices.push_back({base + side[0], base + side[1], base + side[2]});
    mesh->indices.push_back({base + side[0], base + side[2], base + side[3]});
  }
}

// Body is a sphere with bumps of several sizes, made of 2 * rings * sectors triangles.
struct Body {
  Point3 center;
  Vector3 radii;
  Real phase;
  int rings, sectors;
};

void AddBody(const Body& body, TriangleMesh* mesh) {
  const auto& [center, radii, phase, rings, sectors] = body;
  const auto base = std::uint32_t(mesh->p.size());
  for (int ring = 0; ring <= rings; ++ring) {
    const Real theta = kPi * Real(ring) / Real(rings);
    for (int sector = 0; sector < sectors; ++sector) {
      const Real phi = 2 * kPi * Real(sector) / Real(sectors);
      const Vector3 d = SphericalDirection(std::sin(theta), std::cos(theta), phi);
      const Real bump = Real(.12) * std::sin(5 * d.x + phase) * std::sin(7 * d.y - phase) +
                        Real(.05) * std::sin(19 * d.z + 2 * phase) * std::cos(17 * d.x) +
                        Real(.01) * std::sin(61 * d.y) * std::sin(67 * d.z + phase);
      mesh->p.push_back(center + Vector3(d.x * radii.x, d.y * radii.y, d.z * radii.z) * (1 + bump));
    }
  }
  const auto vertex = [base, count = body.sectors](int ring, int sector) {
    return base + std::uint32_t(ring * count + sector % count);
  };
  for (int ring = 0; ring < rings; ++ring) {
    for (int sector = 0; sector < sectors; ++sector) {
      const auto a = vertex(ring, sector), b = vertex(ring, sector + 1);
      const auto c = vertex(ring + 1, sector), d = vertex(ring + 1, sector + 1);
      mesh->indices.push_back({a, c, d});
      mesh->indices.push_back({a, d, b});
    }
  }
}

// Returns rays from the hits of `rays`, cosine-distributed about the normal on the incoming side.
std::vector<Ray> Bounce(const PrimitiveSet& room, const Aggregate& accelerator,
                        const std::vector<Ray>& rays, std::uint64_t seed) {
  std::vector<Ray> bounced;
  RandomStream random(seed);
  for (const Ray& ray : rays) {
    const Point2 u{random.Uniform(), random.Uniform()};
    const Hit hit = accelerator.Intersect(ray);
    if (!hit.IsHit()) continue;
    const SurfacePoint point = room.Point(ray, hit);
    const Vector3 n = Dot(point.ng, ray.d) < 0 ? Vector3(point.ng) : -Vector3(point.ng);
    const Vector3 w = SampleCosineHemisphere(u);
    bounced.push_back(SpawnRay(point, Frame::FromZ(n).ToWorld(w)));
  }
  return bounced;
}

// Returns gather rays in the order of final gathering: many from one point, then from the next.
std::vector<Ray> Gather(const PrimitiveSet& room, const Aggregate& accelerator,
                        const std::vector<Ray>& rays) {
  constexpr std::size_t kEach = 32;
  std::vector<Ray> repeated;
  for (std::size_t i = 0; i < rays.size(); i += kEach)
    repeated.insert(repeated.end(), kEach, rays[i]);
  return Bounce(room, accelerator, repeated, 6);
}

std::vector<Ray> Shadows(const PrimitiveSet& room, const Aggregate& accelerator,
                         const std::vector<Ray>& rays) {
  std::vector<Ray> shadows;
  RandomStream random(4);
  for (const Ray& ray : rays) {
    SurfacePoint light;
    light.p = {(random.Uniform() * 2 - 1), Real(3.95), (random.Uniform() * 2 - 1)};
    const Hit hit = accelerator.Intersect(ray);
    if (hit.IsHit()) shadows.push_back(SpawnRayTo(room.Point(ray, hit), light));
  }
  return shadows;
}

std::unique_ptr<PrimitiveSet> SetOf(const std::shared_ptr<TriangleMesh>& mesh) {
  auto set = std::make_unique<PrimitiveSet>();
  set->AddMesh(mesh, {});
  set->Finish();
  return set;
}

}  // namespace

std::size_t TriangleCountOf(const std::string& size) {
  std::size_t used = 0;
  const double number = std::stod(size, &used);
  const double unit = size.substr(used) == "M" ? 1e6 : size.substr(used) == "k" ? 1e3 : 1;
  return std::size_t(number * unit);
}

std::unique_ptr<PrimitiveSet> BenchmarkRoom(std::size_t triangles) {
  auto mesh = std::make_shared<TriangleMesh>();
  AddBox({-kWidth / 2, 0, -kDepth / 2}, {kWidth / 2, kHeight, kDepth / 2}, mesh.get());
  const double each = double(triangles) / kBodies;
  const int rings = std::max(3, int(std::sqrt(each / 3.2))), sectors = std::max(3, rings * 8 / 5);
  RandomStream random(11);
  const auto between = [&](Real low, Real high) { return low + (high - low) * random.Uniform(); };
  for (int i = 0; i < kBodies; ++i) {  // in a jittered grid of 4 x 3
    const Real size = between(Real(.55), Real(.95));
    const Vector3 radii(size * between(Real(.8), Real(1.2)), size * between(Real(.8), Real(1.4)),
                        size * between(Real(.8), Real(1.2)));
    const Point3 center(Real(i % 4) * Real(1.9) - Real(2.85) + between(Real(-.2), Real(.2)),
                        radii.y * Real(1.05) + between(0, Real(.5)),
                        Real(i / 4) * Real(1.9) - Real(1.9) + between(Real(-.2), Real(.2)));
    AddBody({center, radii, between(0, 6), rings, sectors}, mesh.get());
  }
  mesh->DropDegenerate();
  return SetOf(mesh);
}

std::unique_ptr<PrimitiveSet> SmallRoom() {
  auto mesh = std::make_shared<TriangleMesh>();
  AddBox({-kWidth / 2, 0, -kDepth / 2}, {kWidth / 2, kHeight, kDepth / 2}, mesh.get());
  RandomStream random(12);
  for (int i = 0; i < 7; ++i) {
    const Point3 min(Real(i % 4) * Real(1.9) - Real(3.6), 0, Real(i / 4) * Real(2.4) - Real(1.4));
    const Vector3 size(Real(.5) + random.Uniform(), Real(.5) + 2 * random.Uniform(),
                       Real(.5) + random.Uniform());
    AddBox(min, min + size, mesh.get());
  }
  return SetOf(mesh);
}

RaySets MakeRaySets(const PrimitiveSet& room, const Aggregate& accelerator, std::size_t count) {
  RaySets sets;
  const int side = int(std::sqrt(double(count)));
  RandomStream random(1);
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      const Real u = (Real(x) + random.Uniform()) / Real(side) * 2 - 1;
      const Real v = (Real(y) + random.Uniform()) / Real(side) * 2 - 1;
      Ray ray;
      ray.o = {Real(-.3), Real(2.9), Real(-2.9)};
      ray.d = Normalize(Vector3(u * Real(.9), -v * Real(.7) - Real(.35), 1));
      sets.primary.push_back(ray);
    }
  }
  sets.firstBounce = Bounce(room, accelerator, sets.primary, 2);
  sets.secondBounce = Bounce(room, accelerator, sets.firstBounce, 3);
  sets.gather = Gather(room, accelerator, sets.primary);
  RandomStream order(5);
  for (std::size_t i = sets.secondBounce.size(); i > 1; --i)
    std::swap(sets.secondBounce[i - 1], sets.secondBounce[order.Bits() % i]);
  sets.shadow = Shadows(room, accelerator, sets.primary);
  return sets;
}

}  // namespace exphoton
