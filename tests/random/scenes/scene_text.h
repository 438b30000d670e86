// SPDX-License-Identifier: BSD-2-Clause
// SceneText writes a random scene as the text of a scene file.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "tests/random/scenes/scene_model.h"

namespace exphoton::random_scenes {

inline constexpr int kFilmWidth = 12, kFilmHeight = 8;

struct TextOptions {
  std::string integrator = "";  // with parameters; empty: the scene's integrator
  std::string accelerator = "bvh";
  int photons = 500;              // per map
  int gatherRays = 6;             // per camera sample
  int maxPhotonPaths = 10000;     // per map
  int samples = 0;                // per pixel, box filter; 0: two, by the scene's sampler
  bool keepsLastElements = true;  // of matrices; otherwise they are 1
  // A furnace has an even sky of radiance 1 instead of the scene's lights, and surfaces that emit 1
  // minus their albedo. No radiance outside glass then exceeds 1.
  bool isFurnace = false;
  bool hasSky = true;  // of a furnace; if not, media emit what they absorb
  // Everything that moves is held at this share of its motion, in [0,1].
  std::optional<double> stillAt = std::nullopt;
  bool partsMove = false;        // parts of instanced objects move as well, within the object
  const char* worldScale = "";   // a directive before the world's lights and shapes
  const char* objectScale = "";  // its inverse, for objects: their instances are scaled already
  int width = kFilmWidth, height = kFilmHeight;
  std::array<double, 4> crop{0, 1, 0, 1};  // part of the film
  // Two changes that leave the picture as it is, but for a factor. `size` multiplies all lengths
  // and keeps all radiances. `power` multiplies all emission.
  double size = 1, power = 1;
  bool hasBlackLight = false;  // one more light, which emits nothing
  std::string ending = "";     // further parameters of the integrator
};

std::string SceneText(const SceneModel& scene, const TextOptions& options);

// Returns an upper bound of the albedo for light from any direction, and thus of the energy that a
// surface returns. The bound is 1 if a Fresnel term may be 1.
std::array<double, 3> LargestAlbedo(const MaterialModel& material);

// Writes the textures of a material and then its Material directive. `next` numbers textures.
std::string MaterialText(const MaterialModel& material, bool hasBumps, int* next);

// Returns the value that "%.6g" prints.
double SixDigits(double value);

// Returns "[.1 .2 .3]", each channel times the factor, with six digits, times the scale.
std::string ColourText(const Colour& colour, double factor, double scale = 1);
std::string ImageFile();
std::string MeasurementFile();  // of the material "measured"  // a small image in the source tree

}  // namespace exphoton::random_scenes
