// SPDX-License-Identifier: BSD-2-Clause
// LoadSceneText and RenderSceneText load and render scenes from text.
#include "tests/support/test_scene.h"

#include <limits>
#include <stdexcept>

#include "core/base/log.h"
#include "core/imaging/film/film.h"

namespace exphoton {

bool TestRender::Says(const std::string& part) const {
  for (const std::string& message : messages)
    if (message.find(part) != std::string::npos) return true;
  return false;
}

double TestRender::Counter(const std::string& name) const {
  for (const Statistics::Counter& counter : counters)
    if (counter.name == name) return counter.value;
  return std::numeric_limits<double>::quiet_NaN();
}

LoadedScene LoadSceneText(const std::string& text, LoadOptions options) {
  LoadedScene loaded;
  loaded.log = std::make_unique<Log>(Log::Level::Normal, Log::Sink::Memory);
  options.pluginFolders.push_back(std::string(EXPHOTON_BINARY_DIR) + "/plugins");
  MemorySource source({{"test.pbrt", text}});
  auto scenes = LoadScenes(source, "test.pbrt", options, *loaded.log);
  if (scenes.empty()) throw std::runtime_error("the text holds no scene");
  loaded.setup = std::move(scenes.front());
  return loaded;
}

TestRender RenderLoaded(LoadedScene& scene, const TestRenderOptions& options) {
  RenderSetup& setup = *scene.setup;
  Film film(setup.film.Full(), setup.crop);
  ThreadPool threads(options.threads);
  ProgressReporter progress(ProgressReporter::Mode::Quiet);
  Statistics statistics;
  RenderOptions renderOptions;
  renderOptions.seed = options.seed;
  renderOptions.tileSize = options.tileSize;
  renderOptions.sharingMemory = options.sharingMemory;
  renderOptions.tileOrder = options.tileOrder;
  renderOptions.isStrict = options.isStrict;
  renderOptions.footprintSamples = options.footprintSamples;
  renderOptions.stop = options.stop;
  renderOptions.corrections = options.corrections;
  std::optional<AovFilm> aovs;
  if (!options.aovs.IsEmpty()) renderOptions.aovs = &aovs.emplace(setup.crop, options.aovs);

  TestRender render;
  render.result =
      Render({*setup.scene, *setup.integrator, *setup.sampler, *setup.filter, *setup.camera, film,
              threads, *scene.log, progress, statistics, setup.volumeIntegrator.get()},
             renderOptions);
  render.image = film.ToImage(setup.film.premultiplyAlpha);
  for (int y = setup.crop.y0; y < setup.crop.y1; ++y)
    for (int x = setup.crop.x0; x < setup.crop.x1; ++x)
      for (int channel = 0; channel < 3; ++channel)
        render.values.push_back(film.MeanOf({x, y})[std::size_t(channel)]);
  if (aovs) aovs->AppendTo(film, setup.film.premultiplyAlpha, &render.image);
  render.messages = scene.log->Messages();
  render.counters = statistics.Counters();
  render.rays = statistics.Rays();
  return render;
}

TestRender RenderSceneText(const std::string& text, const TestRenderOptions& options) {
  LoadedScene scene = LoadSceneText(text, options.load);
  return RenderLoaded(scene, options);
}

double MeanRadiance(const Image& image, const PixelBounds& region) {
  double sum = 0;
  for (const char* name : {"R", "G", "B"}) {
    const int channel = image.FindChannel(name);
    for (int y = region.y0; y < region.y1; ++y)
      for (int x = region.x0; x < region.x1; ++x) sum += double(image.At(x, y, channel));
  }
  return sum / (3.0 * region.Width() * region.Height());
}

double MeanRadiance(const Image& image) {
  return MeanRadiance(image, {0, 0, image.Width(), image.Height()});
}

double MeanChannel(const Image& image, const std::string& channel) {
  const int index = image.FindChannel(channel);
  if (index < 0) throw std::invalid_argument("the picture has no channel " + channel);
  double sum = 0;
  for (int y = 0; y < image.Height(); ++y)
    for (int x = 0; x < image.Width(); ++x) sum += double(image.At(x, y, index));
  return sum / (double(image.Width()) * image.Height());
}

std::string TestHeader(const std::string& integrator, int width, int height, int samples) {
  return "SurfaceIntegrator " + integrator + "\nFilm \"image\" \"integer xresolution\" [" +
         std::to_string(width) + "] \"integer yresolution\" [" + std::to_string(height) +
         "]\nPixelFilter \"box\"\nSampler \"lowdiscrepancy\" \"integer pixelsamples\" [" +
         std::to_string(samples) + "]\nCamera \"perspective\" \"float fov\" [90]\n";
}

std::string FurnaceWorld(double emission, const std::string& material) {
  const std::string e = std::to_string(emission);
  return "WorldBegin\nMaterial " + material + "\nAreaLightSource \"area\" \"color L\" [" + e + " " +
         e + " " + e + "]\nReverseOrientation\nShape \"sphere\" \"float radius\" [1]\nWorldEnd\n";
}

}  // namespace exphoton
