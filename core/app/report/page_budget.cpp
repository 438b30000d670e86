// SPDX-License-Identifier: BSD-2-Clause
// This file makes the section with the error budgets of a study.
#include <algorithm>

#include "core/app/report/page_sections.h"

namespace exphoton::study {
namespace {

// Returns whether the study has measured a lower bound for its own pictures. The page then leaves
// out the bound in the budget, which is for a small picture.
bool HasLowerBound(const Results& results, const std::string& integrator) {
  return std::ranges::any_of(results.lowerBounds, [&](const LowerBound& bound) {
    return results.settings[bound.setting].integrator == integrator;
  });
}

// Returns the budget without the texts on its lower bound.
BudgetRecord WithoutLowerBound(BudgetRecord budget) {
  const std::size_t bound = budget.headline.find(" times the lower bound");
  if (bound != std::string::npos) budget.headline.erase(budget.headline.rfind(',', bound));
  std::erase_if(budget.notes,
                [](const std::string& note) { return note.starts_with("the lower bound"); });
  budget.notes.push_back(
      "the line below the headline has the lower bound of the time for the study's own pictures");
  return budget;
}

Html BudgetTable(const BudgetRecord& budget) {
  Html rows, notes;
  for (const BudgetRecord::Row& row : budget.rows)
    rows += Fill("budget-row", {{"name", row.name},
                                {"value", row.value},
                                {"width", row.halfWidth},
                                {"share", row.share},
                                {"halving", row.halving}});
  for (const std::string& note : budget.notes) notes += Fill("budget-note", {{"text", note}});
  return Fill("budget", {{"integrator", budget.integrator},
                         {"headline", budget.headline},
                         {"rows", rows},
                         {"notes", notes}});
}

}  // namespace

Html BudgetSection(const Results& results) {
  if (results.budgets.empty()) return {};
  Html tables;
  for (const BudgetRecord& budget : results.budgets)
    tables +=
        BudgetTable(HasLowerBound(results, budget.integrator) ? WithoutLowerBound(budget) : budget);
  return Fill("budget-section", {{"tables", tables}});
}

}  // namespace exphoton::study
