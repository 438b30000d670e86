// SPDX-License-Identifier: BSD-2-Clause
// PilotRenders renders a scene small, in child processes, and makes a PriceModel of one integrator.
#pragma once

#include <string>
#include <vector>

#include "core/app/quote/mean_light.h"
#include "core/app/quote/price_model.h"
#include "core/app/study/study_scene.h"

namespace exphoton::cli {

struct QuoteScene {
  std::string path;
  int width = 0, height = 0;         // of the picture that is quoted
  std::string resolution;            // as the user gave it; "": of the scene
  std::vector<std::string> options;  // of all renders: --set, --plugin-dir and others
};

// Returns the scene with the options of all its renders.
QuoteScene MakeQuoteScene(const StudyOptions& options, const SceneFacts& facts);

// What pilots found about one integrator.
struct Quote {
  std::string integrator;
  PriceModel model;
  MeanLight light;                                 // of the last pilot
  double memory = 0;                               // bytes, of the picture that is quoted
  double indirectPhotons = 0, causticPhotons = 0;  // as the scene has them; 0: none
  std::vector<std::string> notCovered;             // by the estimate of the bias
  std::string failure;                             // why there is no quote; "": there is one
};

// Renders pilots for about this number of seconds, at least two. Throws Interrupted.
struct QuoteInterrupted {};
Quote RunPilots(const QuoteScene& scene, const std::string& integrator, bool hasBias,
                double seconds);

}  // namespace exphoton::cli
