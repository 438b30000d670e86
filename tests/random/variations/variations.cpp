// SPDX-License-Identifier: BSD-2-Clause
// BrokenVariation chooses the change and the integrator by two digits of the seed's hash.
#include "tests/random/variations/variations.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <exception>

#include "core/math/sampling/random.h"
#include "tests/random/scenes/scene_text.h"
#include "tests/support/test_scene.h"

namespace exphoton::random_scenes {
namespace {

constexpr int kWidth = 8, kHeight = 6;

// Take is one way to render a scene.
struct Take {
  SceneModel scene;
  TextOptions text;
  TestRenderOptions render;
};

struct PictureChange {
  const char* name;
  void (*change)(Take*);
  // Makes the scene one that the change may not alter.
  void (*prepare)(Take*) = [](Take*) {};
  float factor = 1;  // of the pixels
};

// Bumps are heights in scene units, and so is the step of a volume integrator that is not named.
// The threshold is an absolute radiance. Virtual lights have a least distance, and ambient
// occlusion is no radiance.
void WithoutAbsoluteValues(Take* take) {
  if (take->scene.volumeIntegrator == 0) take->scene.volumeIntegrator = 1;
  take->scene.walls.bump = 0;
  for (BodyModel& body : take->scene.bodies) body.material.bump = 0;
  std::string& integrator = take->text.integrator;
  if (integrator.starts_with("\"igi\"") || integrator.starts_with("\"ambient"))
    integrator = "\"path\"";
  if (integrator.find("photonmap") != std::string::npos)
    take->text.ending = " \"float rrthreshold\" 0";
}

// Photons and camera rays leave the room through other walls.
void MakeWallsOpaque(SceneModel* scene) {
  scene->walls.kind = scene->walls.roughness % 2 ? MaterialKind::Plastic : MaterialKind::Matte;
}

// A room that no light leaves, with an integrator that chooses no photons: those of fog take random
// numbers. The volume integrator is named, because fog in the scene decides which is the default.
void InClosedRoom(Take* take) {
  constexpr std::array<const char*, 4> kWithoutPhotons{
      R"("directlighting" "string strategy" "near")", R"("path")", R"("bidirectional")",
      R"("directlighting")"};
  SceneModel& scene = take->scene;
  scene.room = scene.room == RoomKind::Box ? RoomKind::Box : RoomKind::Sphere;
  MakeWallsOpaque(&scene);
  std::erase_if(scene.lights, [](const LightModel& l) { return l.kind >= LightKind::Distant; });
  scene.volumeIntegrator = std::max(scene.volumeIntegrator, 1);
  if (scene.camera.kind == 1) scene.camera.kind = 0;
  scene.camera.motion = 0;
  take->text.integrator = kWithoutPhotons[std::size_t(scene.integrator) % kWithoutPhotons.size()];
}

// Fills nearly half of all directions, outside of every room.
const char* const kFogOutside =
    "Volume \"homogeneous\" \"point p0\" [3.1 -9 -9] \"point p1\" [9 9 9] \"color sigma_a\" "
    "[.5 .6 .7]\nVolume \"homogeneous\" \"point p0\" [-9 -9 -9] \"point p1\" [-3.1 9 9] \"color "
    "sigma_a\" [.5 .6 .7]\n";

// All motion ends at .2, before the exposure begins. Half of the scenes get fog, which scatters.
// The walls are opaque, because the plate stays outside of them.
void AfterAllMotion(Take* take) {
  SceneModel& scene = take->scene;
  scene.room = RoomKind::Sphere;
  MakeWallsOpaque(&scene);
  std::erase_if(scene.lights, [](const LightModel& l) { return l.kind >= LightKind::Distant; });
  scene.camera.times = 1, scene.camera.shutter = 2;
  if (scene.sampler % 2 || !scene.media.empty()) return;
  MediumModel fog;
  fog.parts = 1, fog.scattered = {4, 4, 4};
  scene.media = {fog};
  scene.volumeIntegrator = 2;
}

// A disk across the room, which shrinks and moves into a corner of the room's bounds.
const char* const kLeavingPlate =
    "AttributeBegin ActiveTransform EndTime Translate 2.6 2.6 2.6 Scale .05 .05 .05 "
    "ActiveTransform All\nMaterial \"matte\" Shape \"disk\" \"float radius\" 2.8\n"
    "AttributeEnd\n";

const std::array<PictureChange, 16> kPictureChanges{{
    {"every feature on", [](Take* t) { t->render.load.effects = "all"; }},
    {"7 threads, tiles of 3", [](Take* t) { t->render.threads = 7, t->render.tileSize = 3; }},
    {"2 threads, tiles of 64", [](Take* t) { t->render.threads = 2, t->render.tileSize = 64; }},
    {"kdtree", [](Take* t) { t->text.accelerator = "kdtree"; }},
    {"bruteforce", [](Take* t) { t->text.accelerator = "bruteforce"; }},
    {"matrices with 1 as last element", [](Take* t) { t->text.keepsLastElements = false; }},
    {"tiles in reversed order", [](Take* t) { t->render.tileOrder = TileOrder::Reversed; }},
    {"the lower left quarter",
     [](Take* t) {
       t->text.crop = {0, .5, .5, 1};
     }},
    {"the upper right quarter",
     [](Take* t) {
       t->text.crop = {.5, 1, 0, .5};
     }},
    {"32 times as large", [](Take* t) { t->text.size = 32; }, WithoutAbsoluteValues},
    {"1/32 as large", [](Take* t) { t->text.size = 1 / 32.; }, WithoutAbsoluteValues},
    {"8 times the light", [](Take* t) { t->text.power = 8; }, WithoutAbsoluteValues, 8},
    {"1/8 of the light", [](Take* t) { t->text.power = .125; }, WithoutAbsoluteValues, .125F},
    {"one more light, which is black", [](Take* t) { t->text.hasBlackLight = true; }},
    {"fog outside of a closed room", [](Take* t) { t->text.worldScale = kFogOutside; },
     InClosedRoom},
    {"a plate that leaves before the exposure", [](Take* t) { t->text.worldScale = kLeavingPlate; },
     AfterAllMotion},
}};

// Integrators that SceneModel::integrator does not have.
const std::array<const char*, 4> kFurtherIntegrators{
    "\"bidirectional\"", "\"irradiancecache\" \"integer nsamples\" 16",
    "\"igi\" \"integer nlights\" 8 \"integer nsets\" 2", "\"ambientocclusion\""};

struct ChosenChange {
  const PictureChange& variation;
  Take take;
};

ChosenChange ChooseChange(const SceneModel& scene, std::uint64_t seed) {
  RandomStream random(HashKey({seed, 14}));
  const auto choose = [&](std::size_t count) { return std::size_t(random.Bits() % count); };
  const PictureChange& variation = kPictureChanges[choose(kPictureChanges.size())];
  Take take{scene, {}, {}};
  take.text.photons = 100, take.text.maxPhotonPaths = 1000, take.text.gatherRays = 4;
  take.text.width = kWidth, take.text.height = kHeight;
  const std::size_t i = choose(kIntegrators.size() + kFurtherIntegrators.size());
  take.text.integrator =
      i < kIntegrators.size() ? kIntegrators[i] : kFurtherIntegrators[i - kIntegrators.size()];
  take.render.seed = 7;
  variation.prepare(&take);
  return {variation, take};
}

std::string PixelText(int x, int y, double first, double second) {
  char text[100];
  std::snprintf(text, sizeof text, "pixel (%d, %d) has %.9g and %.9g", x, y, first, second);
  return text;
}

// Compares the pixels that the second picture has.
std::string PartDifference(const Image& whole, const Image& part, float factor,
                           const std::array<double, 4>& crop) {
  const int left = int(crop[0] * kWidth), top = int(crop[2] * kHeight);
  for (int y = 0; y < part.Height(); ++y)
    for (int x = 0; x < part.Width(); ++x)
      for (int c = 0; c < int(part.channels.size()); ++c) {
        const float expected = whole.At(x + left, y + top, c) * (c < 3 ? factor : 1);
        const float value = part.At(x, y, c);
        // Light this dim may come from products below the normal numbers of float (1.2e-38), which
        // have fewer digits.
        const bool isTiny = factor != 1 && std::max(value, expected) < 1e-30F;
        if (!std::isfinite(value) || value < 0 || (value != expected && !isTiny))
          return PixelText(x, y, double(expected), double(value));
      }
  return "";
}

}  // namespace

std::string VariationName(const SceneModel& scene, std::uint64_t seed) {
  return ChooseChange(scene, seed).variation.name;
}

std::string BrokenVariation(const SceneModel& scene, std::uint64_t seed) {
  const ChosenChange choice = ChooseChange(scene, seed);
  try {
    Take changed = choice.take;
    choice.variation.change(&changed);
    const auto picture = [](const Take& take) {
      return RenderSceneText(SceneText(take.scene, take.text), take.render).image;
    };
    const std::string difference = PartDifference(picture(choice.take), picture(changed),
                                                  choice.variation.factor, changed.text.crop);
    if (difference.empty()) return "";
    return std::string(choice.variation.name) + " with " + changed.text.integrator + ": " +
           difference;
  } catch (const std::exception& error) {
    return std::string("an error with the change \"") + choice.variation.name +
           "\": " + error.what();
  }
}

}  // namespace exphoton::random_scenes
