// SPDX-License-Identifier: BSD-2-Clause
// MakeReport assembles the report's sections into one HTML page.
#include "core/app/report/report.h"

#include "core/app/report/page_sections.h"
#include "core/app/report/template.h"

namespace exphoton::study {

std::string MakeReport(const std::string& folder, const Results& results,
                       const Analysis& analysis) {
  const Html sections = PictureSection(folder, results, analysis) +
                        FrontSection(results, analysis) + PriceSection(results, analysis) +
                        PredictionSection(results, analysis) + BudgetSection(results) +
                        CertificateSection(results, analysis) + DoublingSection(results, analysis) +
                        BarSection(results, analysis) + MapSection(folder, results) +
                        SettingSection(results, analysis) + MachineSection(results, analysis);
  return Fill("page", {{"title", results.title},
                       {"style", PageStyle()},
                       {"opening", Opening(folder, results, analysis)},
                       {"sections", sections},
                       {"program", results.program}})
      .Markup();
}

}  // namespace exphoton::study
