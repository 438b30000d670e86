// SPDX-License-Identifier: BSD-2-Clause
// A furnace is exact for Lambertian surfaces, mirrors and white glass, if the body is closed: it
// emits on its outside only. Open bodies are white mirrors, which need not emit.
//
// The radiance of a uniform furnace, where all surfaces are Lambertian with albedo a and emission
// 1 - a, is the sum of (1 - a) a^k over the bounces k of its light. An integrator that leaves out
// light of more than n bounces shows 1 - a^(n+1) exactly, at every point and for every shape of the
// room. These are the values of n for each integrator and limit d of its depth:
// - path, guidedpath and bidirectional collect emission at the camera's surface (k = 0) and direct
//   light at it and the next d surfaces (k = 1 to d + 1).
// - irradiancecache adds d bounces of indirect light to emission and direct light: n = d + 1.
// - directlighting and whitted stop at direct light: n = 1.
// - A photon map holds the hits 1 to d of the photons, with light that was reflected k = 0 to d - 1
//   times before. A gather ray reads light that leaves its end, so it was reflected 1 to d times,
//   and the camera's surface reflects it once more: n = d + 1. A map that is shown directly lacks
//   the last reflection: n = d.
#include "tests/random/probes/rooms.h"

#include <algorithm>
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
  const char* depth;  // the parameter that limits the bounces; "": none does
  int samples;
  double margin;
};
// Density estimates are biased at the edges of bodies.
constexpr std::array<FurnaceMethod, 5> kFurnaceMethods{
    {{R"("path")", "maxdepth", 8, .01},
     {R"("guidedpath")", "maxdepth", 4, .01},
     {R"("bidirectional")", "maxdepth", 4, .01},
     {R"("exphotonmap" "integer maxdepth" 24)", "", 2, .08},
     {R"("photonmap" "integer maxdepth" 24)", "", 2, .08}}};
constexpr int kManyBounces = 100;
// In a sphere with bodies of glass and mirrors, density estimates have no edges. Where surfaces
// reflect more than .71, the roulette "half" gives the powers of photons an infinite variance.
constexpr std::array<FurnaceMethod, 3> kShellMethods{
    {{R"("exphotonmap" "integer maxdepth" 24)", "", 2, .01},
     {R"("exphotonmap" "integer maxdepth" 24 "bool radiancephotons" "false")", "", 2, .01},
     {R"("photonmap" "integer maxdepth" 24 "string photonroulette" "luminance")", "", 2, .01}}};

struct UniformMethod {
  FurnaceMethod method;
  int leastDepth, firstBounces;  // the largest number of bounces is depth + firstBounces
  bool usesPhotons;              // the furnace has no edges, where density estimates are biased
};
constexpr std::array<UniformMethod, 10> kUniformMethods{
    {{{R"("path")", "maxdepth", 4, .005}, 0, 1, false},
     {{R"("guidedpath")", "maxdepth", 4, .005}, 0, 1, false},
     {{R"("bidirectional")", "maxdepth", 4, .005}, 0, 1, false},
     {{R"("directlighting")", "", 4, .005}, 0, 1, false},
     {{R"("whitted")", "", 4, .005}, 0, 1, false},
     {{R"("irradiancecache" "integer nsamples" 64)", "maxindirectdepth", 2, .01}, 0, 1, true},
     {{R"("exphotonmap")", "maxphotondepth", 2, .02}, 1, 1, true},
     {{R"("exphotonmap" "bool radiancephotons" "false")", "maxphotondepth", 2, .02}, 1, 1, true},
     {{R"("photonmap")", "maxphotondepth", 2, .02}, 1, 1, true},
     {{R"("photonmap" "bool finalgather" "false")", "maxphotondepth", 2, .02}, 1, 0, true}}};
constexpr int kDepths = 3;  // values of the limit for each method

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

// Within glass of index n all radiances are n^2. A medium or a matte body there does not emit as
// much, and bodies may overlap. The glass becomes matte then.
void ReplaceShiningGlass(SceneModel* furnace) {
  const auto isMatte = [](const BodyModel& b) { return b.material.kind == MaterialKind::Matte; };
  if (furnace->media.empty() &&
      std::none_of(furnace->bodies.begin(), furnace->bodies.end(), isMatte))
    return;
  for (BodyModel& body : furnace->bodies)
    if (body.material.kind == MaterialKind::Glass) body.material.kind = MaterialKind::Matte;
}

std::string MethodText(const FurnaceMethod& method, int bounces) {
  std::string text = method.integrator;
  if (*method.depth)
    text += std::string(" \"integer ") + method.depth + "\" " + std::to_string(bounces);
  return text;
}

TextOptions FurnaceOptions(const std::string& integrator, int samples, int factor) {
  TextOptions options;
  options.isFurnace = true;
  options.hasSky = false;
  options.integrator = integrator;
  options.samples = samples * factor;
  options.gatherRays = 8;
  options.photons = 4000 * factor;
  options.maxPhotonPaths = 100000 * factor;
  return options;
}

