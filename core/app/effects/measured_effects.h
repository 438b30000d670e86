// SPDX-License-Identifier: BSD-2-Clause
// MeasureEffects renders a scene small, with all required effects and without each of them, to show
// what the effects change in the picture and what they cost (exphoton explain --measure).
#pragma once

#include <string>
#include <vector>

#include "core/app/effects/light_parts.h"
#include "core/app/options/options.h"
#include "core/parser/syntax/source.h"

namespace exphoton::cli {

struct MeasuredEffect {
  std::string name;
  double light = 0;       // that the effect adds, relative to the light of the picture
  double lightError = 0;  // standard error
  double change = 0;      // root of relMSE between the pictures, without their noise
  double time = 0;        // share of wholeSeconds; negative: the effect saves time
};

struct MeasuredEffects {
  int width = 0, height = 0;
  int samples = 0;          // a pixel
  double wholeSeconds = 0;  // estimated CPU time of the picture of the scene
  std::vector<MeasuredEffect> effects;
  std::vector<MeasuredLight> parts;  // empty: the integrator does not divide its light
};

// Throws Error, and LoadingStopped after a signal.
MeasuredEffects MeasureEffects(const RenderCommand& command, const std::string& scene,
                               FileSource::Streams* streams);

// Returns lines in the form of ExplainText.
std::string MeasuredText(const MeasuredEffects& measured);

}  // namespace exphoton::cli
