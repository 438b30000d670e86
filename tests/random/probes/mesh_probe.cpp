// SPDX-License-Identifier: BSD-2-Clause
// ProbeMeshes checks shading normals and tangents of random meshes: open subdivision surfaces, and
// triangles with normals, tangents and texture coordinates that may be mirrored. Rays from far away
// must not pass through a mesh.
#include <array>
#include <cmath>
#include <vector>

#include "tests/random/probes/probed_scene.h"

namespace exphoton::random_scenes {
namespace {

constexpr int kMeshRays = 60;

std::string PointText(const Vector3& p) {
  char text[80];
  std::snprintf(text, sizeof text, "%.9g %.9g %.9g  ", double(p.x), double(p.y), double(p.z));
  return text;
}

Vector3 Jittered(Vector3 v, Real amount, RandomStream* random) {
  for (int axis = 0; axis < 3; ++axis) v[axis] += amount * (2 * random->Uniform() - 1);
  return v;
}

// A fan of four faces round a vertex at the edge of the mesh, which is the first point.
using Fan = std::array<Vector3, 6>;

Fan RandomFan(RandomStream* random) {
  Fan fan{{{0, Real(-.2), Real(.2)},
           {1, Real(-.2), 0},
           {Real(.7), Real(.6), Real(.1)},
           {0, Real(.9), 0},
           {Real(-.7), Real(.5), Real(-.1)},
           {-1, Real(-.3), 0}}};
  for (Vector3& p : fan) p = Jittered(p, Real(.1), random);
  return fan;
}

std::string FanText(const Fan& fan, int levels) {
  std::string text = "Shape \"loopsubdiv\" \"integer nlevels\" " + std::to_string(levels) +
                     " \"integer indices\" [0 1 2 0 2 3 0 3 4 0 4 5] \"point P\" [";
  for (const Vector3& p : fan) text += PointText(p);
  return text + "]\n";
}

std::string TriangleText(RandomStream* random) {
  const auto three = [&](const Vector3& v) {
    std::string text;
    for (int i = 0; i < 3; ++i) text += PointText(Jittered(v, Real(.3), random));
    return text;
  };
  const std::string up = three({0, 0, 1}), along = three({1, 0, 0});
  const bool isMirrored = random->Bits() % 2;
  return "Shape \"trianglemesh\" \"integer indices\" [0 1 2] \"point P\" [-1 -1 0 1 -1 0 0 1 0] "
         "\"normal N\" [" +
         up + "] \"vector S\" [" + along + "] \"float uv\" " +
         (isMirrored ? "[1 0 0 0 .5 1]" : "[0 0 1 0 .5 1]") + "\n";
}

int HandOf(const Vector3& u, const Vector3& v, const Normal3& n) {
  return Dot(Cross(u, v), n) < 0 ? -1 : 1;
}

void CheckMeshSight(const SurfaceInteraction& s, Findings* findings) {
  const double cosine = double(AbsDot(s.ng, s.shading.n));
  findings->Expect(cosine > .85, "the normal of a mesh is close to the normal of its face", cosine,
                   1);
  const int hand = HandOf(s.dpdu, s.dpdv, s.ng);
  const int shadingHand = HandOf(s.shading.dpdu, s.shading.dpdv, s.shading.n);
  findings->Expect(hand == shadingHand, "shading tangents have the hand of the coordinates",
                   shadingHand, hand);
}

// Near the first vertex of a fan, the shading normal is the normal of a finer subdivision's faces.
// The limit of a vertex at an edge depends on its two neighbours there.
void CheckFan(const Fan& fan, int levels, std::uint64_t seed, Findings* findings) {
  constexpr int kFineLevels = 5;
  const Vector3 limit = (fan[1] + fan[0] * 4 + fan[5]) / 6;
  Ray ray;
  ray.o = Point3() + Vector3(limit.x, limit.y + Real(.01), 2);
  ray.d = {0, 0, -1};
  const auto sight = [&](int n) {
    return ProbedScene("WorldBegin\n" + FanText(fan, n) + "WorldEnd\n", seed, 0).Look(ray);
  };
  const auto coarse = sight(levels), fine = sight(kFineLevels);
  if (!coarse || !fine) return;
  const double cosine = double(AbsDot(coarse->surface.shading.n, fine->surface.ng));
  findings->Expect(cosine > .97, "normal of a subdivided mesh, against finer faces", cosine, 1);
}

// A mesh has the same tangents as an instance and without.
void CheckInstance(const std::string& shape, std::uint64_t seed, Findings* findings) {
  const std::string place = "Rotate 37 1 2 3 Scale 1.3 1.3 1.3\n";
  const ProbedScene plain("WorldBegin\n" + place + shape + "WorldEnd\n", seed, 0);
  const ProbedScene instance("WorldBegin\nObjectBegin \"o\"\n" + shape + "ObjectEnd\n" + place +
                                 "ObjectInstance \"o\"\nWorldEnd\n",
                             seed, 0);
  RandomStream random = plain.Stream(25);
  for (int i = 0; i < kMeshRays; ++i) {
    const Ray ray = RandomRay(&random, plain.World().Exposure());
    const auto a = plain.Look(ray), b = instance.Look(ray);
    if (!a || !b) continue;
    const auto &s = a->surface.shading, &t = b->surface.shading;
    const double off = double(Distance(s.dpdu, t.dpdu) + Distance(s.dpdv, t.dpdv));
    const double size = double(Length(s.dpdu) + Length(s.dpdv));
    findings->Expect(off < .01 * size, "shading tangents of an instance", off, size);
  }
}

constexpr int kSide = 12;  // cells along a side of the uneven plane
using PlanePoints = std::vector<Vector3>;

PlanePoints UnevenPlane(RandomStream* random) {
  PlanePoints points;
  for (int y = 0; y <= kSide; ++y)
    for (int x = 0; x <= kSide; ++x)
      points.push_back(Vector3(Real(x), Real(y), random->Uniform()) / kSide);
  return points;
}

std::string PlaneText(const PlanePoints& points) {
  std::string indices, places;
  for (const Vector3& p : points) places += PointText(p);
  for (int i = 0; i < kSide * (kSide + 1); ++i) {
    if (i % (kSide + 1) == kSide) continue;
    const auto at = [&](int n) { return " " + std::to_string(i + n); };
    indices += at(0) + at(1) + at(kSide + 2) + at(0) + at(kSide + 2) + at(kSide + 1);
  }
  return "Shape \"trianglemesh\" \"integer indices\" [" + indices + "] \"point P\" [" + places +
         "]\n";
}

// Returns rays from far away to vertices. Half of them are slanted.
std::vector<Ray> FarRays(const PlanePoints& points, RandomStream* random) {
  constexpr int kFarRays = 400;
  constexpr Real kFar = Real(1e4);
  std::vector<Ray> rays;
  for (int i = 0; i < kFarRays; ++i) {
    const Vector3& target = points[std::size_t(random->Bits() % points.size())];
    const Vector3 side{2 * random->Uniform() - 1, 2 * random->Uniform() - 1, 0};
    Ray ray;
    ray.o = Point3() + (side + Vector3(0, 0, i % 2 ? Real(.02) : 1)) * kFar;
    ray.d = target - Vector3(ray.o);
    rays.push_back(ray);
  }
  return rays;
}

// Such a ray meets the same place with each accelerator. Rounding must not let it pass.
void CheckFarRays(std::uint64_t seed, RandomStream* random, Findings* findings) {
  const PlanePoints points = UnevenPlane(random);
  const std::vector<Ray> rays = FarRays(points, random);
  const auto distances = [&](const char* accelerator) {
    const ProbedScene scene(std::string("Accelerator \"") + accelerator + "\"\nWorldBegin\n" +
                                PlaneText(points) + "WorldEnd\n",
                            seed, 0);
    std::vector<Real> t;
    for (const Ray& ray : rays) {
      const auto hit = scene.World().IntersectPoint(ray);
      t.push_back(hit ? hit->hit.t : kInfinity);
    }
    return t;
  };
  const std::vector<Real> expected = distances("bruteforce");
  for (const char* accelerator : {"kdtree", "bvh"}) {
    const std::vector<Real> found = distances(accelerator);
    int differences = 0;
    for (std::size_t i = 0; i < found.size(); ++i) differences += found[i] != expected[i];
    const std::string check = std::string("far rays to vertices with ") + accelerator;
    findings->Expect(differences == 0, check.c_str(), differences, 0);
  }
}

}  // namespace

void ProbeMeshes(std::uint64_t seed, Findings* findings) {
  RandomStream random(HashKey({seed, 18}));
  const Fan fan = RandomFan(&random);
  const int levels = 1 + int(random.Bits() % 3);
  const std::string triangle = TriangleText(&random);
  const std::string text = "WorldBegin\nTranslate 0 0 -.5\n" + FanText(fan, levels) +
                           "Translate 0 0 1\n" + triangle + "WorldEnd\n";
  const ProbedScene scene(text, seed, 0);
  for (int i = 0; i < kMeshRays; ++i) {
    Ray ray;
    ray.o = {2 * random.Uniform() - 1, 2 * random.Uniform() - 1, i % 2 ? Real(-2) : Real(2)};
    ray.d = {0, 0, i % 2 ? Real(1) : Real(-1)};
    if (const auto sight = scene.Look(ray)) CheckMeshSight(sight->surface, findings);
  }
  CheckFan(fan, levels, seed, findings);
  CheckInstance(triangle, seed, findings);
  CheckFarRays(seed, &random, findings);
}

}  // namespace exphoton::random_scenes
