// SPDX-License-Identifier: BSD-2-Clause
// WriteHeadline chooses a target error and composes the sentence. Nothing is extrapolated: the
// sentence names the lines that do not reach the error. It states no ratio for which the reference
// is too noisy.
#include "core/app/report/headline.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/base/format.h"

namespace exphoton::study {
namespace {

using Kind = TimeToError::Kind;

// Returns the smallest round error that at least two lines reach by interpolation and that the
// reference can measure. With a single line, one suffices.
std::optional<double> ChooseTarget(const Analysis& analysis) {
  const std::size_t wanted = std::min<std::size_t>(2, analysis.lines.size());
  std::optional<double> best;
  for (const double error : RoundErrors()) {
    if (ReferenceShortfall(analysis.reference, error) > 1) break;
    std::size_t reached = 0;
    for (const Line& line : analysis.lines)
      reached += FindTimeToError(analysis.Points(line), error).kind == Kind::Reached;
    if (reached >= wanted && reached > 0) best = error;
  }
  return best;
}

std::string WithError(const Measured& m) {
  return ShortNumber(m.value) +
         (std::isfinite(m.error) ? " ± " + ShortNumber(m.error, 1) : std::string());
}

std::string RatioText(const Measured& ratio) { return "(" + WithError(ratio) + "×)"; }

std::string LineText(const Line& line, const Line& fastest) {
  const TimeToError& t = line.toTarget;
  if (t.kind == Kind::Never) {
    if (!t.best.error.IsKnown()) return line.label + " has no error that can be measured";
    return line.label + " never gets there (at best " + ShortNumber(t.best.error.value) + ", in " +
           SecondsText(t.best.seconds.value) + ")";
  }
  std::string text = line.label + (t.kind == Kind::AtMost ? " in at most " : " in ") +
                     SecondsText(t.seconds.value);
  const bool hasRatio =
      &line != &fastest && t.kind == Kind::Reached && fastest.toTarget.kind == Kind::Reached;
  if (hasRatio) text += " " + RatioText(Ratio(t.seconds, fastest.toTarget.seconds));
  return text;
}

const Line* FastestOf(const Analysis& analysis) {
  const Line* fastest = nullptr;
  for (const Line& line : analysis.lines) {
    if (line.toTarget.kind == Kind::Never) continue;
    if (!fastest || line.toTarget.seconds.value < fastest->toTarget.seconds.value) fastest = &line;
  }
  return fastest;
}

std::string Sentence(const Results& results, const Analysis& analysis) {
  const Line* fastest = FastestOf(analysis);
  std::vector<const Line*> order;
  for (const Line& line : analysis.lines) order.push_back(&line);
  std::stable_sort(order.begin(), order.end(), [](const Line* a, const Line* b) {
    const bool aNever = a->toTarget.kind == Kind::Never, bNever = b->toTarget.kind == Kind::Never;
    if (aNever != bNever) return bNever;
    return !aNever && a->toTarget.seconds.value < b->toTarget.seconds.value;
  });
  const char* what = analysis.hasReference ? "relMSE " : "a noise (without bias) of ";
  std::string text = "On " + results.title + ", ";
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (i == 0)
      text += order[i]->label + " reaches " + what + ShortNumber(*analysis.target) +
              LineText(*order[i], *fastest).substr(order[i]->label.size());
    else
      text += LineText(*order[i], *fastest);
    text += i + 1 < order.size() ? ", " : ".";
  }
  return text;
}

// If no target error was found: states the smallest error of each line.
std::string WithoutTarget(const Results& results, const Analysis& analysis) {
  std::string text = "On " + results.title + ", no error was reached by two lines";
  if (analysis.targetIsTooFine)
    text = "On " + results.title + ", the reference is too noisy to compare errors";
  text += ". Least errors: ";
  bool isFirst = true;
  for (const Line& line : analysis.lines) {
    const TimeToError all = FindTimeToError(analysis.Points(line), 0);
    if (!all.best.error.IsKnown()) continue;
    text += (isFirst ? "" : ", ") + line.label + " " + ShortNumber(all.best.error.value) + " in " +
            SecondsText(all.best.seconds.value);
    isFirst = false;
  }
  return text + ".";
}

// If every line is one setting: states the most efficient ones, relative to the first line.
std::string Efficiencies(const Results& results, const Analysis& analysis) {
  constexpr std::size_t kNamed = 3;
  const std::string& base = analysis.lines.front().label;
  const SettingResult& first = analysis.settings[analysis.lines.front().settings.front()];
  std::vector<std::pair<Measured, std::string>> ratios;
  for (std::size_t i = 1; i < analysis.lines.size(); ++i) {
    const SettingResult& setting = analysis.settings[analysis.lines[i].settings.front()];
    const Measured ratio = RelativeEfficiency(analysis, setting, first);
    if (ratio.IsKnown()) ratios.emplace_back(ratio, analysis.lines[i].label);
  }
  if (ratios.empty()) return WithoutTarget(results, analysis);
  std::stable_sort(ratios.begin(), ratios.end(),
                   [](const auto& a, const auto& b) { return a.first.value > b.first.value; });
  std::string text = "On " + results.title + ", “" + ratios[0].second + "” is " +
                     WithError(ratios[0].first) +
                     " times as efficient (1 / (error × seconds)) as " + base;
  for (std::size_t i = 1; i < std::min(kNamed, ratios.size()); ++i)
    text += (i == 1 ? "; next are “" : ", “") + ratios[i].second + "” with " +
            WithError(ratios[i].first);
  return text + ".";
}

bool HasOnlySingleSettings(const Analysis& analysis) {
  return analysis.lines.size() > 1 &&
         std::all_of(analysis.lines.begin(), analysis.lines.end(),
                     [](const Line& line) { return line.settings.size() == 1; });
}

// Returns whether the reference is too noisy for even the largest measured error.
bool IsTooNoisy(const Analysis& analysis) {
  double largest = 0;
  for (const SettingResult& setting : analysis.settings)
    if (setting.cost.error.IsKnown()) largest = std::max(largest, setting.cost.error.value);
  return ReferenceShortfall(analysis.reference, largest) > 1;
}

}  // namespace

