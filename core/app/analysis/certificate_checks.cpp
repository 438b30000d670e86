// SPDX-License-Identifier: BSD-2-Clause
#include "core/app/analysis/certificate_checks.h"

#include <algorithm>
#include <limits>

namespace exphoton::study {
namespace {

constexpr double kWidestBlock = 1 << 24;  // more than the width of any picture

// Returns the square of an error that a certificate states. `missing` is for errors that are not
// finite.
double SquareIn(const NamedValues& certificate, const char* name, double missing) {
  const double root = ValueOf(certificate, name, missing);
  return root * root;
}

CertificateCheck CheckOf(const Results& results, const SettingResult& setting,
                         const std::vector<std::size_t>& runs) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  CertificateCheck check;
  const double share = 1 / double(runs.size());
  for (const std::size_t run : runs) {
    const RunRow& row = results.runs[run];
    const int width = BlockWidth(row);
    const double lower = SquareIn(row.certificate, "blockBiasLower", 0),
                 upper = SquareIn(row.certificate, "blockBiasUpper", kInfinity);
    check.error += share * SquareIn(row.certificate, "error", kInfinity);
    check.lower += share * lower;
    check.upper += share * upper;
    check.leastWidth = check.leastWidth > 0 ? std::min(check.leastWidth, width) : width;
    check.mostWidth = std::max(check.mostWidth, width);
    const auto found = setting.blockBias.find(width);
    const Measured bias = found == setting.blockBias.end() ? Measured() : found->second;
    check.blockBias.value += share * bias.value;
    check.blockBias.error += share * bias.error;
    if (!bias.IsKnown()) continue;
    const double squared = std::max(bias.value, 0.);
    ++check.compared;
    check.contained += int(lower <= squared && squared <= upper);
  }
  return check;
}

}  // namespace

int BlockWidth(const RunRow& row) {
  return int(std::clamp(ValueOf(row.certificate, "blockWidth"), 0., kWidestBlock));
}

std::vector<CertificateCheck> CheckCertificates(const Results& results, const Analysis& analysis) {
  std::vector<CertificateCheck> checks;
  for (const Line& line : analysis.lines) {
    for (const std::size_t index : line.settings) {
      const SettingResult& setting = analysis.settings[index];
      std::vector<std::size_t> runs = setting.runs;
      std::erase_if(runs, [&](std::size_t run) { return BlockWidth(results.runs[run]) == 0; });
      if (runs.empty()) continue;
      checks.push_back(CheckOf(results, setting, runs));
      checks.back().setting = index;
    }
  }
  return checks;
}

}  // namespace exphoton::study
