// SPDX-License-Identifier: BSD-2-Clause
// WriteHeadline composes the sentence. target.cpp chooses its error. Nothing is extrapolated: the
// sentence names the contenders that do not reach the error. It states no ratio for which the
// reference is too noisy.
#include "core/app/analysis/headline/headline.h"

#include <algorithm>
#include <cmath>

#include "core/app/analysis/headline/lower_bound.h"
#include "core/app/analysis/headline/machines.h"
#include "core/app/analysis/headline/target.h"
#include "core/app/analysis/numbers.h"
#include "core/base/format.h"

namespace exphoton::study {
namespace {

using Kind = TimeToError::Kind;
using Contenders = std::vector<const Contender*>;

constexpr std::size_t kNamed = 3;  // a sentence names at most this many others

// Returns "a", "a and b", or "a, b and c".
std::string ListText(const std::vector<std::string>& parts) {
  std::string text;
  for (std::size_t i = 0; i < parts.size(); ++i)
    text += (i == 0 ? "" : i + 1 < parts.size() ? ", " : " and ") + parts[i];
  return text;
}

// Returns the contenders that reach the target, the fastest first.
Contenders ReachedBy(const Analysis& analysis) {
  Contenders reached;
  for (const Contender& contender : analysis.contenders)
    if (contender.toTarget.kind != Kind::Never) reached.push_back(&contender);
  std::stable_sort(reached.begin(), reached.end(), [](const Contender* a, const Contender* b) {
    return a->toTarget.seconds.value < b->toTarget.seconds.value;
  });
  return reached;
}

std::vector<std::string> NamesThatNeverReach(const Analysis& analysis) {
  std::vector<std::string> names;
  for (const Contender& contender : analysis.contenders)
    if (contender.toTarget.kind == Kind::Never) names.push_back(contender.name);
  return names;
}

// Returns "needs 1/9 of a's time and 1/43 of b's", with the next fastest first.
std::string SharesText(const Contenders& reached) {
  const Contender& fastest = *reached.front();
  std::vector<std::string> shares;
  for (std::size_t i = 1; i < reached.size() && shares.size() < kNamed; ++i) {
    if (reached[i]->toTarget.kind != Kind::Reached) continue;
    const double share = fastest.toTarget.seconds.value / reached[i]->toTarget.seconds.value;
    shares.push_back(ShareText(share) + " of " + reached[i]->name +
                     (shares.empty() ? "'s time" : "'s"));
  }
  const bool isBound = fastest.toTarget.kind == Kind::AtMost;
  return std::string("needs ") + (isBound ? "at most " : "") + ListText(shares);
}

std::string Sentence(const Results& results, const Analysis& analysis) {
  std::string text =
      "On " + results.title + ", to the same " + (analysis.hasReference ? "error " : "noise ");
  const Contenders reached = ReachedBy(analysis);
  text += reached.front()->name + " " + SharesText(reached);
  const std::vector<std::string> never = NamesThatNeverReach(analysis);
  if (!never.empty())
    text += "; " + ListText(never) + (never.size() == 1 ? " does" : " do") + " not reach it";
  return text + ".";
}

std::string TimesText(const Measured& ratio) { return " (" + MeasuredText(ratio) + " times)"; }

// Returns "path 70 s (7.0 ± 0.2 times)", with the ratio to the fastest.
std::string TimeText(const std::string& name, const TimeToError& t, const TimeToError& fastest) {
  if (t.kind == Kind::Never) {
    if (!t.best.error.IsKnown()) return name + " has no error that can be measured";
    return name + " never (at best " + ShortNumber(t.best.error.value) + ", in " +
           SecondsText(t.best.seconds.value) + ")";
  }
  const bool isExact = t.kind == Kind::Reached && fastest.kind == Kind::Reached;
  const bool isOther = t.seconds.value != fastest.seconds.value;
  return name + (t.kind == Kind::AtMost ? " at most " : " ") + SecondsText(t.seconds.value) +
         (isExact && isOther ? TimesText(Ratio(t.seconds, fastest.seconds)) : "");
}

std::string Details(const Analysis& analysis) {
  Contenders order = ReachedBy(analysis);
  const TimeToError& fastest = order.front()->toTarget;
  for (const Contender& contender : analysis.contenders)
    if (contender.toTarget.kind == Kind::Never) order.push_back(&contender);
  std::string text = std::string("At ") + (analysis.hasReference ? "relMSE " : "noise ") +
                     ShortNumber(*analysis.target) + ": ",
              variants;
  for (const Contender* contender : order) {
    text += (contender == order.front() ? "" : ", ") +
            TimeText(contender->name, contender->toTarget, fastest);
    for (const std::size_t i : contender->variants)
      variants += (variants.empty() ? "" : ", ") +
                  TimeText(analysis.lines[i].label, analysis.lines[i].toTarget, fastest);
  }
  return text + "." + (variants.empty() ? "" : " Variants: " + variants + ".");
}

// Returns the sentence for a single contender: the price of its accuracy.
std::string SingleText(const Results& results, const Analysis& analysis) {
  const Contender& only = analysis.contenders.front();
  const std::string measure = analysis.hasReference ? "relMSE " : "a noise (without bias) of ";
  std::string text = "On " + results.title + ", " + only.name + " reaches " + measure +
                     ShortNumber(*analysis.target) + " in " +
                     SecondsText(only.toTarget.seconds.value);
  for (const double error : RoundErrors()) {
    if (error < 2 * *analysis.target) break;
    const TimeToError coarse = FindTimeToError(analysis.Points(only.settings), error);
    if (coarse.kind != Kind::Reached) continue;
    const Measured ratio = Ratio(only.toTarget.seconds, coarse.seconds);
    return text + ", " + ShortNumber(ratio.value) + " times the time of " + ShortNumber(error) +
           ".";
  }
  return text + ".";
}

// Returns each contender's smallest error.
std::string LeastErrors(const Analysis& analysis) {
  std::string text;
  for (const Contender& contender : analysis.contenders) {
    const TimeToError all = FindTimeToError(analysis.Points(contender.settings), 0);
    if (!all.best.error.IsKnown()) continue;
    text += (text.empty() ? "Least errors: " : ", ") + contender.name + " " +
            ShortNumber(all.best.error.value) + " in " + SecondsText(all.best.seconds.value);
  }
  return text + (text.empty() ? "" : ".");
}

// Compares the smallest errors if no error can be reached by two contenders.
std::string WithoutTarget(const Results& results, const Analysis& analysis) {
  const std::string start = "On " + results.title + ", ";
  if (analysis.targetIsTooFine) return start + "the reference is too noisy to compare errors.";
  std::vector<std::pair<double, std::string>> least;
  for (const Contender& contender : analysis.contenders) {
    const TimeToError all = FindTimeToError(analysis.Points(contender.settings), 0);
    const Measured& error = all.best.error;
    if (error.IsKnown() && ReferenceShortfall(analysis.reference, error.value) <= 1)
      least.emplace_back(error.value, contender.name);
  }
  if (least.size() < 2) return start + "too few errors are known to compare them.";
  std::sort(least.begin(), least.end());
  return start + least[0].second + " has " + ShareText(least[0].first / least[1].first) +
         " of the error of " + least[1].second + " at best.";
}

// If every line is one setting: states the most efficient ones, relative to the first line.
std::string Efficiencies(const Results& results, const Analysis& analysis) {
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
                     MeasuredText(ratios[0].first) +
                     " times as efficient (1 / (error × seconds)) as " + base;
  for (std::size_t i = 1; i < std::min(kNamed, ratios.size()); ++i)
    text += (i == 1 ? "; next are “" : ", “") + ratios[i].second + "” with " +
            MeasuredText(ratios[i].first);
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
  analysis->contenders = FindContenders(*analysis);
  analysis->target = ChooseTarget(results, *analysis);
  analysis->targetIsTooFine = !analysis->target && IsTooNoisy(*analysis);
  if (analysis->target) {
    for (Line& line : analysis->lines)
      line.toTarget = FindTimeToError(analysis->Points(line.settings), *analysis->target);
    for (Contender& contender : analysis->contenders)
      contender.toTarget = FindTimeToError(analysis->Points(contender.settings), *analysis->target);
  }
  const bool isSingle = analysis->contenders.size() == 1;
  if (HasOnlySingleSettings(*analysis))
    analysis->headline = Efficiencies(results, *analysis);
  else if (!analysis->target)
    analysis->headline = WithoutTarget(results, *analysis);
  else
    analysis->headline = isSingle ? SingleText(results, *analysis) : Sentence(results, *analysis);
  const bool hasTimes = analysis->target && !(isSingle && analysis->lines.size() == 1);
  analysis->details = hasTimes ? Details(*analysis) : LeastErrors(*analysis);
  const auto add = [&](const std::string& text) {
    if (!text.empty()) analysis->details += (analysis->details.empty() ? "" : " ") + text;
  };
  add(MachinesText(results));
  if (!results.photonFile.empty())
    add("Photons were read from " + results.photonFile +
        ", and the times do not include shooting them.");
  analysis->lowerBounds = LowerBoundText(results, *analysis);
}

}  // namespace exphoton::study
