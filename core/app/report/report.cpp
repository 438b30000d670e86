// SPDX-License-Identifier: BSD-2-Clause
// MakeReport assembles the report's sections into one HTML page.
#include "core/app/report/report.h"

#include "core/app/report/page_sections.h"
#include "core/app/report/template.h"

namespace exphoton::study {

std::string MakeReport(const std::string& folder, const Results& results,
                       const Analysis& analysis) {
  const Html sections = HeadlineSection(results, analysis) + CurveSection(results, analysis) +
                        BarSection(results, analysis) + PictureSection(folder, results, analysis) +
                        PriceSection(results, analysis) + MapSection(folder, results) +
                        DataSection(results, analysis);
  return Fill("page", {{"title", results.title},
                       {"style", PageStyle()},
                       {"sections", sections},
                       {"program", results.program}})
      .Markup();
}

}  // namespace exphoton::study
