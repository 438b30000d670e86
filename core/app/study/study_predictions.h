// SPDX-License-Identifier: BSD-2-Clause
// Predict quotes the integrators of a study before it renders.
#pragma once

#include <vector>

#include "core/app/analysis/predictions.h"
#include "core/app/study/study_scene.h"

namespace exphoton::cli {

// Returns the quotes of all integrators of the settings, with the scene's own parameters, for
// errors from 50 to .5 %. Pilots take about five seconds. Throws StudyInterrupted.
std::vector<study::Prediction> Predict(const StudyOptions& options,
                                       const std::vector<study::Setting>& settings);

}  // namespace exphoton::cli
