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

std::string Cell(const std::string& html, const std::string& classes = "") {
  return "<td" + (classes.empty() ? "" : " class=\"" + classes + "\"") + ">" + html + "</td>";
}
std::string Row(const std::string& cells) { return "<tr>" + cells + "</tr>\n"; }

std::string Fact(const std::string& value, const std::string& meaning) {
  return "<div><b>" + value + "</b><span>" + meaning + "</span></div>";
}

std::string ClockName(const Results& results) {
  return results.clock == "wall" ? "seconds" : "CPU seconds";
}

std::string SettingText(const Results& results, const SettingResult& setting) {
  return Escape(results.settings[setting.setting].Text());
}

std::string ReferenceFacts(const Results& results, const Analysis& analysis) {
  if (!analysis.hasReference)
    return Fact("No reference", "only the noise between seeds is known; bias is not included");
  const ReferenceRecord& r = results.reference;
  const Measured& noise = analysis.reference.variance;
  std::string what = Escape(r.integrator.empty() ? "a given picture" : r.integrator);
  if (r.samplesPerPixel > 0) what += ", " + CountText(r.samplesPerPixel) + " samples a pixel";
  std::string facts = Fact(
      what, "the reference" + std::string(r.seconds > 0 ? ", in " + SecondsText(r.seconds) : ""));
  facts += noise.IsKnown() ? Fact(ShortNumber(noise.value),
                                  "relMSE of the reference's own noise, from its two "
                                  "halves; taken off all errors")
                           : Fact("unknown", "noise of the reference: it was given as one picture");
  return facts;
}

// Returns the file name with its parent folder. The report's commands show the full path.
std::string FileInFolder(const std::string& path) {
  const std::filesystem::path file(path);
  return (file.parent_path().filename() / file.filename()).string();
}

