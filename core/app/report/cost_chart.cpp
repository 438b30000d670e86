// SPDX-License-Identifier: BSD-2-Clause
// Chart plots error against seconds. It also shows error bars of one standard error, the slope of
// pure noise, the bias of each line, and the range in which the reference is too noisy.
#include "core/app/report/cost_chart.h"

#include <algorithm>
#include <cmath>

#include "core/app/report/markup.h"

namespace exphoton::study {
namespace {

constexpr double kWidth = 820, kHeight = 500;
constexpr double kLeft = 66, kRight = 20, kTop = 18, kBottom = 54;

bool IsShown(const CostPoint& point) {
  return point.seconds.value > 0 && point.error.value > 0 && std::isfinite(point.error.value);
}

class Chart {
 public:
  Chart(const Results& results, const Analysis& analysis, double lowX, double highX, double lowY,
        double highY)
      : results_(results),
        analysis_(analysis),
        x_(lowX, highX, kLeft, kWidth - kRight),
        y_(lowY, highY, kHeight - kBottom, kTop) {}

  Html Draw() {
    AddGrid();
    AddReferenceLimit();
    AddSlope();
    AddFloors();
    for (std::size_t i = 0; i < analysis_.lines.size(); ++i) AddLine(i);
    AddNumbers();
    for (const auto& [number, end] : ends_) AddName(number, end);
    return Fill("chart", {{"width", kWidth}, {"height", kHeight}, {"content", shapes_ + notes_}});
  }

 private:
  void AddGrid() {
    for (const LogScale::Tick& tick : x_.Ticks()) {
      const double x = x_(tick.value);
      shapes_ += SvgLine({x, kTop}, {x, kHeight - kBottom}, tick.isDecade ? "grid major" : "grid");
      shapes_ += SvgText({x, kHeight - kBottom + 18}, ShortNumber(tick.value), "middle", "tick");
    }
    for (const LogScale::Tick& tick : y_.Ticks()) {
      const double y = y_(tick.value);
      shapes_ += SvgLine({kLeft, y}, {kWidth - kRight, y}, tick.isDecade ? "grid major" : "grid");
      shapes_ += SvgText({kLeft - 8, y + 4}, ShortNumber(tick.value), "end", "tick");
    }
    shapes_ += SvgText({(kLeft + kWidth - kRight) / 2, kHeight - 12},
                       results_.clock == "wall" ? "seconds" : "CPU seconds", "middle", "axis");
    const std::string name = analysis_.hasReference ? "error (relMSE)" : "noise (relMSE)";
    shapes_ += SvgTurnedText({16, (kTop + kHeight - kBottom) / 2}, -90, name, "axis");
  }

  // Shades the errors below ten times the reference's noise, which are not compared.
  void AddReferenceLimit() {
    if (!analysis_.reference.variance.IsKnown()) return;
    const double limit = analysis_.reference.variance.value / kMaxReferenceShare;
    if (limit < y_.Low()) return;
    const double y = std::max(y_(limit), kTop);
    shapes_ += SvgRect({kLeft, y}, {kWidth - kRight - kLeft, kHeight - kBottom - y}, "limit");
    AddNoteAtRight(std::min(y + 15, kHeight - kBottom - 4),
                   "below: the reference is too noisy to compare", "note");
  }

  // Draws the slope of pure noise, error ~ 1 / seconds, below all points.
  void AddSlope() {
    double product = 1e300;
    for (const SettingResult& setting : analysis_.settings)
      if (IsShown(setting.cost))
        product = std::min(product, setting.cost.seconds.value * setting.cost.error.value);
    product *= .7;
    const double left = std::max(x_.Low(), product / y_.High());
    const double right = std::min(x_.High(), product / y_.Low());
    if (!(left < right)) return;
    const Point2d a{x_(left), y_(product / left)}, b{x_(right), y_(product / right)};
    shapes_ += SvgLine(a, b, "slope");
    const double angle = std::atan2(b.y - a.y, b.x - a.x) * 180 / 3.14159265358979;
    const Point2d at{a.x + .4 * (b.x - a.x), a.y + .4 * (b.y - a.y) + 16};
    notes_ += SvgTurnedText(at, angle, "pure noise: its root falls with slope −1/2", "note");
  }

  // Draws bias^2 of each line's most accurate setting if it is significant: at least two standard
  // errors and a tenth of the error.
  void AddFloors() {
    for (std::size_t i = 0; i < analysis_.lines.size(); ++i) {
      const auto points = analysis_.Points(analysis_.lines[i]);
      const auto front = ParetoFront(points);
      if (front.empty()) continue;
      const SettingResult& best = analysis_.settings[analysis_.lines[i].settings[front.back()]];
      const Measured& bias = best.separation.bias2;
      if (!bias.IsKnown() || !std::isfinite(bias.error) || bias.value < 2 * bias.error) continue;
      if (bias.value < .1 * best.cost.error.value || bias.value < y_.Low()) continue;
      const double y = y_(bias.value), x = x_(best.cost.seconds.value);
      const double start = std::max(kLeft, x - 90), end = kWidth - kRight;
      shapes_ += SvgLine({start, y}, {end, y}, "floor " + ColorClass(i));
      AddNoteAtRight(y - 5, "bias² of " + analysis_.lines[i].label, "note text" + ColorClass(i));
    }
  }

