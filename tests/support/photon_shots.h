// SPDX-License-Identifier: BSD-2-Clause
// ShootPhotons shoots photons into a scene without an integrator.
#pragma once

#include "core/base/log.h"
#include "core/base/parallel.h"
#include "core/base/progress.h"
#include "integrators/photon/shooting/photon_tracer.h"

namespace exphoton {

inline PhotonPassResult ShootPhotons(const Scene& scene, std::uint64_t seed,
                                     const PhotonTargets& targets,
                                     const PhotonSettings& settings = {}, int threadCount = 1) {
  ThreadPool threads(threadCount);
  Log log(Log::Level::Normal, Log::Sink::Memory);
  ProgressReporter progress(ProgressReporter::Mode::Quiet);
  Statistics statistics;
  PreprocessContext context{threads, seed, log, progress, statistics, false, nullptr, {}};
  return PhotonTracer(scene, settings, seed).Shoot(targets, context);
}

}  // namespace exphoton
