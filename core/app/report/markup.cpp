// SPDX-License-Identifier: BSD-2-Clause
// This file writes HTML and SVG text, independent of studies.
#include "core/app/report/markup.h"

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <numbers>

namespace exphoton::study {
namespace {

std::string At(const char* x, const char* y, Point2d p) {
  return std::string(" ") + x + "=\"" + Coordinate(p.x) + "\" " + y + "=\"" + Coordinate(p.y) +
         "\"";
}

std::string Class(const std::string& classes) {
  return classes.empty() ? "" : " class=\"" + classes + "\"";
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

std::string Escape(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    switch (c) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      default:
        escaped += c;
    }
  }
  return escaped;
}

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

std::string Coordinate(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2f", std::isfinite(value) ? value : 0);
  std::string number = text;
  while (number.back() == '0') number.pop_back();
  if (number.back() == '.') number.pop_back();
  return number == "-0" ? "0" : number;
}

std::string Percent(double share) { return Coordinate(100 * share) + "%"; }

std::string SvgLine(Point2d a, Point2d b, const std::string& classes) {
  return "<line" + At("x1", "y1", a) + At("x2", "y2", b) + Class(classes) + "/>";
}

std::string SvgRect(Point2d corner, Point2d size, const std::string& classes) {
  return "<rect" + At("x", "y", corner) + At("width", "height", size) + Class(classes) + "/>";
}

std::string SvgText(Point2d at, const std::string& text, const std::string& anchor,
                    const std::string& classes) {
  return "<text" + At("x", "y", at) + " text-anchor=\"" + anchor + "\"" + Class(classes) + ">" +
         Escape(text) + "</text>";
}

std::string SvgPolyline(const std::vector<Point2d>& points, const std::string& classes) {
  std::string text = "<polyline points=\"";
  for (const Point2d& p : points) text += Coordinate(p.x) + "," + Coordinate(p.y) + " ";
  return text + "\"" + Class(classes) + "/>";
}

std::string SvgMarker(int shape, Point2d at, double size, const std::string& classes,
                      const std::string& title) {
  const std::string end = "><title>" + Escape(title) + "</title></";
  // Each round of colours starts with another shape, so lines of the same colour have two shapes.
  const int kind = (shape + shape / kSeriesColors) % kSeriesColors;
  if (kind == 0)
    return "<circle" + At("cx", "cy", at) + " r=\"" + Coordinate(size) + "\"" + Class(classes) +
           end + "circle>";
  const int corners = kind == 1 || kind == 3 ? 4 : kind == 4 ? 5 : 3;
  const double turn = kind == 1 || kind == 5 ? .5 : 0;
  std::string points;
  for (const Point2d& p : Polygon(corners, turn, 1.25 * size, at))
    points += Coordinate(p.x) + "," + Coordinate(p.y) + " ";
  return "<polygon points=\"" + points + "\"" + Class(classes) + end + "polygon>";
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
