// SPDX-License-Identifier: BSD-2-Clause
// This file makes the bars of time and error. The length of a bar is logarithmic, so that slow
// settings fit beside fast ones; its colours divide it linearly.
#include <algorithm>
#include <cmath>

#include "core/app/analysis/headline/headline.h"
#include "core/app/analysis/numbers.h"
#include "core/app/report/markup.h"
#include "core/app/report/page_sections.h"
#include "core/app/report/page_tables.h"

namespace exphoton::study {
namespace {

struct Part {
  double value;
  std::string classes, title;
};

// BarScale gives lengths from 0 to 1 for values of one column. Bars begin a factor of 2 below the
// smallest value, so that each can be seen.
class BarScale {
 public:
  void Add(double value) {
    if (!std::isfinite(value) || value <= 0) return;
    low_ = std::min(low_, value / 2);
    high_ = std::max(high_, value);
  }
  double operator()(double value) const {
    if (!(value > low_)) return 0;
    return std::log(value / low_) / std::log(high_ / low_);
  }
  // Draws the decades between both ends.
  Html Ticks() const {
    Html ticks;
    if (!(high_ > low_)) return ticks;
    for (double v = std::pow(10, std::ceil(std::log10(low_))); v <= high_; v *= 10)
      ticks += Fill("bar-tick", {{"x", Percent((*this)(v))}});
    return ticks;
  }
  // Returns the first and the last decade: "0.1 to 10", or an empty text.
  std::string Text() const {
    if (!(high_ > low_)) return "";
    return ShortNumber(low_) + " to " + ShortNumber(high_);
  }

 private:
  double low_ = 1e300, high_ = 0;
};

Html Bars(const std::vector<Part>& parts, const BarScale& scale) {
  double total = 0;
  for (const Part& part : parts) total += part.value;
  const double length = scale(total);
  Html shapes;
  double at = 0;
  for (const Part& part : parts) {
    const double width = total > 0 ? length * part.value / total : 0;
    if (!(width > 0)) continue;
    shapes += Fill("bar", {{"x", Percent(at)},
                           {"width", Percent(width)},
                           {"classes", part.classes},
                           {"title", part.title}});
    at += width;
  }
  return Fill("bars", {{"bars", shapes + scale.Ticks()}});
}

// Returns the names of all phases, in the order of a render. Each phase has a colour.
std::vector<std::string> PhaseNames(const Analysis& analysis,
                                    const std::vector<std::size_t>& shown) {
  std::vector<std::string> names{"parse",    "accelerator", "shoot", "photon maps",
                                 "radiance", "render",      "share", "write"};
  for (const std::size_t i : shown)
    for (const auto& phase : analysis.settings[i].phases)
      if (phase.first != "other" &&
          std::find(names.begin(), names.end(), phase.first) == names.end())
        names.push_back(phase.first);
  names.push_back("other");
  return names;
}

std::size_t PhaseColor(std::size_t i) { return i % std::size_t(kPhaseColors); }

class BarTable {
 public:
  BarTable(const Results& results, const Analysis& analysis)
      : results_(results),
        analysis_(analysis),
        shown_(FrontsByLine(analysis)),
        columns_(results, analysis, shown_),
        names_(PhaseNames(analysis, shown_)) {
    for (const std::size_t i : shown_) {
      times_.Add(analysis.settings[i].cost.seconds.value);
      errors_.Add(analysis.settings[i].cost.error.value);
    }
  }

  Html Section() const {
    if (shown_.empty()) return {};
    Html keys, rows;
    for (std::size_t i = 0; i < names_.size(); ++i)
      keys += Fill("phase-key", {{"color", PhaseColor(i)}, {"name", names_[i]}});
    for (const std::size_t i : shown_) rows += Row(i);
    return Fill("bar-section", {{"keys", keys},
                                {"clock", results_.clock == "wall" ? "seconds" : "CPU seconds"},
                                {"times", times_.Text()},
                                {"errors", errors_.Text()},
                                {"parameters", columns_.Heads()},
                                {"rows", rows}});
  }

 private:
  std::vector<Part> TimeParts(const SettingResult& setting) const {
    std::vector<Part> parts;
    for (std::size_t i = 0; i < names_.size(); ++i)
      for (const auto& [phase, seconds] : setting.phases)
        if (phase == names_[i])
          parts.push_back(
              {seconds, "p" + std::to_string(PhaseColor(i)), phase + ": " + SecondsText(seconds)});
    return parts;
  }

  Html Row(std::size_t index) const {
    const SettingResult& setting = analysis_.settings[index];
    const Separation& s = setting.separation;
    const double bias = s.bias2.IsKnown() ? std::max(0., s.bias2.value) : 0;
    const double noise = s.variance.IsKnown() ? s.variance.value : setting.cost.error.value;
    const std::vector<Part> error{{noise, "noise", "noise: " + ShortNumber(noise)},
                                  {bias, "bias", "bias²: " + ShortNumber(bias)}};
    const Measured worth =
        RelativeEfficiency(analysis_, setting, analysis_.settings[shown_.front()]);
    return Fill("bar-row",
                {{"line", LineCell(analysis_, index)},
                 {"parameters", columns_.Cells(setting)},
                 {"time", Bars(TimeParts(setting), times_)},
                 {"seconds", MeasuredCell(setting.cost.seconds)},
                 {"error", Bars(error, errors_)},
                 {"noise", ThousandthsCell(s.variance)},
                 {"bias", ThousandthsCell(s.bias2)},
                 {"efficiency", worth.IsKnown() ? ShortNumber(worth.value) + "×" : "–"}});
  }

  const Results& results_;
  const Analysis& analysis_;
  std::vector<std::size_t> shown_;
  ParameterColumns columns_;
  std::vector<std::string> names_;
  BarScale times_, errors_;
};

}  // namespace

Html BarSection(const Results& results, const Analysis& analysis) {
  return BarTable(results, analysis).Section();
}

}  // namespace exphoton::study
