// SPDX-License-Identifier: BSD-2-Clause
// ToCsv writes one row of CSV (RFC 4180) for each render of a study.
#include <cmath>
#include <cstdio>
#include <set>

#include "core/app/analysis/results.h"
#include "core/app/analysis/separation.h"

namespace exphoton::study {
namespace {

std::string CsvNumber(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.10g", value);
  return text;
}

// Returns all names in the member over all rows, sorted.
std::set<std::string> AllNames(const Results& results, NamedValues RunRow::*member) {
  std::set<std::string> names;
  for (const RunRow& row : results.runs)
    for (const auto& value : row.*member) names.insert(value.first);
  return names;
}

}  // namespace

std::string CsvField(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

std::string ToCsv(const Results& results) {
  std::string text =
      "scene,integrator,label,parameters,seed,threads,samplesPerPixel,complete,wallSeconds,"
      "cpuSeconds,peakMemoryBytes";
  const std::set<std::string> phases = AllNames(results, &RunRow::phases),
                              rays = AllNames(results, &RunRow::rays),
                              counters = AllNames(results, &RunRow::counters),
                              certificates = AllNames(results, &RunRow::certificate);
  for (const std::string& name : phases) text += "," + CsvField("seconds: " + name);
  for (const std::string& name : rays) text += "," + CsvField("rays: " + name);
  for (const std::string& name : counters) text += "," + CsvField(name);
  for (const std::string& name : certificates) text += "," + CsvField("certificate: " + name);
  for (const auto& metric : MetricValues(RunRow())) text += "," + metric.first;
  text += ",image\r\n";
  for (const RunRow& row : results.runs) {
    const Setting& setting = results.settings.at(row.setting);
    text += CsvField(results.title) + "," + CsvField(setting.integrator) + "," +
            CsvField(setting.label) + "," + CsvField(setting.Text()) + "," +
            std::to_string(row.seed) + "," + std::to_string(row.threads) + "," +
            CsvNumber(row.samplesPerPixel) + "," + (row.isComplete ? "yes" : "no") + "," +
            CsvNumber(row.wallSeconds) + "," + CsvNumber(row.cpuSeconds) + "," +
            CsvNumber(row.peakMemory);
    for (const std::string& name : phases) text += "," + CsvNumber(ValueOf(row.phases, name));
    for (const std::string& name : rays) text += "," + CsvNumber(ValueOf(row.rays, name));
    for (const std::string& name : counters) text += "," + CsvNumber(ValueOf(row.counters, name));
    for (const std::string& name : certificates) {
      const double value = ValueOf(row.certificate, name, kUnknown);
      text += "," + (std::isfinite(value) ? CsvNumber(value) : std::string());
    }
    for (const auto& metric : MetricValues(row))
      text += "," + (row.hasMetrics ? CsvNumber(metric.second) : std::string());
    text += "," + CsvField(row.image) + "\r\n";
  }
  return text;
}

}  // namespace exphoton::study
