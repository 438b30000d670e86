// SPDX-License-Identifier: BSD-2-Clause
// Writes a random scene as the text of a scene file.
#pragma once

#include <array>
#include <string>

#include "tests/random/scenes/scene_model.h"

namespace exphoton::random_scenes {

inline constexpr int kFilmWidth = 12, kFilmHeight = 8;

struct TextOptions {
  std::string integrator = "";  // with parameters; empty: the scene's own
  std::string accelerator = "bvh";
  int photons = 500;              // of each map
  int gatherRays = 6;             // of a camera sample
  int maxPhotonPaths = 10000;     // of each map
  int samples = 0;                // a pixel, by the box filter; 0: two, by the scene's own sampler
  bool keepsLastElements = true;  // of matrices; else they are all 1
  // Instead of the scene's lights: an even sky of radiance 1, and surfaces that emit what their
  // albedo leaves of 1. No radiance is then above 1 outside glass.
  bool isFurnace = false;
};

std::string SceneText(const SceneModel& scene, const TextOptions& options);

// An upper bound of the albedo under any direction of light, and so of the energy that a surface
// returns. 1 where a Fresnel term may be 1.
std::array<double, 3> LargestAlbedo(const MaterialModel& material);

// Writes the textures of a material, and then its Material directive. `next` numbers textures.
std::string MaterialText(const MaterialModel& material, bool hasBumps, int* next);

// "[.1 .2 .3]", each channel times factor.
std::string ColourText(const Colour& colour, double factor);
std::string ImageFile();  // a small image of the sources

}  // namespace exphoton::random_scenes
