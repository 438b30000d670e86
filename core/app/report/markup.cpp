// SPDX-License-Identifier: BSD-2-Clause
// This file writes SVG shapes and numbers, independent of studies.
#include "core/app/report/markup.h"

#include <cmath>
#include <cstdint>
#include <numbers>

namespace exphoton::study {
namespace {

// Returns the attribute "points" of polygons and polylines.
std::string PointsText(const std::vector<Point2d>& points) {
  std::string text;
  for (const Point2d& p : points) text += Coordinate(p.x) + "," + Coordinate(p.y) + " ";
  return text;
}

std::vector<Point2d> Polygon(int corners, double turn, double radius, Point2d centre) {
  std::vector<Point2d> points;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * std::numbers::pi * (i + turn) / corners - std::numbers::pi / 2;
    points.push_back({centre.x + radius * std::cos(angle), centre.y + radius * std::sin(angle)});
  }
  return points;
}

}  // namespace

std::string Base64(const std::string& bytes) {
  constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    for (std::size_t j = 0; j < 3; ++j)
      group = group << 8 | (i + j < bytes.size() ? static_cast<unsigned char>(bytes[i + j]) : 0u);
    for (std::size_t j = 0; j < 4; ++j)
      text += i + j <= bytes.size() ? kDigits[group >> (18 - 6 * j) & 63u] : '=';
  }
  return text;
}

std::string Percent(double share) { return Coordinate(100 * share) + "%"; }

Html SvgLine(Point2d a, Point2d b, const std::string& classes) {
  return Fill("svg-line",
              {{"x1", a.x}, {"y1", a.y}, {"x2", b.x}, {"y2", b.y}, {"classes", classes}});
}

Html SvgRect(Point2d corner, Point2d size, const std::string& classes) {
  return Fill("svg-rect", {{"x", corner.x},
                           {"y", corner.y},
                           {"width", size.x},
                           {"height", size.y},
                           {"classes", classes}});
}

Html SvgText(Point2d at, const std::string& text, const std::string& anchor,
             const std::string& classes) {
  return Fill("svg-text",
              {{"x", at.x}, {"y", at.y}, {"anchor", anchor}, {"classes", classes}, {"text", text}});
}

Html SvgTurnedText(Point2d at, double degrees, const std::string& text,
                   const std::string& classes) {
  return Fill(
      "svg-turned-text",
      {{"x", at.x}, {"y", at.y}, {"degrees", degrees}, {"classes", classes}, {"text", text}});
}

Html SvgPolyline(const std::vector<Point2d>& points, const std::string& classes) {
  return Fill("svg-polyline", {{"points", PointsText(points)}, {"classes", classes}});
}

std::string ColorClass(std::size_t line) {
  return "c" + std::to_string(line % std::size_t(kSeriesColors));
}

Html SvgMarker(int shape, Point2d at, double size, const std::string& classes,
               const std::string& text) {
  const Html title = text.empty() ? Html() : Fill("svg-title", {{"text", text}});
  // Each round of colours starts with another shape, so lines of the same colour have two shapes.
  const int kind = (shape + shape / kSeriesColors) % kSeriesColors;
  if (kind == 0)
    return Fill(
        "svg-circle-marker",
        {{"x", at.x}, {"y", at.y}, {"radius", size}, {"classes", classes}, {"title", title}});
  const int corners = kind == 1 || kind == 3 ? 4 : kind == 4 ? 5 : 3;
  const double turn = kind == 1 || kind == 5 ? .5 : 0;
  return Fill("svg-polygon-marker",
              {{"points", PointsText(Polygon(corners, turn, 1.25 * size, at))},
               {"classes", classes},
               {"title", title}});
}

Html LineMarker(std::size_t line) {
  return Fill("line-marker",
              {{"shape", SvgMarker(int(line), {}, 5, "point " + ColorClass(line), "")}});
}

LogScale::LogScale(double low, double high, double pixelLow, double pixelHigh)
    : pixelLow_(pixelLow), pixelHigh_(pixelHigh) {
  constexpr double kSpace = .06;
  const double a = std::log(low), b = std::log(std::max(high, low * 1.5));
  low_ = std::exp(a - kSpace * (b - a));
  high_ = std::exp(b + kSpace * (b - a));
}

double LogScale::operator()(double value) const {
  const double t = std::log(value / low_) / std::log(high_ / low_);
  return pixelLow_ + t * (pixelHigh_ - pixelLow_);
}

std::vector<LogScale::Tick> LogScale::Ticks() const {
  constexpr std::size_t kFewest = 4;
  std::vector<Tick> ticks = TicksAt({1, 2, 5});
  if (ticks.size() < kFewest) ticks = TicksAt({1, 1.5, 2, 3, 4, 5, 6, 7, 8, 9});
  return ticks;
}

std::vector<LogScale::Tick> LogScale::TicksAt(const std::vector<double>& digits) const {
  std::vector<Tick> ticks;
  const int first = int(std::floor(std::log10(low_))), last = int(std::ceil(std::log10(high_)));
  for (int power = first; power <= last; ++power) {
    for (const double digit : digits) {
      const double value = digit * std::pow(10., power);
      if (value >= low_ && value <= high_) ticks.push_back({value, digit == 1});
    }
  }
  return ticks;
}

}  // namespace exphoton::study
