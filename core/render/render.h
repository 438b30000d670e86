// SPDX-License-Identifier: BSD-2-Clause
// Render: preprocess, then every pixel of the film on all threads. The picture depends on scene,
// integrator, sampler, filter, camera and seed only, never on threads, tiles or crop.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/base/log.h"
#include "core/base/parallel.h"
#include "core/base/progress.h"
#include "core/base/statistics.h"
#include "core/imaging/film/aov_film.h"
#include "core/imaging/film/camera.h"
#include "core/imaging/film/film.h"
#include "core/sampling/filter.h"
#include "core/sampling/sampler.h"
#include "core/transport/integrator.h"
#include "core/transport/volume_integrator.h"

namespace exphoton {

enum class TileOrder { Scanline, Reversed };

struct RenderOptions {
  std::uint64_t seed = 0;
  int tileSize = 16;
  TileOrder tileOrder = TileOrder::Scanline;
  bool isStrict = false;  // a non-finite sample ends the render: throws Error(Internal)
  const std::atomic<bool>* stop = nullptr;   // set from outside (a signal): stop at the next pixel
  std::atomic<bool>* pixelsBegun = nullptr;  // set here once there may be something to keep
  AovFilm* aovs = nullptr;                   // filled beside the film; null: no aov was asked for
  // Textures are filtered, and bumps differenced, over the footprint that a sample has when a pixel
  // takes this number of samples; 0: the number that the sampler takes. Renders that are compared
  // need the same footprint.
  std::int64_t footprintSamples = 0;
};

struct RenderJob {
  const Scene& scene;
  SurfaceIntegrator& integrator;
  const Sampler& sampler;
  const Filter& filter;
  const Camera& camera;
  Film& film;
  ThreadPool& threads;
  Log& log;
  ProgressReporter& progress;
  Statistics& statistics;
  VolumeIntegrator* volume = nullptr;  // light that media add; null: none
};

struct RenderResult {
  bool isComplete = true;                     // false where stopped
  std::int64_t nonFiniteSamples = 0;          // dropped, counted as black
  std::vector<std::string> nonFiniteReports;  // the first few: pixel, sample, seed
};

RenderResult Render(const RenderJob& job, const RenderOptions& options);

// One pass over the image: which samples of each pixel, and by which random numbers.
struct RenderPass {
  std::uint64_t preprocessSeed = 0;  // of photons
  std::uint64_t sampleSeed = 0;      // of camera samples
  std::int64_t firstSample = 0, sampleCount = 0;
};

// Renders pass by pass. Passes may differ in everything that RenderPass says; statistics and
// complaints are of all of them together.
class PassRenderer {
 public:
  // The job's film is not used: each pass names its own. Both must outlive this.
  PassRenderer(const RenderJob& job, const RenderOptions& options);
  ~PassRenderer();

  // Preprocesses, and adds the pass's samples to the film. Messages of a preprocessing that was
  // done before with another seed are not repeated. False where stopped; then some pixels lack
  // samples.
  bool Run(const RenderPass& pass, const Sampler& sampler, Film* film);
  // Fills the job's statistics and says what went wrong. Once, at the end.
  RenderResult Finish();

  double PreprocessSeconds() const;  // wall, of the last pass
  double RenderSeconds() const;      // the same, without preprocessing

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace exphoton
