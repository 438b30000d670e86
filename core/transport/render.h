// SPDX-License-Identifier: BSD-2-Clause
// Render: preprocess, then every pixel of the film on all threads. The picture depends on scene,
// integrator, sampler, filter, camera and seed only, never on threads, tiles or crop.
#pragma once

#include <atomic>
#include <cstdint>
#include <string>
#include <vector>

#include "core/base/log.h"
#include "core/base/parallel.h"
#include "core/base/progress.h"
#include "core/base/statistics.h"
#include "core/imaging/camera.h"
#include "core/imaging/film.h"
#include "core/sampling/filter.h"
#include "core/sampling/sampler.h"
#include "core/transport/integrator.h"

namespace exphoton {

enum class TileOrder { Scanline, Reversed };

struct RenderOptions {
  std::uint64_t seed = 0;
  int tileSize = 16;
  TileOrder tileOrder = TileOrder::Scanline;
  bool isStrict = false;              // a non-finite sample ends the render: throws Error(Internal)
  const std::atomic<bool>* stop = nullptr;  // set from outside (a signal): stop at the next pixel
  std::atomic<bool>* pixelsBegun = nullptr;  // set here once there may be something to keep
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
};

struct RenderResult {
  bool isComplete = true;  // false where stopped
  std::int64_t nonFiniteSamples = 0;  // dropped, counted as black
  std::vector<std::string> nonFiniteReports;  // the first few: pixel, sample, seed
};

RenderResult Render(const RenderJob& job, const RenderOptions& options);

}  // namespace exphoton
