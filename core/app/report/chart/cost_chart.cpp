// SPDX-License-Identifier: BSD-2-Clause
// Chart draws error bars of one standard error, the slope of pure noise, the bias of each line, the
// error of a black picture, and the range in which the reference is too noisy.
#include "core/app/report/chart/cost_chart.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "core/app/analysis/numbers.h"
#include "core/app/report/chart/chart_frame.h"
#include "core/app/report/chart/label_placer.h"
#include "core/app/report/markup.h"

namespace exphoton::study {
namespace {

constexpr double kNameSize = 13, kNoteSize = 11.5, kNumberSize = 11;  // font sizes in page.css
constexpr double kMark = 4.5;                                         // radius

bool IsShown(const CostPoint& point) {
  return point.seconds.value > 0 && point.error.value > 0 && std::isfinite(point.error.value);
}

double SamplesIn(const std::string& text) {
  double value = 0;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

// Returns the settings of a line in groups that differ in samples or time only, in that order.
std::vector<std::vector<std::size_t>> GroupBySamples(const Results& results,
                                                     const Analysis& analysis, const Line& line) {
  std::map<std::string, std::vector<std::pair<double, std::size_t>>> groups;
  for (const std::size_t i : line.settings) {
    std::string others;
    double samples = 0;
    for (const auto& [name, value] : results.settings[analysis.settings[i].setting].parameters) {
      if (name == "spp" || name == "time")
        samples = SamplesIn(value);
      else
        others += "|" + name + "=" + value;
    }
    groups[others].emplace_back(samples, i);
  }
  std::vector<std::vector<std::size_t>> sorted;
  for (auto& [others, group] : groups) {
    std::sort(group.begin(), group.end());
    sorted.emplace_back();
    for (const auto& [samples, i] : group) sorted.back().push_back(i);
  }
  return sorted;
}

// Names the drawing for page.css, which shows one of the two.
const char* KindOf(const ChartShape& shape) { return shape.isNarrow ? "narrow" : "wide"; }

class Chart {
 public:
  Chart(const Results& results, const Analysis& analysis, const ChartFrame& frame)
      : results_(results),
        analysis_(analysis),
        frame_(frame),
        placer_(frame.Plot()),
        front_(analysis.Front()) {}

  Html Draw() {
    const ChartShape& shape = frame_.Shape();
    background_ += frame_.Axes(results_.clock == "wall" ? "seconds" : "CPU seconds",
                               analysis_.hasReference ? "relMSE" : "noise");
    AddReferenceLimit();
    AddFloors();
    for (std::size_t i = 0; i < analysis_.lines.size(); ++i) AddLine(i);
    for (std::size_t i = 0; i < analysis_.lines.size(); ++i) AddPrediction(i);
    for (std::size_t i = 0; i < analysis_.lines.size(); ++i) AddMarks(i);
    AddTarget();
    for (std::size_t i = 0; i < analysis_.lines.size(); ++i) AddName(i);
    AddNumbers();
    AddTargetNotes();
    AddSlope();
    AddNotes();
    return Fill("chart", {{"kind", KindOf(shape)},
                          {"width", shape.width},
                          {"height", shape.height},
                          {"content", background_ + lines_ + marks_ + texts_}});
  }
  // Returns the lines whose names found no place.
  const std::vector<std::size_t>& Unnamed() const { return unnamed_; }

 private:
  Point2d At(std::size_t setting) const {
    const CostPoint& cost = analysis_.settings[setting].cost;
    return frame_(cost.seconds.value, cost.error.value);
  }

  // Notes are placed after all names and numbers.
  struct Note {
    Point2d near;
    std::string text, classes;
  };

  // Shades the errors below ten times the reference's noise, which are not compared.
  void AddReferenceLimit() {
    if (!analysis_.reference.variance.IsKnown()) return;
    const double limit = analysis_.reference.variance.value / kMaxReferenceShare;
    if (limit < frame_.Y().Low()) return;
    const Box& plot = frame_.Plot();
    const double y = std::max(frame_.Y()(limit), plot.y0);
    background_ += SvgRect({plot.x0, y}, {plot.x1 - plot.x0, plot.y1 - y}, "limit");
    notes_.push_back({{plot.x0 + 4, plot.y1 - 8}, "grey: the reference is too noisy", "note"});
  }

  // Draws bias^2 of each line's most accurate setting if it is significant: at least two standard
  // errors and a tenth of the error. Draws the error of a black picture too.
  void AddFloors() {
    const Box& plot = frame_.Plot();
    for (std::size_t i = 0; i < analysis_.lines.size(); ++i) {
      const std::vector<std::size_t> front = analysis_.Front(analysis_.lines[i].settings);
      if (front.empty()) continue;
      const SettingResult& best = analysis_.settings[front.back()];
      const Measured& bias = best.separation.bias2;
      if (!bias.IsKnown() || !std::isfinite(bias.error) || bias.value < 2 * bias.error) continue;
      if (bias.value < .1 * best.cost.error.value || bias.value < frame_.Y().Low()) continue;
      const double y = frame_.Y()(bias.value);
      const double start = std::max(plot.x0, frame_.X()(best.cost.seconds.value) - 60);
      lines_ += SvgLine({start, y}, {plot.x1, y}, "floor " + ColorClass(i));
      notes_.push_back(
          {{plot.x1 - 60, y}, "bias² of " + analysis_.lines[i].label, "note text" + ColorClass(i)});
    }
    const double black = 2 * analysis_.usefulError;
    if (!(black < frame_.Y().High())) return;
    const double y = frame_.Y()(black);
    background_ += SvgLine({plot.x0, y}, {plot.x1, y}, "slope");
    notes_.push_back({{plot.x1 - 60, y}, "a black picture", "note"});
  }

  void AddLine(std::size_t number) {
    const Line& line = analysis_.lines[number];
    for (const auto& group : GroupBySamples(results_, analysis_, line)) {
      std::vector<Point2d> points;
      for (const std::size_t i : group)
        if (IsShown(analysis_.settings[i].cost)) points.push_back(At(i));
      lines_ += SvgPolyline(points, "samples " + ColorClass(number));
      for (std::size_t i = 1; i < points.size(); ++i) placer_.Discourage(points[i - 1], points[i]);
    }
    std::vector<Point2d> step;
    for (const std::size_t i : analysis_.Front(line.settings)) {
      if (!step.empty()) step.push_back({At(i).x, step.back().y});
      step.push_back(At(i));
    }
    lines_ += SvgPolyline(step, "envelope " + ColorClass(number));
    for (std::size_t i = 1; i < step.size(); ++i) placer_.Discourage(step[i - 1], step[i]);
  }

  // Draws the line's quote, as far as it lies inside the plot.
  void AddPrediction(std::size_t number) {
    const Prediction* const prediction = PredictionOf(results_, analysis_.lines[number].label);
    if (!prediction || !analysis_.hasReference || results_.clock == "wall") return;
    std::vector<Point2d> points;
    for (const Prediction::Point& point : prediction->points)
      if (frame_.Contains(point.seconds, point.error))
        points.push_back(frame_(point.seconds, point.error));
    lines_ += SvgPolyline(points, "expected " + ColorClass(number));
    for (std::size_t i = 1; i < points.size(); ++i) placer_.Discourage(points[i - 1], points[i]);
    if (points.size() > 1 && !std::exchange(hasPredictionNote_, true))
      notes_.push_back({points[points.size() / 2], "dashed: quotes", "note"});
  }

  void AddMarks(std::size_t number) {
    const Line& line = analysis_.lines[number];
    const std::vector<std::size_t> front = analysis_.Front(line.settings);
    for (const std::size_t i : line.settings) {
      if (!IsShown(analysis_.settings[i].cost)) continue;
      const bool isFront = std::find(front.begin(), front.end(), i) != front.end();
      AddMark(number, i, isFront);
    }
  }

  void AddMark(std::size_t line, std::size_t index, bool isFront) {
    const SettingResult& setting = analysis_.settings[index];
    const Measured &s = setting.cost.seconds, &e = setting.cost.error;
    const Point2d at = At(index);
    if (std::isfinite(e.error))
      AddWhisker({at.x, frame_.Y()(std::max(e.value - e.error, frame_.Y().Low()))},
                 {at.x, frame_.Y()(std::min(e.value + e.error, frame_.Y().High()))}, line);
    if (std::isfinite(s.error) && s.error < s.value)
      AddWhisker({frame_.X()(s.value - s.error), at.y}, {frame_.X()(s.value + s.error), at.y},
                 line);
    const double reach = 1.3 * kMark + 1;
    placer_.Block({at.x - reach, at.y - reach, at.x + reach, at.y + reach});
    const std::string title = analysis_.lines[line].label + ", " +
                              results_.settings[setting.setting].Text() + ": " +
                              SecondsText(s.value) + ", " + ShortNumber(e.value);
    marks_ +=
        SvgMarker(int(line), at, isFront ? kMark : kMark - 1.2,
                  std::string(isFront ? "point " : "point hollow ") + ColorClass(line), title);
  }

  void AddWhisker(Point2d a, Point2d b, std::size_t line) {
    lines_ += SvgLine(a, b, "whisker " + ColorClass(line));
    placer_.Block({std::min(a.x, b.x) - 1.5, std::min(a.y, b.y) - 1.5, std::max(a.x, b.x) + 1.5,
                   std::max(a.y, b.y) + 1.5});
  }

  // Draws the headline's error and each contender's time to it.
  void AddTarget() {
    if (!analysis_.target || *analysis_.target < frame_.Y().Low()) return;
    const double y = frame_.Y()(*analysis_.target);
    std::vector<double> places;
    for (const Contender& contender : analysis_.contenders) {
      if (contender.toTarget.kind != TimeToError::Kind::Reached) continue;
      const Point2d at{frame_.X()(contender.toTarget.seconds.value), y};
      places.push_back(at.x);
      marks_ += SvgMarker(0, at, 3, "ring " + ColorClass(contender.line), "");
      placer_.Block({at.x - 4, at.y - 4, at.x + 4, at.y + 4});
    }
    if (places.size() < 2) return;
    const auto [low, high] = std::minmax_element(places.begin(), places.end());
    background_ += SvgLine({*low, y}, {*high, y}, "target");
    placer_.Discourage({*low, y}, {*high, y});
  }

  // Writes the fastest contender's time, and the ratios of the others to it.
  void AddTargetNotes() {
    const Contender* fastest = nullptr;
    for (const Contender& contender : analysis_.contenders)
      if (contender.toTarget.kind == TimeToError::Kind::Reached &&
          (!fastest || contender.toTarget.seconds.value < fastest->toTarget.seconds.value))
        fastest = &contender;
    for (const Contender& contender : analysis_.contenders) {
      if (contender.toTarget.kind != TimeToError::Kind::Reached) continue;
      const double seconds = contender.toTarget.seconds.value;
      const std::string text = &contender == fastest
                                   ? SecondsText(seconds)
                                   : ShortNumber(seconds / fastest->toTarget.seconds.value) + "×";
      notes_.push_back(
          {frame_(seconds, *analysis_.target), text, "ratio text" + ColorClass(contender.line)});
    }
  }

  // Writes the line's name near the end of its front, or near its most accurate setting.
  void AddName(std::size_t number) {
    const Line& line = analysis_.lines[number];
    std::vector<std::size_t> front = analysis_.Front(line.settings);
    if (front.empty())
      for (const std::size_t i : ParetoFront(analysis_.Points(line.settings)))
        front.push_back(line.settings[i]);
    if (front.empty()) return;
    const auto at =
        placer_.Place(At(front.back()), TextWidth(line.label, kNameSize) + 8, kNameSize + 2);
    if (!at) return unnamed_.push_back(number);
    texts_ += SvgText({at->x, at->y + .36 * kNameSize}, line.label, "middle",
                      "name text" + ColorClass(number));
  }

  void AddNumbers() {
    int number = 0;
    for (const std::size_t i : front_) {
      const std::string text = std::to_string(++number);
      const auto at = placer_.Place(At(i), TextWidth(text, kNumberSize) + 6, kNumberSize);
      if (at) texts_ += SvgText({at->x, at->y + .36 * kNumberSize}, text, "middle", "number");
    }
  }

  // Draws the slope of pure noise, error ~ 1 / seconds, below all points.
  void AddSlope() {
    double product = 1e300;
    for (const SettingResult& setting : analysis_.settings)
      if (IsShown(setting.cost))
        product = std::min(product, setting.cost.seconds.value * setting.cost.error.value);
    product *= .7;
    const double left = std::max(frame_.X().Low(), product / frame_.Y().High());
    const double right = std::min(frame_.X().High(), product / frame_.Y().Low());
    if (!(left < right)) return;
    const Point2d a = frame_(left, product / left), b = frame_(right, product / right);
    background_ += SvgLine(a, b, "slope");
    placer_.Discourage(a, b);
    notes_.push_back({{a.x + .3 * (b.x - a.x), a.y + .3 * (b.y - a.y)}, "noise alone", "note"});
  }

  void AddNotes() {
    for (const Note& note : notes_) {
      const auto at = placer_.Place(note.near, TextWidth(note.text, kNoteSize) + 2, kNoteSize + 1);
      if (at)
        texts_ += SvgText({at->x, at->y + .36 * kNoteSize}, note.text, "middle", note.classes);
    }
  }

  const Results& results_;
  const Analysis& analysis_;
  const ChartFrame& frame_;
  LabelPlacer placer_;
  std::vector<std::size_t> front_, unnamed_;
  std::vector<Note> notes_;
  bool hasPredictionNote_ = false;
  Html background_, lines_, marks_, texts_;  // in the order of drawing
};

}  // namespace

Html CostChart(const Results& results, const Analysis& analysis, const ChartShape& shape) {
  ChartRange range;
  for (const SettingResult& setting : analysis.settings)
    if (IsShown(setting.cost)) range.Add(setting.cost);
  if (range.IsEmpty()) return Fill("no-chart");
  const ChartFrame frame(shape, range);
  Chart chart(results, analysis, frame);
  const Html drawn = chart.Draw();
  Html keys;
  for (const std::size_t line : chart.Unnamed())
    keys += Fill("line-key", {{"marker", LineMarker(line)}, {"label", analysis.lines[line].label}});
  if (keys.IsEmpty()) return drawn;
  return drawn + Fill("chart-keys", {{"kind", KindOf(shape)}, {"keys", keys}});
}

}  // namespace exphoton::study
