// SPDX-License-Identifier: BSD-2-Clause
// BrokenInvariance tests the exact properties. The first round varies several things at once. It
// costs three pictures per scene, and two more with Embree. If a picture differs, single variations
// then locate the cause.
#include "tests/random/scenes/properties.h"

#include <cmath>
#include <cstdio>
#include <optional>
#include <stdexcept>
#include <vector>

#include "tests/random/scenes/scene_text.h"
#include "tests/support/test_scene.h"

namespace exphoton::random_scenes {
namespace {

struct Variation {
  std::string name;
  std::string effects = "auto";
  int threads = 1;
  int tileSize = 16;
  std::string accelerator = "bvh";
  bool keepsLastElements = true;
  std::string integrator = "";  // empty: the scene's integrator
};

Image Rendered(const SceneModel& scene, const Variation& variation) {
  TextOptions text;
  text.accelerator = variation.accelerator;
  text.keepsLastElements = variation.keepsLastElements;
  text.integrator = variation.integrator;
  TestRenderOptions options;
  options.seed = 7;
  options.threads = variation.threads;
  options.tileSize = variation.tileSize;
  options.load.effects = variation.effects;
  return RenderSceneText(SceneText(scene, text), options).image;
}

std::string Exact(float value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.9g", double(value));
  return text;
}

// Returns a description of the first pixel that differs, or "".
std::string Difference(const Image& a, const Image& b) {
  for (int y = 0; y < a.Height(); ++y)
    for (int x = 0; x < a.Width(); ++x)
      for (int c = 0; c < int(a.channels.size()); ++c)
        if (a.At(x, y, c) != b.At(x, y, c))
          return "pixel (" + std::to_string(x) + ", " + std::to_string(y) + ") has " +
                 Exact(a.At(x, y, c)) + " and " + Exact(b.At(x, y, c));
  return "";
}

std::string BadPixel(const Image& image) {
  for (const float pixel : image.pixels)
    if (!std::isfinite(pixel) || pixel < 0) return "a pixel is " + std::to_string(pixel);
  return "";
}

// Returns the single variation that changes the picture, with the first difference.
std::string Culprit(const SceneModel& scene, const Image& base) {
  const std::vector<Variation> single{
      {.name = "the same again"},
      {.name = "effects all", .effects = "all"},
      {.name = "2 threads", .threads = 2, .tileSize = 3},
      {.name = "7 threads", .threads = 7, .tileSize = 3},
      {.name = "kdtree", .accelerator = "kdtree"},
      {.name = "bruteforce", .accelerator = "bruteforce"},
      {.name = "matrices with 1 as last element", .keepsLastElements = false}};
  for (const Variation& variation : single) {
    const std::string difference = Difference(base, Rendered(scene, variation));
    if (!difference.empty())
      return "auto, 1 thread, bvh against " + variation.name + ": " + difference;
  }
  return "several variations together differ, none alone does";
}

#ifdef EXPHOTON_EMBREE
constexpr bool kHasEmbree = true;
#else
constexpr bool kHasEmbree = false;
#endif

// Embree's triangle test may miss a triangle that a ray only touches, as its documentation states,
// so a few pixels may differ. Photons would spread such a difference over the picture.
std::string BrokenByEmbree(const SceneModel& scene) {
  if (!kHasEmbree) return "";
  constexpr int kMaxPixels = 3;
  Variation variation{.name = "", .integrator = "\"directlighting\""};
  const Image truth = Rendered(scene, variation);
  variation.accelerator = "embree";
  const Image image = Rendered(scene, variation);
  int count = 0;
  for (int y = 0; y < image.Height(); ++y)
    for (int x = 0; x < image.Width(); ++x) count += image.At(x, y, 0) != truth.At(x, y, 0);
  if (count <= kMaxPixels) return "";
  return "with directlighting " + std::to_string(count) +
         " pixels differ between bvh and embree: " + Difference(truth, image);
}

}  // namespace

std::string BrokenInvariance(const SceneModel& scene) {
  try {
    const Image base = Rendered(scene, {.name = "base"});
    if (const std::string bad = BadPixel(base); !bad.empty()) return bad;
    const std::vector<Variation> joint{
        {.name = "", .effects = "all", .threads = 7, .tileSize = 3, .accelerator = "kdtree"},
        {.name = "",
         .threads = 2,
         .tileSize = 5,
         .accelerator = "bruteforce",
         .keepsLastElements = false}};
    for (const Variation& variation : joint)
      if (!Difference(base, Rendered(scene, variation)).empty()) return Culprit(scene, base);
    return BrokenByEmbree(scene);
  } catch (const std::exception& error) {
    return std::string("an error: ") + error.what();
  }
}

}  // namespace exphoton::random_scenes