// Compares the mean radiance of a furnace with the expected one.
Comparison CompareMean(const SceneModel& furnace, const FurnaceMethod& method, int bounces,
                       double expected, const Effort& effort) {
  const std::string integrator = MethodText(method, bounces);
  const std::string text =
      SceneText(furnace, FurnaceOptions(integrator, method.samples, effort.factor));
  std::vector<double> means;
  for (int k = 0; k < kFurnaceSeeds; ++k) {
    TestRenderOptions options;
    options.seed = effort.firstSeed + std::uint64_t(k) * 1000;
    means.push_back(MeanRadiance(RenderSceneText(text, options).image));
  }
  const Sample sample = SampleOf(means);
  char detail[100];
  std::snprintf(detail, sizeof detail, "%.5g +- %.2g against %.5g", sample.mean,
                std::sqrt(sample.variance), expected);
  return {"furnace of " + integrator,
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
  // The image plane of a turned orthographic camera would reach through the front wall.
  if (exact.camera.kind == 1 && exact.camera.motion == 2) exact.camera.motion = 0;
  exact.volumeIntegrator = 1;
  for (BodyModel& body : exact.bodies) {
    const bool isClosed = body.kind == BodyKind::Sphere || body.kind == BodyKind::Box;
    const bool mayEmit = isClosed && body.isInstance == 0;
    body.material = WithExactAlbedo(body.material, mayEmit, random.Bits());
    body.reverse = 0;
    if (body.stretch == 2) body.stretch = 0;
    if (body.kind == BodyKind::SmoothMesh || body.kind == BodyKind::Subdivided ||
        body.kind == BodyKind::Nurbs || body.kind == BodyKind::HeightField)
      body.kind = BodyKind::Cone;               // mirrors with interpolated normals lose light
    body.place.z = std::max(body.place.z, -1);  // the camera at the front wall stays outside
  }
  for (MediumModel& medium : exact.media) medium.parts = 0;
  ReplaceShiningGlass(&exact);
  return exact;
}

SceneModel UniformFurnace(const SceneModel& scene, bool hasEdges) {
  SceneModel uniform = scene;
  if (!hasEdges) uniform.room = RoomKind::Sphere, uniform.bodies.clear();
  uniform.media.clear();
  std::erase_if(uniform.bodies, [](const BodyModel& body) {
    return body.kind != BodyKind::Sphere && body.kind != BodyKind::Box;
  });
  for (BodyModel& body : uniform.bodies) body.material = uniform.walls, body.isInstance = 0;
  return uniform;
}

std::string FurnaceText(const SceneModel& furnace) {
  return SceneText(furnace, FurnaceOptions(MethodText(kFurnaceMethods[0], kManyBounces),
                                           kFurnaceMethods[0].samples, 1));
}

std::vector<Comparison> CompareWithFurnace(const SceneModel& scene, const Effort& effort) {
  const SceneModel furnace = ExactFurnace(scene, effort.sceneSeed);
  const std::uint64_t choice = HashKey({effort.sceneSeed, 13});
  const FurnaceMethod& method = kFurnaceMethods[std::size_t(choice % kFurnaceMethods.size())];
  return {CompareMean(furnace, method, kManyBounces, 1, effort)};
}

SceneModel ShellFurnace(const SceneModel& scene, std::uint64_t seed) {
  RandomStream random(HashKey({seed, 30}));
  SceneModel shell = UniformFurnace(ExactFurnace(scene, seed), false);
  shell.walls.diffuse.first = {9, 9, 9};  // photons have equal powers in all channels
  shell.camera.kind = shell.camera.motion = shell.camera.lens = 0;
  for (int corner = 0; corner < 8; ++corner) {
    BodyModel body;
    body.kind = BodyKind::Sphere, body.size = 2;
    body.place = {corner & 1 ? 4 : -4, corner & 2 ? 4 : -4, corner & 4 ? 4 : -4};
    body.material.kind = random.Bits() % 3 == 0 ? MaterialKind::Mirror : MaterialKind::Glass;
    body.material.mirror.first = kWhite;
    body.material.diffuse.first = body.material.glossy.first = kWhite;
    shell.bodies.push_back(body);
  }
  return shell;
}

std::vector<Comparison> CompareInShell(const SceneModel& scene, const Effort& effort) {
  const std::uint64_t choice = HashKey({effort.sceneSeed, 31});
  const FurnaceMethod& method = kShellMethods[std::size_t(choice % kShellMethods.size())];
  return {CompareMean(ShellFurnace(scene, effort.sceneSeed), method, kManyBounces, 1, effort)};
}

std::string ShellText(const SceneModel& scene, std::uint64_t seed) {
  return FurnaceText(ShellFurnace(scene, seed));
}

std::vector<Comparison> CompareWithSum(const SceneModel& scene, const Effort& effort) {
  RandomStream random(HashKey({effort.sceneSeed, 13}));
  const auto choose = [&](std::size_t count) { return std::size_t(random.Bits() % count); };
  const UniformMethod& uniform = kUniformMethods[choose(kUniformMethods.size())];
  const int depth = uniform.leastDepth + int(choose(kDepths));
  const int bounces = uniform.firstBounces + (*uniform.method.depth ? depth : 0);
  const SceneModel furnace =
      UniformFurnace(ExactFurnace(scene, effort.sceneSeed), !uniform.usesPhotons);
  double expected = 0;
  for (const double albedo : LargestAlbedo(furnace.walls))
    expected += (1 - std::pow(albedo, bounces + 1)) / 3;
  return {CompareMean(furnace, uniform.method, depth, expected, effort)};
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
