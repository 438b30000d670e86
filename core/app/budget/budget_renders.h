// SPDX-License-Identifier: BSD-2-Clause
// MeasureBudget renders a scene small, with several seeds and with settings that differ from the
// scene's in one cause of error each, and makes its ErrorBudget. Everything but the seconds depends
// on scene, options and seed only.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/app/budget/error_budget.h"
#include "core/app/options/options.h"
#include "core/parser/syntax/source.h"
#include "core/render/certificate/certificate.h"

namespace exphoton::cli {

struct BudgetOptions {
  int seeds = 8;                      // at least 3
  std::int64_t referenceSamples = 0;  // a pixel, by guidedpath; 0: a certificate is the measure
  int blockWidth = 0;                 // as in MakeBudget
  bool showsProgress = true;
  Log* log = nullptr;  // receives the messages about the scene; null: they are not shown
};

// CPU seconds of one small picture, by the clock.
struct BudgetCosts {
  double maps = 0;                // one set of photon maps
  double camera = 0, rays = 0;    // samples without gather rays, and the gather rays
  double causticMap = 0;          // the caustic map's part of `maps`
  double sharing = 0;             // samples that replace sharing, for the same noise
  double depth = 0, effects = 0;  // added by deeper paths, and by all effects
  double lowerBound = 0;          // maps, one camera sample and one gather ray a pixel

  double Total() const { return maps + camera + rays; }
};

struct MeasuredBudget {
  std::string integrator;
  int width = 0, height = 0;
  std::int64_t samples = 0;  // a pixel
  ErrorBudget budget;
  MeasuredError measured;  // against the reference, or by the certificate
  bool isByReference = false;
  BudgetCosts costs;
};

// Throws Error, and LoadingStopped after a signal.
MeasuredBudget MeasureBudget(const RenderCommand& command, const BudgetOptions& options,
                             FileSource::Streams* streams);

}  // namespace exphoton::cli
