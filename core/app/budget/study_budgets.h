// SPDX-License-Identifier: BSD-2-Clause
// MeasureBudgets makes the error budgets of a study.
#pragma once

#include <vector>

#include "core/app/analysis/budget_record.h"
#include "core/app/study/study_scene.h"

namespace exphoton::cli {

// Returns the budgets of photonmap and exphotonmap, where settings have them, with the scene's own
// parameters. Throws Error and StudyInterrupted.
std::vector<study::BudgetRecord> MeasureBudgets(const StudyOptions& options,
                                                const std::vector<study::Setting>& settings);

}  // namespace exphoton::cli
