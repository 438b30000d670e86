// SPDX-License-Identifier: BSD-2-Clause
// FocusedScene draws from the seed, independently of the generator: its scenes stay the same.
#include "tests/random/probes/focused_scene.h"

#include <array>

#include "core/math/sampling/random.h"

namespace exphoton::random_scenes {

SceneModel FocusedScene(const SceneModel& scene, std::uint64_t seed) {
  RandomStream random(HashKey({seed, 15}));
  const auto choose = [&](int count) { return int(random.Bits() % std::uint64_t(count)); };
  SceneModel focused = scene;
  if (focused.bodies.empty()) focused.bodies.emplace_back();
  BodyModel& body = focused.bodies.front();
  body.kind = BodyKind(1 + choose(kBodyKinds - 1));
  body.stretch = choose(3);
  body.turn = choose(6);
  body.motion = choose(2) * (1 + choose(3));
  body.emission = choose(2);
  body.isInstance = body.emission == 0 ? choose(2) : 0;
  if (body.light.Max() == 0) body.light = {9, 9, 9};
  body.isOpenMesh = true;
  if (choose(4) == 0) body.material.kind = MaterialKind::Translucent;
  body.material.isTransmittingOnly = choose(2) == 0;
  return focused;
}

SceneModel LoneLamp(std::uint64_t seed) {
  RandomStream random(HashKey({seed, 20}));
  const auto choose = [&](int count) { return int(random.Bits() % std::uint64_t(count)); };
  constexpr std::array<int, 4> kStretches{0, 1, 1, 2};
  BodyModel lamp;
  lamp.kind = BodyKind(choose(kBodyKinds));
  lamp.size = choose(3), lamp.turn = choose(6), lamp.reverse = choose(2);
  lamp.stretch = kStretches[std::size_t(choose(4))];
  lamp.motion = choose(2) * (1 + choose(3));
  lamp.last = choose(4);
  lamp.emission = 1, lamp.light = {9, 9, 9};
  lamp.isOpenMesh = choose(2) == 0;
  lamp.isGrowing = lamp.motion != 0 && choose(2) == 0;
  SceneModel scene;
  scene.room = RoomKind::None;
  scene.bodies = {lamp};
  return scene;
}

SceneModel SometimesFocused(const SceneModel& scene, std::uint64_t seed) {
  return seed / 2 % 2 == 0 ? FocusedScene(scene, seed) : scene;
}

}  // namespace exphoton::random_scenes
