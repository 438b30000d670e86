// SPDX-License-Identifier: BSD-2-Clause
// LoadScenes reads a scene file and makes every object needed to render it. A file can hold several
// scenes in sequence. There are no globals, so one process can hold any number of scenes.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/imaging/film/camera.h"
#include "core/imaging/film/film.h"
#include "core/params/param_set.h"
#include "core/params/param_table.h"
#include "core/parser/syntax/directive.h"
#include "core/parser/syntax/scene_limits.h"
#include "core/parser/syntax/source.h"
#include "core/sampling/filter.h"
#include "core/sampling/sampler.h"
#include "core/scene/scene.h"
#include "core/scene/scene_names.h"
#include "core/transport/integrator.h"
#include "core/transport/volume_integrator.h"

namespace exphoton {

class Log;

// One --set Directive.parameter=value.
struct ParameterOverride {
  std::string directive, parameter, value;
};

struct RenderSetup;

struct LoadOptions {
  std::vector<std::string> pluginFolders;  // as PluginRegistry::DefaultFolders returns them
  bool allowsScenePlugins = false;         // also search plugin folders that a scene file names
  bool isStrict = false;                   // unknown parameters are errors
  std::optional<Dialect> dialect;          // absent: recognised by the directives
  SceneLimits limits;
  int threads = 1;                          // for building accelerators; 0: one per core
  const std::atomic<bool>* stop = nullptr;  // set from outside: loading throws LoadingStopped

  // These options replace values from the file.
  std::optional<std::string> integrator;
  // These plugins have default parameters, except that a camera keeps the parameters that it
  // declares and a sampler the number of samples per pixel.
  std::optional<std::string> sampler, filter, camera, accelerator;
  std::vector<ParameterOverride> parameters;
  // Integrators that one command compares. A parameter of SurfaceIntegrator applies to those of
  // them that declare it, and is ignored for the others.
  std::vector<std::string> comparedIntegrators;
  std::optional<std::vector<Real>> cropWindow;  // x0 x1 y0 y1
  std::optional<PixelBounds> pixelBounds;       // takes precedence over a crop window
  // The resolution in which pixelBounds counts. Absent: the one of the picture. Otherwise the
  // bounds become the pixels of the picture that they touch, which are at least one.
  std::optional<Point2i> boundsResolution;
  std::optional<std::int64_t> samplesPerPixel;
  std::optional<int> frame;      // its number goes into the picture's name, in the place of %d
  Real timeOffset = 0;           // the shutter opens and closes later by this
  std::string effects = "auto";  // auto, all, or a list: "caustics=off,lens=on"
  bool isQuick = false;  // a quarter of the resolution, 1 sample, fewer photons (overrides.h)

  // If not null, a setup of the same file, which must have its scene. The file is not read again:
  // the scene and its names move to the new setup, and the other objects are made from the
  // directives of the known one. Integrators of the known setup still refer to the scene.
  RenderSetup* known = nullptr;
  // Receives messages about the text and the world. Null: they go where all others go. There are
  // none with a known setup.
  Log* sceneLog = nullptr;
};

struct LoadingStopped {};

struct RenderSetup {
  std::string sceneName;  // path of the scene file
  std::unique_ptr<Scene> scene;
  SceneNames names;
  std::unique_ptr<SurfaceIntegrator> integrator;
  std::unique_ptr<VolumeIntegrator> volumeIntegrator;  // null if the scene has no medium
  std::unique_ptr<Sampler> sampler;
  std::unique_ptr<Filter> filter;
  std::unique_ptr<Camera> camera;
  FilmSettings film;
  PixelBounds crop;               // the pixels to render
  ParamSet filterParameters;      // to make the filter again
  ParamSet integratorParameters;  // those that are given
  std::string integratorName, samplerName, filterName, cameraName, acceleratorName;
  // The scene file, its included files and the files that parameters name; sorted.
  std::vector<std::string> inputFiles;
  std::vector<std::string> plugins;       // "integrators/exphotonmap", sorted
  std::vector<std::string> worldPlugins;  // of these, those of the scene
  // The directives outside the world, with WorldBegin and WorldEnd.
  std::shared_ptr<const std::vector<Directive>> outside;
  double acceleratorSeconds = 0, acceleratorCpuSeconds = 0;  // spent on building while loading
  std::uint64_t sceneHash = 0;  // of the directives; independent of layout and comments
  // Of the directives that decide where light goes: the world, the times of its transformations
  // and the volume integrator. Camera, film, sampler and integrator have no influence.
  std::uint64_t worldHash = 0;
  Dialect dialect = Dialect::V1;  // that was given or recognised
};

// SourceLocation::file of errors in command-line values.
inline constexpr const char* kCommandLineLocation = "<command line>";

// Throws Error. Does not render. The returned objects refer to `log`, which must outlive them.
std::vector<std::unique_ptr<RenderSetup>> LoadScenes(SceneSource& source, const std::string& path,
                                                     const LoadOptions& options, Log& log);

}  // namespace exphoton
