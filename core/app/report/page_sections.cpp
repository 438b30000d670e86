// SPDX-License-Identifier: BSD-2-Clause
// This file makes the headline, curves, bars and price list. Pictures are in page_gallery.cpp.
#include "core/app/report/page_sections.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

#include "core/app/report/cost_chart.h"
#include "core/app/report/headline.h"
#include "core/app/report/markup.h"

namespace exphoton::study {
namespace {

Html Fact(const Value& value, const std::string& meaning) {
  return Fill("fact", {{"value", value}, {"meaning", meaning}});
}

std::string ClockName(const Results& results) {
  return results.clock == "wall" ? "seconds" : "CPU seconds";
}

std::string SettingText(const Results& results, const SettingResult& setting) {
  return results.settings[setting.setting].Text();
}

Html ReferenceFacts(const Results& results, const Analysis& analysis) {
  if (!analysis.hasReference)
    return Fact("No reference", "only the noise between seeds is known; bias is not included");
  const ReferenceRecord& r = results.reference;
  const Measured& noise = analysis.reference.variance;
  std::string what = r.integrator.empty() ? "a given picture" : r.integrator;
  if (r.samplesPerPixel > 0) what += ", " + CountText(r.samplesPerPixel) + " samples a pixel";
  const std::string time = r.seconds > 0 ? ", in " + SecondsText(r.seconds) : "";
  return Fact(what, "the reference" + time) +
         (noise.IsKnown()
              ? Fact(ShortNumber(noise.value),
                     "relMSE of the reference's own noise, from its two halves; taken off all "
                     "errors")
              : Fact("unknown", "noise of the reference: it was given as one picture"));
}

// Returns the file name with its parent folder. The report's commands show the full path.
std::string FileInFolder(const std::string& path) {
  const std::filesystem::path file(path);
  return (file.parent_path().filename() / file.filename()).string();
}

// Explains a reference that was rendered from another scene file.
Html ReferenceNote(const Results& results) {
  const ReferenceRecord& r = results.reference;
  if (r.scene.empty() || r.scene == results.scene || r.sceneHash == results.sceneHash) return {};
  return Fill("reference-note",
              {{"reference", FileInFolder(r.scene)}, {"scene", FileInFolder(results.scene)}});
}

std::size_t LineNumber(const Analysis& analysis, const std::string& label) {
  std::size_t i = 0;
  while (i + 1 < analysis.lines.size() && analysis.lines[i].label != label) ++i;
  return i;
}

struct Bar {
  double share;  // fraction of the full width
  std::string classes, title;
};

Html Bars(const std::vector<Bar>& bars) {
  double total = 0;
  for (const Bar& bar : bars) total += bar.share;
  const bool isCut = total > 1.001;
  Html shapes;
  double at = 0;
  for (const Bar& bar : bars) {
    const double width = std::min(bar.share, 1 - at);
    if (!(width > 0)) continue;
    shapes += Fill("bar", {{"x", Percent(at)},
                           {"width", Percent(width)},
                           {"classes", bar.classes},
                           {"title", bar.title}});
    at += width;
  }
  if (isCut) shapes += Fill("cut-bar");
  return Fill("bars", {{"bars", shapes}});
}

// Returns the value at which bars are cut, at most four times the median, so that short bars remain
// distinguishable.
double FullWidth(std::vector<double> values) {
  values.erase(std::remove_if(values.begin(), values.end(),
                              [](double v) { return !std::isfinite(v) || v <= 0; }),
               values.end());
  if (values.empty()) return 1;
  std::sort(values.begin(), values.end());
  return std::min(values.back(), 4 * values[values.size() / 2]);
}

// Returns the names of all phases, in the order of a render. Each phase has a colour.
std::vector<std::string> PhaseNames(const Analysis& analysis) {
  std::vector<std::string> names{"parse",    "accelerator", "shoot", "photon maps",
                                 "radiance", "render",      "share", "write"};
  for (const SettingResult& setting : analysis.settings)
    for (const auto& phase : setting.phases)
      if (phase.first != "other" &&
          std::find(names.begin(), names.end(), phase.first) == names.end())
        names.push_back(phase.first);
  names.push_back("other");
  return names;
}

std::size_t PhaseColor(std::size_t i) { return i % std::size_t(kPhaseColors); }

struct BarScales {
  std::vector<std::string> phases;
  double fullTime, fullError;
};

Html BarRow(const Analysis& analysis, const SettingResult& setting, const Value& name,
            const BarScales& scales) {
  const auto& [names, fullTime, fullError] = scales;
  std::vector<Bar> time;
  for (std::size_t i = 0; i < names.size(); ++i)
    for (const auto& [phase, seconds] : setting.phases)
      if (phase == names[i])
        time.push_back({seconds / fullTime, "p" + std::to_string(PhaseColor(i)),
                        phase + ": " + SecondsText(seconds)});
  const Separation& s = setting.separation;
  const double bias = s.bias2.IsKnown() ? std::max(0., s.bias2.value) : 0;
  const double noise = s.variance.IsKnown() ? s.variance.value : setting.cost.error.value;
  const std::vector<Bar> error{{noise / fullError, "noise", "noise: " + ShortNumber(noise)},
                               {bias / fullError, "bias", "bias²: " + ShortNumber(bias)}};
  const Measured worth = RelativeEfficiency(analysis, setting, analysis.settings.front());
  return Fill("bar-row", {{"name", name},
                          {"time", Bars(time)},
                          {"seconds", SecondsText(setting.cost.seconds.value)},
                          {"error", Bars(error)},
                          {"noise", MeasuredText(s.variance)},
                          {"bias", MeasuredText(s.bias2)},
                          {"efficiency", worth.IsKnown() ? ShortNumber(worth.value) + "×" : "–"}});
}

// Returns the line's cheapest setting with at most the target error, or null if there is none.
const SettingResult* CheapestOf(const Analysis& analysis, const Line& line, double target) {
  const SettingResult* best = nullptr;
  for (const std::size_t s : line.settings) {
    const SettingResult& setting = analysis.settings[s];
    if (!(setting.cost.error.value <= target)) continue;
    if (!best || setting.cost.seconds.value < best->cost.seconds.value) best = &setting;
  }
  return best;
}

Html PriceCell(const Results& results, const SettingResult* setting, bool isCheapest) {
  if (!setting) return Fill("price-none");
  const std::string seconds = SecondsText(setting->cost.seconds.value);
  std::string memory = ShortNumber(setting->peakMemory / (1 << 20), 3) + " MiB";
  if (setting->photonsStored > 0) memory += ", " + CountText(setting->photonsStored) + " photons";
  return Fill("price",
              {{"seconds", isCheapest ? Fill("cheapest", {{"seconds", seconds}}) : Escape(seconds)},
               {"setting", SettingText(results, *setting)},
               {"memory", memory}});
}

Html PriceRow(const Results& results, const Analysis& analysis, double target) {
  Html prices;
  const std::string shortfall = ShortfallText(analysis.reference, target);
  if (!shortfall.empty()) {
    prices = Fill("price-refused", {{"columns", analysis.lines.size()}, {"reason", shortfall}});
  } else {
    std::vector<const SettingResult*> cheapest;
    double least = 1e300;
    for (const Line& line : analysis.lines) {
      cheapest.push_back(CheapestOf(analysis, line, target));
      if (cheapest.back()) least = std::min(least, cheapest.back()->cost.seconds.value);
    }
    for (const SettingResult* setting : cheapest)
      prices += PriceCell(results, setting, setting && setting->cost.seconds.value == least);
  }
  return Fill("price-row", {{"error", ShortNumber(target)}, {"prices", prices}});
}

Html DoublingRows(const Results& results, const Analysis& analysis) {
  std::vector<CostPoint> points(results.settings.size());
  for (const SettingResult& s : analysis.settings) points[s.setting] = s.cost;
  std::vector<DoublingEffect> costs = FindDoublingEffects(results.settings, points);
  std::stable_sort(costs.begin(), costs.end(),
                   [&](const DoublingEffect& a, const DoublingEffect& b) {
                     return LineNumber(analysis, a.label) < LineNumber(analysis, b.label);
                   });
  Html rows;
  for (const DoublingEffect& cost : costs)
    rows += Fill("doubling-row",
                 {{"marker", LineMarker(LineNumber(analysis, cost.label))},
                  {"label", cost.label},
                  {"parameter", cost.parameter},
                  {"seconds", (cost.secondsPerDoubling >= 0 ? "+" : "−") +
                                  SecondsText(std::abs(cost.secondsPerDoubling))},
                  {"error", (cost.errorFactor >= 1 ? "+" : "−") +
                                ShortNumber(100 * std::abs(cost.errorFactor - 1)) + " %"},
                  {"pairs", cost.pairs}});
  return rows;
}

}  // namespace

Html MeasuredText(const Measured& m) {
  if (!m.IsKnown()) return Escape("–");
  if (!std::isfinite(m.error)) return Escape(ShortNumber(m.value));
  return Fill("measured", {{"value", ShortNumber(m.value)}, {"error", ShortNumber(m.error, 1)}});
}

Html LineMarker(std::size_t line) {
  return Fill("line-marker",
              {{"shape", SvgMarker(int(line), {}, 5, "point " + ColorClass(line), "")}});
}

std::string CountText(double count) {
  if (count >= 1e6) return ShortNumber(count / 1e6, 3) + " M";
  if (count >= 1e4) return ShortNumber(count / 1e3, 3) + " k";
  return ShortNumber(count, 6);
}

Html HeadlineSection(const Results& results, const Analysis& analysis) {
  long long nonFinite = 0;
  for (const SettingResult& setting : analysis.settings) nonFinite += setting.nonFinite;
  Html facts = ReferenceFacts(results, analysis);
  facts += Fact(std::to_string(results.runs.size()) + " renders",
                std::to_string(results.settings.size()) + " settings with " +
                    std::to_string(results.seeds) + " independent seeds each");
  facts += nonFinite == 0 ? Fact("0 pixels", "are NaN or infinite, in all pictures together")
                          : Fact(Fill("alarm", {{"text", std::to_string(nonFinite) + " pixels"}}),
                                 "are NaN or infinite and were left out of all errors");
  return Fill("headline-section",
              {{"headline", analysis.headline},
               {"measure", analysis.hasReference
                               ? "relMSE is the mean over pixels and colours of (x − r)² / (r² + "
                                 "0.01);"
                               : "Noise is measured between seeds, relative to their mean;"},
               {"clock", ClockName(results)},
               {"note", ReferenceNote(results)},
               {"facts", facts}});
}

Html CurveSection(const Results& results, const Analysis& analysis) {
  Html keys, rows;
  for (std::size_t i = 0; i < analysis.lines.size(); ++i)
    keys += Fill("line-key", {{"marker", LineMarker(i)}, {"label", analysis.lines[i].label}});
  int number = 0;
  for (const std::size_t i : FrontOf(analysis)) {
    const SettingResult& s = analysis.settings[i];
    rows += Fill("curve-row", {{"number", ++number},
                               {"line", results.settings[s.setting].label},
                               {"setting", SettingText(results, s)},
                               {"seconds", MeasuredText(s.cost.seconds)},
                               {"error", MeasuredText(s.cost.error)}});
  }
  return Fill("curve-section", {{"keys", keys},
                                {"chart", CostChart(results, analysis)},
                                {"clock", ClockName(results)},
                                {"rows", rows}});
}

Html BarSection(const Results& results, const Analysis& analysis) {
  const std::vector<std::string> names = PhaseNames(analysis);
  std::vector<double> times, errors;
  for (const SettingResult& s : analysis.settings) {
    times.push_back(s.cost.seconds.value);
    errors.push_back(s.cost.error.value);
  }
  const BarScales scales{names, FullWidth(times), FullWidth(errors)};
  Html keys, rows;
  for (std::size_t i = 0; i < names.size(); ++i)
    keys += Fill("phase-key", {{"color", PhaseColor(i)}, {"name", names[i]}});
  const bool isGrouped = analysis.lines.size() < analysis.settings.size();
  for (std::size_t i = 0; i < analysis.lines.size(); ++i) {
    const Html name = LineMarker(i) + Escape(analysis.lines[i].label);
    if (isGrouped) rows += Fill("bar-group", {{"name", name}});
    for (const std::size_t index : analysis.lines[i].settings) {
      const SettingResult& setting = analysis.settings[index];
      rows += BarRow(analysis, setting,
                     isGrouped ? Value(SettingText(results, setting)) : Value(name), scales);
    }
  }
  return Fill("bar-section", {{"keys", keys}, {"clock", ClockName(results)}, {"rows", rows}});
}

Html PriceSection(const Results& results, const Analysis& analysis) {
  Html lines, rows;
  for (std::size_t i = 0; i < analysis.lines.size(); ++i)
    lines += Fill("price-line", {{"marker", LineMarker(i)}, {"label", analysis.lines[i].label}});
  for (const double target : results.targets) rows += PriceRow(results, analysis, target);
  const Html doublings = DoublingRows(results, analysis);
  return Fill(
      "price-section",
      {{"lines", lines},
       {"rows", rows},
       {"doubling", doublings.IsEmpty() ? Html() : Fill("doubling", {{"rows", doublings}})}});
}

}  // namespace exphoton::study
