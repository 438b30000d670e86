// SPDX-License-Identifier: BSD-2-Clause
// A sphere of one material has no edges, where density estimates would be biased.
#include "tests/random/variations/gathers.h"

#include <array>
#include <cmath>

#include "core/math/sampling/random.h"
#include "core/math/sampling/sampling.h"
#include "tests/random/probes/rooms.h"
#include "tests/random/variations/parts.h"

namespace exphoton::random_scenes {
namespace {

struct GatherPair {
  const char* first;
  const char* second;
  bool hasTurnedNormals;
  double margin;
};
constexpr const char* kReference = R"("path" "integer maxdepth" 60)";
constexpr std::array<GatherPair, 4> kGatherPairs{{
    {R"("photonmap" "integer maxdepth" 24 "string photonroulette" "luminance")", kReference, true,
     .05},
    {R"("exphotonmap" "integer maxdepth" 24 "bool radiancephotons" "false")", kReference, true,
     .05},
    {R"("exphotonmap" "bool sharedgather" "true")", R"("exphotonmap" "bool sharedgather" "false")",
     false, .01},
    {R"("photonmap" "bool sharedgather" "true")", R"("photonmap" "bool sharedgather" "false")",
     false, .01},
}};

bool IsInShell(std::uint64_t seed) { return HashKey({seed, 26}) % 3 == 0; }

const GatherPair& GatherPairOf(std::uint64_t seed) {
  return kGatherPairs[std::size_t(HashKey({seed, 27}) % kGatherPairs.size())];
}

std::string TripleText(const Vector3& v) {
  return std::to_string(v.x) + " " + std::to_string(v.y) + " " + std::to_string(v.z) + " ";
}

// Returns a closed mesh of radius 3 whose vertices have turned normals.
std::string TurnedSphere(std::uint64_t seed) {
  constexpr int kRings = 9, kSectors = 14;
  RandomStream random(HashKey({seed, 28}));
  std::string points, normals, indices;
  for (int i = 0; i <= kRings; ++i)
    for (int j = 0; j < kSectors; ++j) {
      const double theta = double(kPi) * i / kRings, phi = 2 * double(kPi) * j / kSectors;
      const Vector3 w{Real(std::sin(theta) * std::cos(phi)), Real(std::sin(theta) * std::sin(phi)),
                      Real(std::cos(theta))};
      const Point2 u{random.Uniform(), random.Uniform()};
      points += TripleText(w * 3);
      normals += TripleText(Normalize(SampleUniformSphere(u) * Real(.7) - w));
      if (i == kRings) continue;
      const auto at = [&](int ring, int sector) {
        return std::to_string(ring * kSectors + sector % kSectors) + " ";
      };
      if (i > 0) indices += at(i, j) + at(i + 1, j) + at(i, j + 1);
      if (i + 1 < kRings) indices += at(i, j + 1) + at(i + 1, j) + at(i + 1, j + 1);
    }
  return "AttributeBegin Material \"matte\" \"color Kd\" [.8 .7 .6]\nShape \"trianglemesh\" "
         "\"integer indices\" [" +
         indices + "] \"point P\" [" + points + "] \"normal N\" [" + normals + "]\nAttributeEnd\n";
}

SceneModel GatherSphere(const SceneModel& drawn, std::uint64_t seed) {
  RandomStream random(HashKey({seed, 29}));
  const auto choose = [&](int count) { return int(random.Bits() % std::uint64_t(count)); };
  SceneModel scene = PhotonRoom(drawn, seed);
  scene.bodies.clear(), scene.media.clear();
  LightModel lamp;
  lamp.colour = {9, 8, 7};
  lamp.place = {choose(5) - 2, choose(5) - 2, choose(3) - 3};
  scene.lights = {lamp};
  scene.volumeIntegrator = 0;
  scene.room = GatherPairOf(seed).hasTurnedNormals ? RoomKind::None : RoomKind::Sphere;
  scene.walls.kind = choose(2) ? MaterialKind::Plastic : MaterialKind::Substrate;
  scene.walls.share = 1, scene.walls.roughness = choose(2);
  // Where the diffuse reflectance differs between pixels, only the diffuse part may be shared.
  scene.walls.diffuse.kind = TextureKind::CheckerboardOfSpace;
  scene.walls.diffuse.first = {9, 9, 9}, scene.walls.diffuse.second = {1, 1, 1};
  return scene;
}

std::string GatherText(const SceneModel& scene, const char* integrator, std::uint64_t seed,
                       int factor) {
  TextOptions options = SmallPicture(integrator, factor, 4 * factor);
  const std::string room = GatherPairOf(seed).hasTurnedNormals ? TurnedSphere(seed) : "";
  options.worldScale = room.c_str();
  return SceneText(scene, options);
}

}  // namespace

std::vector<Comparison> CompareGathers(const SceneModel& drawn, const Effort& effort) {
  if (IsInShell(effort.sceneSeed)) return CompareInShell(drawn, effort);
  const GatherPair& pair = GatherPairOf(effort.sceneSeed);
  const SceneModel scene = GatherSphere(drawn, effort.sceneSeed);
  const auto means = [&](const char* integrator, std::uint64_t seed) {
    return MeansOf(GatherText(scene, integrator, effort.sceneSeed, effort.factor), seed);
  };
  const PartMeans a = means(pair.first, effort.firstSeed);
  const PartMeans b = means(pair.second, effort.firstSeed + 7);
  return CompareParts(std::string(pair.first) + " against " + pair.second, a, b, {pair.margin},
                      false);
}

std::string GathersText(const SceneModel& drawn, std::uint64_t seed) {
  if (IsInShell(seed)) return ShellText(drawn, seed);
  return GatherText(GatherSphere(drawn, seed), GatherPairOf(seed).first, seed, 1);
}

}  // namespace exphoton::random_scenes
