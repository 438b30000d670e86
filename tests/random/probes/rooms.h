// SPDX-License-Identifier: BSD-2-Clause
// Rooms are random scenes that are made simpler so that an error of light transport is large beside
// the noise: small closed rooms, in which light is reflected many times.
#pragma once

#include "tests/random/scenes/agreement.h"

namespace exphoton::random_scenes {

// Returns a closed room with at most one body, one lamp, and thick fog or glossy walls half the
// time. Paths and photons find all of its light quickly.
SceneModel PhotonRoom(const SceneModel& scene, std::uint64_t seed);

// Returns a closed room in which every radiance is 1. Each surface emits 1 minus its albedo, which
// is known exactly, and each medium emits what it absorbs.
SceneModel ExactFurnace(const SceneModel& scene, std::uint64_t seed);
// Returns a furnace with closed bodies and walls of one material.
SceneModel UniformFurnace(const SceneModel& furnace, bool hasEdges);
// Compares the picture of an exact furnace with 1, for the integrator that the seed chooses.
std::vector<Comparison> CompareWithFurnace(const SceneModel& scene, const Effort& effort);
// Compares the picture of a uniform furnace with the sum over the bounces that an integrator
// follows.
std::vector<Comparison> CompareWithSum(const SceneModel& scene, const Effort& effort);
// Compares the picture of a photon map with 1, in a spherical furnace full of glass and mirrors.
std::vector<Comparison> CompareInShell(const SceneModel& scene, const Effort& effort);
std::string ShellText(const SceneModel& scene, std::uint64_t seed);
std::string FurnaceText(const SceneModel& furnace);

}  // namespace exphoton::random_scenes
