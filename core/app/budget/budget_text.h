// SPDX-License-Identifier: BSD-2-Clause
// BudgetText prints an error budget: a row for each cause, their sum beside the measured error, and
// the lower bound of the time.
#pragma once

#include <string>
#include <vector>

#include "core/app/analysis/budget_record.h"
#include "core/app/budget/budget_renders.h"

namespace exphoton::cli {

using BudgetRow = study::BudgetRecord::Row;

// Returns the parts, their sum, the measured error, and the difference between the two.
std::vector<BudgetRow> BudgetRows(const MeasuredBudget& budget, int seeds);

// Returns "error 6.1 % in 1.2 CPU s, 2.9 times the lower bound of 0.41 CPU s".
std::string BudgetHeadline(const MeasuredBudget& budget);

// Returns phrases about the measurement, for lines below the table.
std::vector<std::string> BudgetNotes(const MeasuredBudget& budget, const BudgetOptions& options);

std::string BudgetText(const std::string& scene, const MeasuredBudget& budget,
                       const BudgetOptions& options);

}  // namespace exphoton::cli
