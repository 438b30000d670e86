// SPDX-License-Identifier: BSD-2-Clause
// A furnace is exact for Lambertian surfaces, mirrors and white glass, if the body is closed: it
// emits on its outside only. Open bodies are white mirrors, which need not emit.
#include "tests/random/probes/rooms.h"

#include <array>
#include <cmath>
#include <cstdio>

#include "core/math/sampling/random.h"
#include "tests/random/scenes/scene_text.h"
#include "tests/random/scenes/statistics.h"
#include "tests/support/test_scene.h"

namespace exphoton::random_scenes {
namespace {

constexpr int kFurnaceSeeds = 8;
const Colour kWhite{10, 10, 10};

struct FurnaceMethod {
  const char* integrator;
  int samples;
  double margin;
};
// Density estimates are biased at the edges of bodies.
constexpr std::array<FurnaceMethod, 5> kFurnaceMethods{
    {{"\"path\" \"integer maxdepth\" 100", 8, .01},
     {"\"guidedpath\" \"integer maxdepth\" 100", 4, .01},
     {"\"bidirectional\" \"integer maxdepth\" 100", 4, .01},
     {"\"exphotonmap\" \"integer maxdepth\" 24", 2, .08},
     {"\"photonmap\" \"integer maxdepth\" 24", 2, .08}}};

MaterialModel Plain(const MaterialModel& material) {
  MaterialModel plain = material;
  plain.bump = 0, plain.roughness = 0;
  plain.diffuse.kind = plain.glossy.kind = plain.mirror.kind = TextureKind::Constant;
  return plain;
}

// Returns a material whose albedo is LargestAlbedo for every direction.
MaterialModel WithExactAlbedo(const MaterialModel& material, bool mayEmit, std::uint64_t choice) {
  MaterialModel exact = Plain(material);
  if (!mayEmit) {
    exact.kind = MaterialKind::Mirror;
    exact.mirror.first = kWhite;
  } else if (choice % 4 == 0) {
    exact.kind = MaterialKind::Mirror;
  } else if (choice % 4 == 1) {
    exact.kind = MaterialKind::Glass;
    exact.diffuse.first = exact.glossy.first = kWhite;
  } else {
    exact.kind = MaterialKind::Matte;
  }
  return exact;
}

TextOptions FurnaceOptions(const FurnaceMethod& method, int factor) {
  TextOptions options;
  options.isFurnace = true;
  options.hasSky = false;
  options.integrator = method.integrator;
  options.samples = method.samples * factor;
  options.gatherRays = 8;
  options.photons = 4000 * factor;
  options.maxPhotonPaths = 100000 * factor;
  return options;
}

std::vector<double> FurnaceMeans(const std::string& text, std::uint64_t firstSeed) {
  std::vector<double> means;
  for (int k = 0; k < kFurnaceSeeds; ++k) {
    TestRenderOptions options;
    options.seed = firstSeed + std::uint64_t(k) * 1000;
    means.push_back(MeanRadiance(RenderSceneText(text, options).image));
  }
  return means;
}

// Compares a furnace of walls alone, with paths of limited length, with the partial sum of the
// geometric series.
Comparison CompareWithPartialSum(const SceneModel& furnace, const Effort& effort) {
  constexpr int kDepth = 2;
  constexpr std::array<const char*, 3> kNames{"path", "guidedpath", "bidirectional"};
  const char* name = kNames[std::size_t(effort.sceneSeed / 4 % kNames.size())];
  const std::string integrator =
      std::string("\"") + name + "\" \"integer maxdepth\" " + std::to_string(kDepth);
  SceneModel walls = furnace;
  walls.bodies.clear(), walls.media.clear();
  const FurnaceMethod method{integrator.c_str(), 4, .01};
  const std::string text = SceneText(walls, FurnaceOptions(method, effort.factor));
  const Sample sample = SampleOf(FurnaceMeans(text, effort.firstSeed + 9));
  double expected = 0;
  for (const double albedo : LargestAlbedo(walls.walls))
    expected += (1 - std::pow(albedo, kDepth + 1)) / 3;
  char detail[100];
  std::snprintf(detail, sizeof detail, "%.5g +- %.2g against %.5g", sample.mean,
                std::sqrt(sample.variance), expected);
  return {"furnace with maxdepth 2, " + std::string(name),
          PValueBeyond(sample, {expected, 0, kFurnaceSeeds}, method.margin * expected),
          sample.mean - expected, detail};
}

}  // namespace

SceneModel ExactFurnace(const SceneModel& scene, std::uint64_t seed) {
  RandomStream random(HashKey({seed, 11}));
  SceneModel exact = scene;
  exact.room = random.Bits() % 2 ? RoomKind::Box : RoomKind::Sphere;
  exact.walls = Plain(exact.walls);
  exact.walls.kind = MaterialKind::Matte;
  exact.lights.clear();
  exact.camera.place = 0;
  exact.volumeIntegrator = 1;
  for (BodyModel& body : exact.bodies) {
    const bool isClosed = body.kind == BodyKind::Sphere || body.kind == BodyKind::Box;
    const bool mayEmit = isClosed && body.isInstance == 0;
    body.material = WithExactAlbedo(body.material, mayEmit, random.Bits());
    body.reverse = 0;
    if (body.stretch == 2) body.stretch = 0;
    if (body.kind == BodyKind::SmoothMesh || body.kind == BodyKind::Subdivided ||
        body.kind == BodyKind::Nurbs || body.kind == BodyKind::HeightField)
      body.kind = BodyKind::Cone;              // mirrors with interpolated normals lose light
    body.place.z = std::min(body.place.z, 1);  // the camera stays outside
  }
  for (MediumModel& medium : exact.media) medium.parts = 0;
  return exact;
}

std::string FurnaceText(const SceneModel& furnace) {
  return SceneText(furnace, FurnaceOptions(kFurnaceMethods[0], 1));
}

std::vector<Comparison> CompareWithFurnace(const SceneModel& scene, const Effort& effort) {
  const SceneModel furnace = ExactFurnace(scene, effort.sceneSeed);
  std::vector<Comparison> comparisons;
  const std::size_t other = 1 + std::size_t(effort.sceneSeed / 4 % (kFurnaceMethods.size() - 1));
  for (const std::size_t i : {std::size_t(0), other}) {
    const FurnaceMethod& method = kFurnaceMethods[i];
    const std::string text = SceneText(furnace, FurnaceOptions(method, effort.factor));
    const Sample sample = SampleOf(FurnaceMeans(text, effort.firstSeed + i));
    char detail[100];
    std::snprintf(detail, sizeof detail, "%.5g +- %.2g against 1", sample.mean,
                  std::sqrt(sample.variance));
    comparisons.push_back({"furnace of " + std::string(method.integrator),
                           PValueBeyond(sample, {1, 0, kFurnaceSeeds}, method.margin),
                           sample.mean - 1, detail});
  }
  comparisons.push_back(CompareWithPartialSum(furnace, effort));
  return comparisons;
}

SceneModel PhotonRoom(const SceneModel& scene, std::uint64_t seed) {
  RandomStream random(HashKey({seed, 12}));
  const auto choose = [&](int count) { return int(random.Bits() % std::uint64_t(count)); };
  SceneModel room = scene;
  room.room = choose(2) ? RoomKind::Box : RoomKind::Sphere;
  room.walls = Plain(room.walls);
  room.walls.diffuse.first = {8, 7, 6};
  room.walls.glossy.first = {9, 9, 9};
  constexpr std::array<MaterialKind, 6> kWalls{MaterialKind::Matte,     MaterialKind::Matte,
                                               MaterialKind::Matte,     MaterialKind::Plastic,
                                               MaterialKind::Substrate, MaterialKind::Metal};
  room.walls.kind = kWalls[std::size_t(choose(6))];
  room.walls.share = room.walls.kind == MaterialKind::Matte ? 0 : 2;
  if (room.bodies.size() > 1) room.bodies.resize(1);
  for (BodyModel& body : room.bodies) {
    body.emission = 0, body.isInstance = 0;
    if (room.walls.kind != MaterialKind::Matte) body.material.kind = MaterialKind::Matte;
  }
  const LightModel lamp{.kind = choose(2) ? LightKind::Point : LightKind::Spot,
                        .colour = {9, 8, 7},
                        .place = {choose(5) - 2, choose(5) - 2, choose(3) - 3},
                        .cone = 2};
  room.lights = {lamp};
  room.media.clear();
  room.volumeIntegrator = 0;
  if (const int fog = choose(3); fog > 0) {
    MediumModel medium;
    medium.scattered = {9, 8, 7}, medium.emitted = {2, 2, 2};
    medium.parts = fog == 1 ? 1 : 2, medium.phase = choose(3);
    medium.kind = choose(3);
    room.media = {medium};
    room.volumeIntegrator = fog == 1 ? 2 : 1 + choose(2);
    if (fog == 2 && choose(2)) room.lights.clear();  // the fog is the only light
  }
  room.camera.kind = room.camera.lens = room.camera.motion = room.camera.place = 0;
  room.integrator = 0;  // keeps the lamp, see WithoutKnownDifferences
  return room;
}

}  // namespace exphoton::random_scenes
