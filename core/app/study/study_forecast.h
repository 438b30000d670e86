// SPDX-License-Identifier: BSD-2-Clause
// ForecastText estimates how long a study takes, by rendering small parts of some of its pictures
// for a few seconds.
#pragma once

#include <string>
#include <vector>

#include "core/app/study/study_scene.h"

namespace exphoton::cli {

// Returns lines such as "32 renders (8 settings, 4 seeds each)" and "about 12 min in all". Settings
// with a time limit need no estimate. Writes only temporary files. Throws StudyInterrupted.
std::string ForecastText(const StudyOptions& options, const SceneFacts& scene,
                         const std::vector<study::Setting>& settings);

}  // namespace exphoton::cli
