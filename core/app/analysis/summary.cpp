// SPDX-License-Identifier: BSD-2-Clause
// SummaryCsv writes one row of CSV (RFC 4180) per setting.
#include "core/app/analysis/summary.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/app/analysis/headline/headline.h"

namespace exphoton::study {
namespace {

std::string Number(double value) {
  if (!std::isfinite(value)) return "";
  char text[40];
  std::snprintf(text, sizeof text, "%.8g", value);
  return text;
}

std::string ColumnsOf(const Measured& m) { return Number(m.value) + "," + Number(m.error); }

std::string Row(const Results& results, const Analysis& analysis, std::size_t index) {
  const SettingResult& s = analysis.settings[index];
  const Setting& setting = results.settings[s.setting];
  const std::vector<std::size_t> front = analysis.Front();
  const bool isFront = std::find(front.begin(), front.end(), index) != front.end();
  std::string text = CsvField(setting.label) + "," + CsvField(setting.integrator) + "," +
                     CsvField(setting.Text()) + "," + std::to_string(s.runs.size());
  for (const Measured& m :
       {s.cpu, s.wall, s.cost.error, s.separation.relMse, s.separation.variance, s.separation.bias2,
        RelativeEfficiency(analysis, s, analysis.settings.front())})
    text += "," + ColumnsOf(m);
  for (const double value :
       {s.trimmed, s.mse, s.meanError, s.relativeMean, s.p99, s.flip, double(s.nonFinite),
        s.samplesPerPixel, s.photonPaths, s.photonsStored, s.peakMemory})
    text += "," + Number(value);
  return text + "," + (isFront ? "yes" : "no") + "\r\n";
}

}  // namespace

std::string SummaryCsv(const Results& results, const Analysis& analysis) {
  std::string text = "label,integrator,parameters,seeds";
  for (const char* name :
       {"cpuSeconds", "wallSeconds", "error", "relMSE", "noise", "bias2", "relativeEfficiency"})
    text += "," + std::string(name) + "," + name + " +-";
  text +=
      ",trimmedRelMSE,MSE,meanError,relativeMeanError,p99,FLIP,nonFinitePixels,samplesPerPixel,"
      "photonPaths,photonsStored,peakMemoryBytes,onFront\r\n";
  for (std::size_t i = 0; i < analysis.settings.size(); ++i) text += Row(results, analysis, i);
  return text;
}

}  // namespace exphoton::study
