// SPDX-License-Identifier: BSD-2-Clause
// Renders small scenes from text, in process, to an Image: for tests of whole integrators against
// closed forms. The text is what a scene file says; furnace scenes and the like are made here.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/statistics.h"
#include "core/imaging/image.h"
#include "core/parser/render_setup.h"
#include "core/render/render.h"

namespace exphoton {

struct TestRenderOptions {
  std::uint64_t seed = 1;
  int threads = 1;
  LoadOptions load;  // integrator, samplesPerPixel, effects ...; the plugin folder is filled in
  int tileSize = 16;
  TileOrder tileOrder = TileOrder::Scanline;
  std::int64_t footprintSamples = 0;  // RenderOptions
  bool isStrict = true;               // a non-finite sample throws
  AovSet aovs;                        // appended to the image's channels
  const std::atomic<bool>* stop = nullptr;
};

struct TestRender {
  Image image;  // R, G, B, A
  RenderResult result;
  std::vector<std::string> messages;  // warnings and notices
  std::vector<Statistics::Counter> counters;
  RayCounters rays;

  bool Says(const std::string& part) const;       // whether a message contains it
  double Counter(const std::string& name) const;  // NaN where there is none
};

// A scene made from text, and what it said; for tests that look into it.
struct LoadedScene {
  std::unique_ptr<Log> log;
  std::unique_ptr<RenderSetup> setup;
};
LoadedScene LoadSceneText(const std::string& text, LoadOptions options = {});

// The first scene of the text.
TestRender RenderSceneText(const std::string& text, const TestRenderOptions& options = {});
TestRender RenderLoaded(LoadedScene& scene, const TestRenderOptions& options = {});

// Mean of R, G and B over the image, or over pixels [x0,x1) x [y0,y1) counted from its corner.
double MeanRadiance(const Image& image);
double MeanRadiance(const Image& image, const PixelBounds& region);
// Mean of one channel ("R").
double MeanChannel(const Image& image, const std::string& channel);

// Options and camera of a width x height picture with a box filter, up to and without WorldBegin.
// The camera stands at the origin, looks along +z, and has a field of view of 90 degrees.
std::string TestHeader(const std::string& integrator, int width, int height, int samples);

// A closed sphere of radius 1 about the origin that emits `emission` on its inside and reflects
// `material` (a Material directive without the word: "\"matte\" \"color Kd\" [.5 .5 .5]").
// Radiance is emission / (1 - albedo) everywhere.
std::string FurnaceWorld(double emission, const std::string& material);

}  // namespace exphoton
