// SPDX-License-Identifier: BSD-2-Clause
// ProbeMeshes checks shading normals and tangents of random meshes: open subdivision surfaces, and
// triangles with normals, tangents and texture coordinates that may be mirrored.
#include <cmath>

#include "tests/random/probes/probed_scene.h"

namespace exphoton::random_scenes {
namespace {

constexpr int kMeshRays = 60;

std::string Jittered(const Vector3& v, double amount, RandomStream* random) {
  char text[80];
  const auto next = [&](Real x) {
    return double(x) + amount * (2 * double(random->Uniform()) - 1);
  };
  const double x = next(v.x), y = next(v.y), z = next(v.z);
  std::snprintf(text, sizeof text, "%.6g %.6g %.6g  ", x, y, z);
  return text;
}

// Returns a fan of four faces round a vertex at the edge of the mesh.
std::string FanText(RandomStream* random) {
  const std::array<Vector3, 6> kPoints{{{0, Real(-.2), Real(.2)},
                                        {1, Real(-.2), 0},
                                        {Real(.7), Real(.6), Real(.1)},
                                        {0, Real(.9), 0},
                                        {Real(-.7), Real(.5), Real(-.1)},
                                        {-1, Real(-.3), 0}}};
  std::string text = "Shape \"loopsubdiv\" \"integer nlevels\" " +
                     std::to_string(1 + random->Bits() % 3) +
                     " \"integer indices\" [0 1 2 0 2 3 0 3 4 0 4 5] \"point P\" [";
  for (const Vector3& p : kPoints) text += Jittered(p, .1, random);
  return text + "]\n";
}

std::string TriangleText(RandomStream* random) {
  const std::string up = Jittered({0, 0, 1}, .3, random) + Jittered({0, 0, 1}, .3, random) +
                         Jittered({0, 0, 1}, .3, random);
  const std::string along = Jittered({1, 0, 0}, .3, random) + Jittered({1, 0, 0}, .3, random) +
                            Jittered({1, 0, 0}, .3, random);
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

}  // namespace

void ProbeMeshes(std::uint64_t seed, Findings* findings) {
  RandomStream random(HashKey({seed, 18}));
  const std::string text = "WorldBegin\nTranslate 0 0 -.5\n" + FanText(&random) +
                           "Translate 0 0 1\n" + TriangleText(&random) + "WorldEnd\n";
  const ProbedScene scene(text, seed, 0);
  for (int i = 0; i < kMeshRays; ++i) {
    Ray ray;
    ray.o = {2 * random.Uniform() - 1, 2 * random.Uniform() - 1, i % 2 ? Real(-2) : Real(2)};
    ray.d = {0, 0, i % 2 ? Real(1) : Real(-1)};
    if (const auto sight = scene.Look(ray)) CheckMeshSight(sight->surface, findings);
  }
}

}  // namespace exphoton::random_scenes