std::string SecondsText(double seconds) {
  if (seconds < 10) return Format("%.2g s", seconds);
  if (seconds < 99.5) return Format("%.0f s", seconds);
  if (seconds < 5940) return Format("%.1f min", seconds / 60);
  return Format("%.1f h", seconds / 3600);
}

std::string ShortNumber(double value, int digits) {
  if (!std::isfinite(value)) return "–";
  if (value < 0) return "−" + ShortNumber(-value, digits);
  if (value == 0) return "0";
  const double size = std::abs(value);
  if (size >= 1e-4 && size < 1e5) {
    const int decimals = std::max(0, digits - 1 - int(std::floor(std::log10(size))));
    std::string text = Format("%.*f", decimals, value);
    if (text.find('.') == std::string::npos) return text;
    while (text.back() == '0') text.pop_back();
    if (text.back() == '.') text.pop_back();
    return text;
  }
  return Format("%.*e", digits - 1, value);
}

std::vector<double> RoundErrors() {
  std::vector<double> errors;
  for (double power = 1; power > 1e-8; power /= 10)
    for (const double digit : {1., .5, .3, .2}) errors.push_back(digit * power);
  return errors;
}

std::string ShortfallText(const Reference& reference, double error) {
  const double factor = ReferenceShortfall(reference, error);
  if (!(factor > 1)) return "";
  if (!std::isfinite(factor)) return "no reference could tell";
  return "the reference's noise is " + Format("%.0f", 10 * factor) + " % of this; one rendered " +
         ShortNumber(std::max(1.1, factor)) + " times as long would do";
}

Measured RelativeEfficiency(const Analysis& analysis, const SettingResult& setting,
                            const SettingResult& base) {
  for (const SettingResult* one : {&setting, &base})
    if (!(ReferenceShortfall(analysis.reference, one->cost.error.value) <= 1)) return {};
  const Measured error = Ratio(base.cost.error, setting.cost.error);
  const Measured time = Ratio(base.cost.seconds, setting.cost.seconds);
  const double value = error.value * time.value;
  return {value, value * std::hypot(error.error / error.value, time.error / time.value)};
}

void WriteHeadline(const Results& results, Analysis* analysis) {
  analysis->target = ChooseTarget(*analysis);
  analysis->targetIsTooFine = !analysis->target && IsTooNoisy(*analysis);
  if (analysis->target)
    for (Line& line : analysis->lines)
      line.toTarget = FindTimeToError(analysis->Points(line), *analysis->target);
  if (HasOnlySingleSettings(*analysis)) {
    analysis->headline = Efficiencies(results, *analysis);
    return;
  }
  analysis->headline =
      analysis->target ? Sentence(results, *analysis) : WithoutTarget(results, *analysis);
}

}  // namespace exphoton::study
