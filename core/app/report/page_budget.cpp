// SPDX-License-Identifier: BSD-2-Clause
// This file makes the section with the error budgets of a study.
#include "core/app/report/page_sections.h"

namespace exphoton::study {
namespace {

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
  for (const BudgetRecord& budget : results.budgets) tables += BudgetTable(budget);
  return Fill("budget-section", {{"tables", tables}});
}

}  // namespace exphoton::study