// Explains a reference that was rendered from another scene file.
std::string ReferenceNote(const Results& results) {
  const ReferenceRecord& r = results.reference;
  if (r.scene.empty() || r.scene == results.scene || r.sceneHash == results.sceneHash) return "";
  return "<p class=\"lead\">The reference was rendered from a variant of the scene, <code>" +
         Escape(FileInFolder(r.scene)) +
         "</code>, which has the same picture but light that path tracing finds; the other runs "
         "render <code>" +
         Escape(FileInFolder(results.scene)) + "</code>.</p>";
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

std::string BarCell(const std::vector<Bar>& bars) {
  double total = 0;
  for (const Bar& bar : bars) total += bar.share;
  const bool isCut = total > 1.001;
  std::string text = "<td class=\"bar bars\"><svg role=\"img\">";
  double at = 0;
  for (const Bar& bar : bars) {
    const double width = std::min(bar.share, 1 - at);
    if (!(width > 0)) continue;
    text += "<rect x=\"" + Percent(at) + "\" width=\"" + Percent(width) +
            "\" y=\"0\" height=\"14\" class=\"" + bar.classes + "\"><title>" + Escape(bar.title) +
            "</title></rect>";
    at += width;
  }
  if (isCut) text += "<text x=\"99%\" y=\"11\" text-anchor=\"end\" class=\"cut\">▸</text>";
  return text + "</svg></td>";
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
  std::vector<std::string> names{"parse",    "accelerator", "shoot", "kd-trees",
                                 "radiance", "render",      "write"};
  for (const SettingResult& setting : analysis.settings)
    for (const auto& phase : setting.phases)
      if (phase.first != "other" &&
          std::find(names.begin(), names.end(), phase.first) == names.end())
        names.push_back(phase.first);
  names.push_back("other");
  return names;
}

std::string PhaseClass(std::size_t i) {
  return "p" + std::to_string(i % std::size_t(kPhaseColors));
}

struct BarScales {
  std::vector<std::string> phases;
  double fullTime, fullError;
};

std::string BarRow(const Analysis& analysis, const SettingResult& setting, const std::string& label,
                   const BarScales& scales) {
  const auto& [names, fullTime, fullError] = scales;
  std::vector<Bar> time;
  for (std::size_t i = 0; i < names.size(); ++i)
    for (const auto& [name, seconds] : setting.phases)
      if (name == names[i])
        time.push_back({seconds / fullTime, PhaseClass(i), name + ": " + SecondsText(seconds)});
  const Separation& s = setting.separation;
  const double bias = s.bias2.IsKnown() ? std::max(0., s.bias2.value) : 0;
  const double noise = s.variance.IsKnown() ? s.variance.value : setting.cost.error.value;
  const std::vector<Bar> error{{noise / fullError, "noise", "noise: " + ShortNumber(noise)},
                               {bias / fullError, "bias", "bias²: " + ShortNumber(bias)}};
  const Measured worth = RelativeEfficiency(analysis, setting, analysis.settings.front());
  return Row(Cell(label, "wrap") + BarCell(time) + Cell(SecondsText(setting.cost.seconds.value)) +
             BarCell(error) + Cell(MeasuredText(s.variance)) + Cell(MeasuredText(s.bias2)) +
             Cell(worth.IsKnown() ? ShortNumber(worth.value) + "×" : "–"));
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

std::string PriceCell(const Results& results, const SettingResult* setting, bool isCheapest) {
  if (!setting) return Cell("–");
  const std::string seconds = SecondsText(setting->cost.seconds.value);
  return Cell(
      (isCheapest ? "<span class=\"best\">" + seconds + "</span>" : seconds) + "<br><small>" +
          SettingText(results, *setting) + "<br>" +
          ShortNumber(setting->peakMemory / (1 << 20), 3) + " MiB" +
          (setting->photonsStored > 0 ? ", " + CountText(setting->photonsStored) + " photons"
                                      : "") +
          "</small>",
      "wide");
}

std::string PriceRow(const Results& results, const Analysis& analysis, double target) {
  std::string cells = Cell("<b>" + ShortNumber(target) + "</b>");
  const std::string shortfall = ShortfallText(analysis.reference, target);
  if (!shortfall.empty())
    return Row(cells + "<td class=\"refused wrap t\" colspan=\"" +
               std::to_string(analysis.lines.size()) + "\">refused: " + shortfall + "</td>");
  std::vector<const SettingResult*> cheapest;
  double least = 1e300;
  for (const Line& line : analysis.lines) {
    cheapest.push_back(CheapestOf(analysis, line, target));
    if (cheapest.back()) least = std::min(least, cheapest.back()->cost.seconds.value);
  }
  for (const SettingResult* setting : cheapest)
    cells += PriceCell(results, setting, setting && setting->cost.seconds.value == least);
  return Row(cells);
}

std::string DoublingRows(const Results& results, const Analysis& analysis) {
  std::vector<CostPoint> points(results.settings.size());
  for (const SettingResult& s : analysis.settings) points[s.setting] = s.cost;
  std::vector<DoublingEffect> costs = FindDoublingEffects(results.settings, points);
  std::stable_sort(costs.begin(), costs.end(),
                   [&](const DoublingEffect& a, const DoublingEffect& b) {
                     return LineNumber(analysis, a.label) < LineNumber(analysis, b.label);
                   });
  std::string rows;
  for (const DoublingEffect& knob : costs)
    rows += Row(Cell(ColorDot(LineNumber(analysis, knob.label)) + Escape(knob.label)) +
                Cell(Escape(knob.parameter), "t") +
                Cell((knob.secondsPerDoubling >= 0 ? "+" : "−") +
                     SecondsText(std::abs(knob.secondsPerDoubling))) +
                Cell((knob.errorFactor >= 1 ? "+" : "−") +
                     ShortNumber(100 * std::abs(knob.errorFactor - 1)) + " %") +
                Cell(std::to_string(knob.pairs)));
  return rows;
}

}  // namespace

std::string SectionOf(const std::string& title, const std::string& content) {
  return "<section>\n<h2>" + title + "</h2>\n" + content + "</section>\n";
}

std::string Table(const std::string& head, const std::string& rows) {
  return "<div class=\"scroll\"><table><thead>" + Row(head) + "</thead><tbody>\n" + rows +
         "</tbody></table></div>\n";
}

std::string MeasuredText(const Measured& m) {
  if (!m.IsKnown()) return "–";
  std::string text = ShortNumber(m.value);
  if (std::isfinite(m.error)) text += " <small>± " + ShortNumber(m.error, 1) + "</small>";
  return text;
}

std::string ColorDot(std::size_t line) {
  return "<i class=\"dot k" + std::to_string(line % std::size_t(kSeriesColors)) + "\"></i>";
}

std::string CountText(double count) {
  if (count >= 1e6) return ShortNumber(count / 1e6, 3) + " M";
  if (count >= 1e4) return ShortNumber(count / 1e3, 3) + " k";
  return ShortNumber(count, 6);
}

std::string HeadlineSection(const Results& results, const Analysis& analysis) {
  long long nonFinite = 0;
  for (const SettingResult& setting : analysis.settings) nonFinite += setting.nonFinite;
  std::string text = "<header>\n<p class=\"kicker\">What accuracy costs in time</p>\n<h1>" +
                     Escape(analysis.headline) + "</h1>\n";
  text += "<p class=\"lead\">" +
          std::string(analysis.hasReference
                          ? "relMSE is the mean over pixels and colours of (x − r)² / (r² + 0.01); "
                          : "Noise is measured between seeds, relative to their mean; ") +
          "times are " + ClockName(results) +
          " of the whole process. Times to an error are interpolated between measured settings and "
          "never extrapolated; ± is one standard error.</p>\n";
  text += ReferenceNote(results);
  text += "<div class=\"facts\">" + ReferenceFacts(results, analysis);
  text += Fact(std::to_string(results.runs.size()) + " renders",
               std::to_string(results.settings.size()) + " settings with " +
                   std::to_string(results.seeds) + " independent seeds each");
  text += nonFinite == 0
              ? Fact("0 pixels", "are NaN or infinite, in all pictures together")
              : Fact("<span class=\"alarm\">" + std::to_string(nonFinite) + " pixels</span>",
                     "are NaN or infinite and were left out of all errors");
  return text + "</div>\n</header>\n";
}

std::string CurveSection(const Results& results, const Analysis& analysis) {
  std::string keys = "<div class=\"keys\">";
  for (std::size_t i = 0; i < analysis.lines.size(); ++i)
    keys += "<span>" + ColorDot(i) + Escape(analysis.lines[i].label) + "</span>";
  keys += "</div>\n";
  std::string rows;
  int number = 0;
  for (const std::size_t i : FrontOf(analysis)) {
    const SettingResult& s = analysis.settings[i];
    rows +=
        Row(Cell(std::to_string(++number)) + Cell(Escape(results.settings[s.setting].label), "t") +
            Cell(SettingText(results, s), "wrap t") + Cell(MeasuredText(s.cost.seconds)) +
            Cell(MeasuredText(s.cost.error)));
  }
  return SectionOf(
      "Error against time",
      "<p>Each mark is one setting, the mean of its seeds. Filled ones are the best of their line "
      "for their time. The numbers are the settings that nothing beats in both time and error:"
      "</p>\n" +
          keys + "<div class=\"scroll\">" + CostChart(results, analysis) + "</div>\n" +
          Table("<th>#</th><th class=\"t\">line</th><th class=\"t\">setting</th><th>" +
                    ClockName(results) + "</th><th>error</th>",
                rows));
}

std::string BarSection(const Results& results, const Analysis& analysis) {
  const std::vector<std::string> names = PhaseNames(analysis);
  std::vector<double> times, errors;
  for (const SettingResult& s : analysis.settings) {
    times.push_back(s.cost.seconds.value);
    errors.push_back(s.cost.error.value);
  }
  const BarScales scales{names, FullWidth(times), FullWidth(errors)};
  std::string keys = "<div class=\"keys\">";
  for (std::size_t i = 0; i < names.size(); ++i)
    keys += "<span><i class=\"key " + PhaseClass(i) + "\"></i>" + Escape(names[i]) + "</span>";
  keys +=
      "</div><div class=\"keys\"><span><i class=\"key noise\"></i>noise (variance between seeds)"
      "</span><span><i class=\"key bias\"></i>bias²</span></div>\n";
  std::string rows;
  for (std::size_t i = 0; i < analysis.lines.size(); ++i) {
    const bool isGroup = analysis.lines.size() < analysis.settings.size();
    const std::string name = ColorDot(i) + Escape(analysis.lines[i].label);
    if (isGroup) rows += "<tr class=\"group\"><td colspan=\"7\">" + name + "</td></tr>\n";
    for (const std::size_t index : analysis.lines[i].settings) {
      const SettingResult& setting = analysis.settings[index];
      rows += BarRow(analysis, setting, isGroup ? SettingText(results, setting) : name, scales);
    }
  }
  return SectionOf("What each second bought",
                   "<p>Left, where the time went; right, what error it left: noise, which another "
                   "seed changes, and bias², which it does not. Noise, bias² and the reference's "
                   "noise add up to the measured relMSE. A bias² below 0 is 0 within its error; ▸ "
                   "marks bars that go on. Efficiency is 1 / (error × time), relative to the first "
                   "row; – where the reference is too noisy to tell.</p>\n" +
                       keys +
                       Table("<th>setting</th><th colspan=\"2\">" + ClockName(results) +
                                 "</th><th></th><th>noise</th><th>bias²</th><th>efficiency</th>",
                             rows));
}

std::string PriceSection(const Results& results, const Analysis& analysis) {
  std::string head = "<th>error</th>", rows;
  for (std::size_t i = 0; i < analysis.lines.size(); ++i)
    head += "<th>" + ColorDot(i) + Escape(analysis.lines[i].label) + "</th>";
  for (const double target : results.targets) rows += PriceRow(results, analysis, target);
  std::string text =
      "<p>The cheapest measured setting with at most this error, its memory and its stored "
      "photons. "
      "–: none of the settings tried.</p>\n" +
      Table(head, rows);
  if (const std::string knobs = DoublingRows(results, analysis); !knobs.empty())
    text += "<h3>What doubling a parameter does</h3>\n" +
            Table(
                "<th>line</th><th class=\"t\">doubling</th><th>costs</th><th>changes the error "
                "by</th><th>pairs</th>",
                knobs);
  return SectionOf("Price list", text);
}

}  // namespace exphoton::study