  void AddLine(std::size_t number) {
    const Line& line = analysis_.lines[number];
    const auto points = analysis_.Points(line);
    const auto front = ParetoFront(points);
    std::vector<Point2d> corners;
    for (const std::size_t i : front)
      corners.push_back({x_(points[i].seconds.value), y_(points[i].error.value)});
    shapes_ += SvgPolyline(corners, "series " + ColorClass(number));
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (!IsShown(points[i])) continue;
      const bool isFront = std::find(front.begin(), front.end(), i) != front.end();
      AddPoint(number, line.settings[i], isFront);
    }
    if (!corners.empty()) ends_.emplace_back(number, corners.back());
  }

  // Writes the line's name at its end, moved down if it would cover other text or markers.
  void AddName(std::size_t number, Point2d end) {
    constexpr double kHeightOfText = 14, kWidthOfLetter = 9.8;
    const std::string& label = analysis_.lines[number].label;
    const double width = kWidthOfLetter * double(label.size());
    const bool isRight = end.x + 11 + width > kWidth - kRight;
    Point2d at{isRight ? end.x - width : end.x + 11, isRight ? end.y + 20 : end.y + 4};
    const auto overlaps = [&](const Point2d& p, double otherWidth) {
      return at.x < p.x + otherWidth && p.x < at.x + width && std::abs(at.y - p.y) < kHeightOfText;
    };
    for (int tries = 0; tries < 12; ++tries) {
      const auto hit = std::find_if(taken_.begin(), taken_.end(), [&](const auto& name) {
        return overlaps(name.first, name.second);
      });
      if (hit == taken_.end()) break;
      at.y = hit->first.y + kHeightOfText + 1;
    }
    taken_.emplace_back(at, width);
    shapes_ += SvgText(at, label, "start", "name text" + ColorClass(number));
  }

  void AddPoint(std::size_t line, std::size_t index, bool isFront) {
    const SettingResult& setting = analysis_.settings[index];
    const Measured &s = setting.cost.seconds, &e = setting.cost.error;
    const Point2d at{x_(s.value), y_(e.value)};
    if (std::isfinite(e.error)) {
      const double low = std::max(e.value - e.error, y_.Low());
      shapes_ +=
          SvgLine({at.x, y_(low)}, {at.x, y_(e.value + e.error)}, "whisker " + ColorClass(line));
    }
    if (std::isfinite(s.error) && s.error < s.value)
      shapes_ += SvgLine({x_(s.value - s.error), at.y}, {x_(s.value + s.error), at.y},
                         "whisker " + ColorClass(line));
    taken_.emplace_back(Point2d{at.x - 5, at.y + 4}, 10);
    const std::string title = analysis_.lines[line].label + ", " +
                              results_.settings[setting.setting].Text() + ": " +
                              SecondsText(s.value) + ", " + ShortNumber(e.value);
    shapes_ +=
        SvgMarker(int(line), at, isFront ? 5 : 4,
                  std::string(isFront ? "point " : "point hollow ") + ColorClass(line), title);
  }

  void AddNumbers() {
    int number = 0;
    for (const std::size_t i : FrontOf(analysis_)) {
      const CostPoint& cost = analysis_.settings[i].cost;
      shapes_ += SvgText({x_(cost.seconds.value) - 7, y_(cost.error.value) + 16},
                         std::to_string(++number), "end", "number");
    }
  }

  // Writes a note at the right edge, moved up if it would cover another one.
  void AddNoteAtRight(double y, const std::string& text, const std::string& classes) {
    constexpr double kHeightOfNote = 14;
    std::sort(notesAtRight_.rbegin(), notesAtRight_.rend());
    for (const double other : notesAtRight_)
      if (std::abs(y - other) < kHeightOfNote) y = other - kHeightOfNote;
    notesAtRight_.push_back(y);
    notes_ += SvgText({kWidth - kRight - 6, y}, text, "end", classes);
  }

  const Results& results_;
  const Analysis& analysis_;
  LogScale x_, y_;
  Html shapes_, notes_;               // notes are in front of all lines
  std::vector<double> notesAtRight_;  // their baselines
  // Left ends and widths of texts and markers, in SVG units. Names must not cover these.
  std::vector<std::pair<Point2d, double>> taken_;
  std::vector<std::pair<std::size_t, Point2d>> ends_;  // end point of each line, by line number
};

}  // namespace

std::vector<std::size_t> FrontOf(const Analysis& analysis) {
  return ParetoFront(analysis.Points());
}

Html CostChart(const Results& results, const Analysis& analysis) {
  double lowX = 1e300, highX = 0, lowY = 1e300, highY = 0;
  for (const SettingResult& setting : analysis.settings) {
    const CostPoint& p = setting.cost;
    if (!IsShown(p)) continue;
    lowX = std::min(lowX, p.seconds.value);
    highX = std::max(highX, p.seconds.value);
    lowY = std::min(lowY, p.error.value);
    highY = std::max(highY, p.error.value);
  }
  if (highX == 0) return Fill("no-chart");
  return Chart(results, analysis, lowX, highX, lowY, highY).Draw();
}

}  // namespace exphoton::study
