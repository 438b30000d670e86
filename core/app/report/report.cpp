// SPDX-License-Identifier: BSD-2-Clause
// MakeReport assembles the report's sections into one HTML page.
#include "core/app/report/report.h"

#include "core/app/report/markup.h"
#include "core/app/report/page_sections.h"

namespace exphoton::study {

std::string MakeReport(const std::string& folder, const Results& results,
                       const Analysis& analysis) {
  return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>" +
         Escape(results.title) +
         ": what accuracy costs in time</title>\n<link rel=\"icon\" href=\"data:,\">\n<style>" +
         PageStyle() + "</style>\n</head>\n<body>\n<main>\n" + HeadlineSection(results, analysis) +
         CurveSection(results, analysis) + BarSection(results, analysis) +
         PictureSection(folder, results, analysis) + PriceSection(results, analysis) +
         MapSection(folder, results) + DataSection(results, analysis) + "<footer>Made by " +
         Escape(results.program) + " study.</footer>\n</main>\n</body>\n</html>\n";
}

}  // namespace exphoton::study
