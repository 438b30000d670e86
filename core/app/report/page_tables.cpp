// SPDX-License-Identifier: BSD-2-Clause
// This file makes the tables of the front, of all settings, and of the machine.
#include "core/app/report/page_tables.h"

#include <algorithm>
#include <set>

#include "core/app/analysis/numbers.h"
#include "core/app/report/markup.h"
#include "core/app/report/page_sections.h"

namespace exphoton::study {
namespace {

Html SettingRow(const Analysis& analysis, std::size_t index, const ParameterColumns& columns) {
  const SettingResult& s = analysis.settings[index];
  return Fill("setting-row", {{"line", LineCell(analysis, index)},
                              {"parameters", columns.Cells(s)},
                              {"cpu", MeasuredCell(s.cpu)},
                              {"wall", MeasuredCell(s.wall)},
                              {"relMse", ThousandthsCell(s.separation.relMse)},
                              {"trimmed", ShortNumber(1000 * s.trimmed, 3)},
                              {"noise", ThousandthsCell(s.separation.variance)},
                              {"bias", ThousandthsCell(s.separation.bias2)},
                              {"mse", ShortNumber(1000 * s.mse, 3)},
                              {"meanError", (s.relativeMean > 0 ? "+" : "") +
                                                ShortNumber(100 * s.relativeMean) + " %"},
                              {"p99", ShortNumber(s.p99)},
                              {"flip", ShortNumber(s.flip)},
                              {"nonFinite", s.nonFinite},
                              {"efficiency", ShortNumber(s.Efficiency())},
                              {"spp", ShortNumber(s.samplesPerPixel, 6)},
                              {"paths", CountText(s.photonPaths)},
                              {"photons", CountText(s.photonsStored)},
                              {"memory", ShortNumber(s.peakMemory / (1 << 20), 3)}});
}

// Returns the command of each setting's first render, one a line.
std::string SettingCommands(const Results& results) {
  std::string text;
  std::set<std::size_t> seen;
  for (const RunRow& row : results.runs)
    if (seen.insert(row.setting).second) text += row.command + "\n";
  return text;
}

Html LowerBoundCommands(const Results& results) {
  std::string text;
  for (const LowerBound& bound : results.lowerBounds) text += "\n" + bound.command;
  return text.empty() ? Html() : Fill("bound-commands", {{"commands", text}});
}

}  // namespace

Html MeasuredCell(const Measured& m) {
  const RoundedPair pair = RoundTogether(m);
  if (pair.error.empty()) return Escape(pair.value);
  return Fill("measured", {{"value", pair.value}, {"error", pair.error}});
}

Html ThousandthsCell(const Measured& m) { return MeasuredCell({1000 * m.value, 1000 * m.error}); }

ParameterColumns::ParameterColumns(const Results& results, const Analysis& analysis,
                                   const std::vector<std::size_t>& shown)
    : results_(results) {
  std::vector<const Setting*> settings;
  for (const std::size_t i : shown)
    settings.push_back(&results.settings[analysis.settings[i].setting]);
  for (const Setting* setting : settings)
    for (const auto& [name, value] : setting->parameters) {
      const bool isNew = std::find(names_.begin(), names_.end(), name) == names_.end();
      const bool differs = std::any_of(settings.begin(), settings.end(),
                                       [&name = name, &value = value](auto* other) {
                                         const std::string* found = other->Find(name);
                                         return !found || *found != value;
                                       });
      if (isNew && (differs || settings.size() == 1)) names_.push_back(name);
    }
}

Html ParameterColumns::Heads() const {
  Html heads;
  for (const std::string& name : names_) heads += Fill("parameter-head", {{"name", name}});
  return heads;
}

Html ParameterColumns::Cells(const SettingResult& setting) const {
  Html cells;
  for (const std::string& name : names_) {
    const std::string* value = results_.settings[setting.setting].Find(name);
    cells += Fill("parameter-cell", {{"value", value ? *value : std::string("–")}});
  }
  return cells;
}

std::vector<std::size_t> AllByLine(const Analysis& analysis) {
  std::vector<std::size_t> all;
  for (const Line& line : analysis.lines)
    all.insert(all.end(), line.settings.begin(), line.settings.end());
  return all;
}

std::vector<std::size_t> FrontsByLine(const Analysis& analysis) {
  std::vector<std::size_t> all;
  for (const Line& line : analysis.lines) {
    const std::vector<std::size_t> front = analysis.Front(line.settings);
    all.insert(all.end(), front.begin(), front.end());
  }
  return all;
}

std::size_t LineOf(const Analysis& analysis, std::size_t setting) {
  for (std::size_t i = 0; i < analysis.lines.size(); ++i) {
    const std::vector<std::size_t>& own = analysis.lines[i].settings;
    if (std::find(own.begin(), own.end(), setting) != own.end()) return i;
  }
  return 0;
}

Html LineCell(const Analysis& analysis, std::size_t setting) {
  const std::size_t line = LineOf(analysis, setting);
  return Fill("line-cell", {{"marker", LineMarker(line)}, {"label", analysis.lines[line].label}});
}

Html FrontSection(const Results& results, const Analysis& analysis) {
  const std::vector<std::size_t> front = analysis.Front();
  if (front.empty()) return {};
  const ParameterColumns columns(results, analysis, front);
  Html rows;
  int number = 0;
  for (const std::size_t i : front) {
    const SettingResult& s = analysis.settings[i];
    rows += Fill("front-row", {{"number", ++number},
                               {"line", LineCell(analysis, i)},
                               {"parameters", columns.Cells(s)},
                               {"seconds", MeasuredCell(s.cost.seconds)},
                               {"error", ThousandthsCell(s.cost.error)},
                               {"flip", analysis.hasReference ? ShortNumber(s.flip) : "–"}});
  }
  return Fill("front-section", {{"count", front.size()},
                                {"parameters", columns.Heads()},
                                {"clock", results.clock == "wall" ? "seconds" : "CPU seconds"},
                                {"rows", rows}});
}

Html SettingSection(const Results& results, const Analysis& analysis) {
  const std::vector<std::size_t> all = AllByLine(analysis);
  const ParameterColumns columns(results, analysis, all);
  Html rows;
  for (const std::size_t i : all) rows += SettingRow(analysis, i, columns);
  return Fill("setting-section", {{"parameters", columns.Heads()}, {"rows", rows}});
}

Html MachineSection(const Results& results, const Analysis&) {
  const std::string& reference = results.reference.command;
  return Fill("machine-section",
              {{"processor", results.processor},
               {"cores", results.cores},
               {"system", results.system},
               {"program", results.program},
               {"fingerprint", results.fingerprint},
               {"threads", results.runs.empty() ? 0 : results.runs.front().threads},
               {"command", results.command},
               {"referenceCommand",
                reference.empty() ? Html() : Fill("reference-command", {{"command", reference}})},
               {"settingCommands", SettingCommands(results)},
               {"boundCommands", LowerBoundCommands(results)}});
}

}  // namespace exphoton::study
