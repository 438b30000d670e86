// SPDX-License-Identifier: BSD-2-Clause
// RenderSceneText renders a small scene from text, in process, to an Image. It is for tests of
// whole integrators against closed forms. TestHeader and FurnaceWorld return common scene texts.
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
  LoadOptions load;  // integrator, samplesPerPixel, effects ...; the plugin folder is added
  int tileSize = 16;
  double sharingMemory = 0x1p28;
  TileOrder tileOrder = TileOrder::Scanline;
  std::int64_t footprintSamples = 0;   // as in RenderOptions
  bool isStrict = true;                // a non-finite sample throws
  Corrections* corrections = nullptr;  // as in RenderOptions; the render is one pass
  AovSet aovs;                         // appended to the image's channels
  const std::atomic<bool>* stop = nullptr;
};

struct TestRender {
  Image image;                 // R, G, B, A
  std::vector<double> values;  // R, G, B of each pixel, before they are rounded to float
  RenderResult result;
  std::vector<std::string> messages;  // warnings and notices
  std::vector<Statistics::Counter> counters;
  RayCounters rays;

  bool Says(const std::string& part) const;       // whether a message contains `part`
  double Counter(const std::string& name) const;  // NaN if there is none
};

// LoadedScene is a scene made from text with its log, for tests that inspect it.
struct LoadedScene {
  std::unique_ptr<Log> log;
  std::unique_ptr<RenderSetup> setup;
};
LoadedScene LoadSceneText(const std::string& text, LoadOptions options = {});

// Renders the first scene of the text.
TestRender RenderSceneText(const std::string& text, const TestRenderOptions& options = {});
TestRender RenderLoaded(LoadedScene& scene, const TestRenderOptions& options = {});

// Returns the mean of R, G and B over the image, or over pixels [x0,x1) x [y0,y1) counted from the
// image's corner.
double MeanRadiance(const Image& image);
double MeanRadiance(const Image& image, const PixelBounds& region);
// Returns the mean of one channel ("R").
double MeanChannel(const Image& image, const std::string& channel);

// Returns the options and camera of a width x height picture with a box filter, without WorldBegin.
// The camera is at the origin, looks along +z, and has a field of view of 90 degrees.
std::string TestHeader(const std::string& integrator, int width, int height, int samples);

// Returns a closed sphere of radius 1 about the origin. It emits `emission` on its inside and
// reflects `material` (a Material directive without the word: "\"matte\" \"color Kd\" [.5 .5 .5]").
// Radiance is emission / (1 - albedo) everywhere.
std::string FurnaceWorld(double emission, const std::string& material);

}  // namespace exphoton
