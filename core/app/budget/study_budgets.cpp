// SPDX-License-Identifier: BSD-2-Clause
#include "core/app/budget/study_budgets.h"

#include <algorithm>

#include "core/app/budget/budget_text.h"
#include "core/app/study/study_runner.h"

namespace exphoton::cli {
namespace {

constexpr const char* kWithBudget[] = {"exphotonmap", "photonmap"};

study::BudgetRecord BudgetOf(const std::string& integrator, const StudyOptions& options) {
  std::vector<std::string> arguments =
      RenderArguments(options, options.scene, {"", integrator, {}}, 0);
  arguments.erase(arguments.begin());  // the name of the command
  BudgetOptions budget;
  budget.showsProgress = false;
  FileSource::Streams streams;
  const MeasuredBudget measured =
      MeasureBudget(ParseRenderCommand(arguments, RenderMode::Render), budget, &streams);
  return {integrator, BudgetHeadline(measured), BudgetRows(measured, budget.seeds),
          BudgetNotes(measured, budget)};
}

}  // namespace

std::vector<study::BudgetRecord> MeasureBudgets(const StudyOptions& options,
                                                const std::vector<study::Setting>& settings) {
  std::vector<study::BudgetRecord> budgets;
  for (const std::string integrator : kWithBudget) {
    if (std::ranges::find(settings, integrator, &study::Setting::integrator) == settings.end())
      continue;
    Say(options, "error budget of " + integrator);
    try {
      budgets.push_back(BudgetOf(integrator, options));
    } catch (const LoadingStopped&) {
      throw StudyInterrupted();
    }
  }
  return budgets;
}

}  // namespace exphoton::cli
