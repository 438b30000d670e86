// SPDX-License-Identifier: BSD-2-Clause
// LoadScenes: a scene file to all that is needed to render it. A file may hold several scenes, one
// after the other. No globals: any number of scenes can live in one process.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/imaging/film/camera.h"
#include "core/imaging/film/film.h"
#include "core/parser/syntax/scene_limits.h"
#include "core/parser/syntax/source.h"
#include "core/sampling/filter.h"
#include "core/sampling/sampler.h"
#include "core/scene/scene.h"
#include "core/transport/integrator.h"
#include "core/transport/volume_integrator.h"

namespace exphoton {

class Log;

// How LookAt is meant: version 2 mirrors it, and its scenes begin with Scale -1 1 1.
enum class Dialect { V1, V2 };

// One --set Directive.parameter=value.
struct ParameterOverride {
  std::string directive, parameter, value;
};

struct LoadOptions {
  std::vector<std::string> pluginFolders;  // as PluginRegistry::DefaultFolders gives them
  bool allowsScenePlugins = false;         // folders that a scene file names are searched, too
  bool isStrict = false;                   // unknown parameters are errors
  Dialect dialect = Dialect::V1;
  SceneLimits limits;
  int threads = 1;  // that may build accelerators; 0: as many as there are cores
  const std::atomic<bool>* stop = nullptr;  // set from outside: loading throws LoadingStopped

  // What replaces the file's own words.
  std::optional<std::string> integrator;
  std::vector<ParameterOverride> parameters;
  std::optional<std::vector<Real>> cropWindow;  // x0 x1 y0 y1
  std::optional<PixelBounds> pixelBounds;       // wins over a crop window
  std::optional<std::int64_t> samplesPerPixel;
  std::string effects = "auto";  // auto, all, or a list: "caustics=off,lens=on"
  bool isQuick = false;          // a quarter of the resolution, 1 sample, a tenth of the photons
};

struct LoadingStopped {};

struct RenderSetup {
  std::string sceneName;  // the file
  std::unique_ptr<Scene> scene;
  std::unique_ptr<SurfaceIntegrator> integrator;
  std::unique_ptr<VolumeIntegrator> volumeIntegrator;  // null where there is no medium
  std::unique_ptr<Sampler> sampler;
  std::unique_ptr<Filter> filter;
  std::unique_ptr<Camera> camera;
  FilmSettings film;
  PixelBounds crop;  // the pixels to render
  std::string integratorName, samplerName, filterName, cameraName, acceleratorName;
  // The scene's own file, those that it includes and those that its parameters name; sorted.
  std::vector<std::string> inputFiles;
  std::vector<std::string> plugins;                          // "integrators/exphotonmap", sorted
  double acceleratorSeconds = 0, acceleratorCpuSeconds = 0;  // of building it, while loading
  std::uint64_t sceneHash = 0;  // of what the file says, whatever its layout
};

// The place of errors in what the command line says: SourceLocation::file of them.
inline constexpr const char* kCommandLinePlace = "<command line>";

// Throws Error; renders nothing. The objects refer to `log`, which must outlive them.
std::vector<std::unique_ptr<RenderSetup>> LoadScenes(SceneSource& source, const std::string& path,
                                                     const LoadOptions& options, Log& log);

}  // namespace exphoton
