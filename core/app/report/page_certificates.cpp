// SPDX-License-Identifier: BSD-2-Clause
// This file makes the section that puts certificates (study --certify) beside measured errors. It
// shows errors as roots of parts of relMSE in per cent, as a render states them.
#include <algorithm>
#include <cmath>

#include "core/app/analysis/certificate_checks.h"
#include "core/app/analysis/numbers.h"
#include "core/app/report/page_sections.h"
#include "core/app/report/page_tables.h"

namespace exphoton::study {
namespace {

double RootPercent(double squared) { return 100 * std::sqrt(std::max(squared, 0.)); }

// Returns the root in per cent. Its standard error is the distance to the root of the value plus
// the standard error, which is known where the value is 0, too.
Html RootCell(const Measured& squared) {
  if (!squared.IsKnown()) return MeasuredCell(squared);
  const double root = RootPercent(squared.value);
  return MeasuredCell({root, RootPercent(std::max(squared.value, 0.) + squared.error) - root});
}

std::string StatedText(double squared) {
  return std::isfinite(squared) ? ShortNumber(RootPercent(squared)) : "unknown";
}

std::string EndsText(const CertificateCheck& check) {
  return ShortNumber(RootPercent(check.lower)) + " to " +
         (std::isfinite(check.upper) ? ShortNumber(RootPercent(check.upper)) : "no known end");
}

std::string WidthText(int least, int most) {
  return std::to_string(least) + (most > least ? " to " + std::to_string(most) : "");
}

std::string CountOf(int contained, int compared) {
  return std::to_string(contained) + " of " + std::to_string(compared);
}

// Returns how often the intervals contain the measured bias.
std::string CoverageText(const std::vector<CertificateCheck>& checks) {
  int compared = 0, contained = 0, least = checks.front().leastWidth, most = 0;
  for (const CertificateCheck& check : checks) {
    compared += check.compared;
    contained += check.contained;
    least = std::min(least, check.leastWidth);
    most = std::max(most, check.mostWidth);
  }
  if (compared == 0) return "not compared, because the bias is not known";
  return CountOf(contained, compared) + " intervals contain the measured bias of blocks " +
         WidthText(least, most) + " pixels wide";
}

Html CertificateRow(const Analysis& analysis, const CertificateCheck& check,
                    const ParameterColumns& columns) {
  const SettingResult& setting = analysis.settings[check.setting];
  const Measured error = analysis.hasReference ? setting.cost.error : Measured();
  return Fill("certificate-row",
              {{"line", LineCell(analysis, check.setting)},
               {"parameters", columns.Cells(setting)},
               {"error", RootCell(error)},
               {"stated", StatedText(check.error)},
               {"bias", RootCell(setting.separation.bias2)},
               {"width", WidthText(check.leastWidth, check.mostWidth)},
               {"blockBias", RootCell(check.blockBias)},
               {"interval", EndsText(check)},
               {"contained", check.compared > 0 ? CountOf(check.contained, check.compared) : "–"}});
}

}  // namespace

Html CertificateSection(const Results& results, const Analysis& analysis) {
  const std::vector<CertificateCheck> checks = CheckCertificates(results, analysis);
  if (checks.empty()) return {};
  std::vector<std::size_t> shown;
  for (const CertificateCheck& check : checks) shown.push_back(check.setting);
  const ParameterColumns columns(results, analysis, shown);
  Html rows;
  for (const CertificateCheck& check : checks) rows += CertificateRow(analysis, check, columns);
  return Fill("certificate-section",
              {{"summary", CoverageText(checks)}, {"parameters", columns.Heads()}, {"rows", rows}});
}

}  // namespace exphoton::study
