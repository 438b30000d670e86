// SPDX-License-Identifier: BSD-2-Clause
// Ticks that would be closer together than their texts allow are drawn without texts.
#include "core/app/report/chart/chart_frame.h"

#include <algorithm>
#include <cmath>

#include "core/app/analysis/numbers.h"
#include "core/base/format.h"

namespace exphoton::study {
namespace {

constexpr double kPlain = .9995e-3;  // smaller values are written with powers of ten

Box PlotOf(const ChartShape& shape) {
  constexpr double kBottom = 42;
  if (shape.isNarrow) return {46, 28, shape.width - 8, shape.height - kBottom};
  return {66, 10, shape.width - 66, shape.height - kBottom};
}

// Returns which of these ticks have room for a text. Decades come first.
std::vector<bool> FindLabelled(const std::vector<LogScale::Tick>& ticks,
                               const std::vector<double>& places, double spacing) {
  std::vector<bool> isLabelled(ticks.size(), false);
  for (const bool wantsDecades : {true, false}) {
    for (std::size_t i = 0; i < ticks.size(); ++i) {
      if (ticks[i].isDecade != wantsDecades) continue;
      bool isFree = true;
      for (std::size_t k = 0; k < ticks.size(); ++k)
        if (isLabelled[k] && std::abs(places[k] - places[i]) < spacing) isFree = false;
      isLabelled[i] = isFree;
    }
  }
  return isLabelled;
}

}  // namespace

void ChartRange::Add(const CostPoint& point) {
  lowX = std::min(lowX, point.seconds.value);
  highX = std::max(highX, point.seconds.value);
  lowY = std::min(lowY, point.error.value);
  highY = std::max(highY, point.error.value);
}

ChartFrame::ChartFrame(const ChartShape& shape, const ChartRange& range)
    : shape_(shape),
      plot_(PlotOf(shape)),
      x_(range.lowX, range.highX, plot_.x0, plot_.x1),
      y_(range.lowY, range.highY, plot_.y1, plot_.y0) {}

Html ChartFrame::TicksOfX() const {
  const double spacing = shape_.isNarrow ? 40 : 46;
  const std::vector<LogScale::Tick> ticks = x_.Ticks();
  std::vector<double> places;
  for (const LogScale::Tick& tick : ticks) places.push_back(x_(tick.value));
  const std::vector<bool> isLabelled = FindLabelled(ticks, places, spacing);
  Html shapes;
  for (std::size_t i = 0; i < ticks.size(); ++i) {
    const double x = places[i];
    shapes += SvgLine({x, plot_.y0}, {x, plot_.y1}, ticks[i].isDecade ? "grid major" : "grid");
    if (isLabelled[i])
      shapes += SvgText({x, plot_.y1 + 16}, TickText(ticks[i].value), "middle", "tick");
  }
  return shapes;
}

Html ChartFrame::TicksOfY() const {
  constexpr double kSpacing = 18;
  const std::vector<LogScale::Tick> ticks = y_.Ticks();
  std::vector<double> places;
  for (const LogScale::Tick& tick : ticks) places.push_back(y_(tick.value));
  const std::vector<bool> isLabelled = FindLabelled(ticks, places, kSpacing);
  Html shapes;
  for (std::size_t i = 0; i < ticks.size(); ++i) {
    const double y = places[i];
    shapes += SvgLine({plot_.x0, y}, {plot_.x1, y}, ticks[i].isDecade ? "grid major" : "grid");
    // Texts such as "5×10⁻⁴" would be wider than the margin.
    if (isLabelled[i] && (ticks[i].isDecade || ticks[i].value > kPlain))
      shapes += SvgText({plot_.x0 - 6, y + 4}, TickText(ticks[i].value), "end", "tick");
  }
  return shapes;
}

Html ChartFrame::TicksOfRoot() const {
  constexpr double kSpacing = 18;
  const LogScale root(std::sqrt(y_.Low()), std::sqrt(y_.High()), plot_.y1, plot_.y0);
  std::vector<LogScale::Tick> ticks;
  std::vector<double> places;
  for (const LogScale::Tick& tick : root.Ticks()) {
    const double y = y_(tick.value * tick.value);
    if (y < plot_.y0 || y > plot_.y1) continue;
    ticks.push_back(tick);
    places.push_back(y);
  }
  const std::vector<bool> isLabelled = FindLabelled(ticks, places, kSpacing);
  Html shapes;
  for (std::size_t i = 0; i < ticks.size(); ++i) {
    if (!isLabelled[i]) continue;
    shapes += SvgLine({plot_.x1, places[i]}, {plot_.x1 + 4, places[i]}, "grid major");
    shapes += SvgText({plot_.x1 + 7, places[i] + 4}, Format("%.3g %%", 100 * ticks[i].value),
                      "start", "tick");
  }
  return shapes;
}

Html ChartFrame::Axes(const std::string& secondsName, const std::string& errorName) const {
  const double middleX = (plot_.x0 + plot_.x1) / 2, middleY = (plot_.y0 + plot_.y1) / 2;
  Html axes = TicksOfX() + TicksOfY();
  axes += SvgText({middleX, shape_.height - 8}, secondsName, "middle", "axis");
  if (shape_.isNarrow)
    return axes + SvgText({8, 16}, errorName + "; noise alone: slope −1", "start", "axis");
  axes += TicksOfRoot();
  axes += SvgText({plot_.x1, shape_.height - 8}, "1, 2, …: nothing beats these settings", "end",
                  "axis");
  axes += SvgTurnedText({15, middleY}, -90, errorName + ", noise alone: slope −1", "axis");
  return axes +
         SvgTurnedText({shape_.width - 12, middleY}, 90, "√" + errorName + ", slope −1/2", "axis");
}

std::string TickText(double value) {
  if (value >= kPlain) return ShortNumber(value);
  const int power = int(std::floor(std::log10(value) + 1e-9));
  const double digit = value / std::pow(10., power);
  return (digit < 1.01 ? "" : ShortNumber(digit, 1) + "×") + "10" + Superscript(power);
}

}  // namespace exphoton::study
