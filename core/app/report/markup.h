// SPDX-License-Identifier: BSD-2-Clause
// Text of HTML and SVG: escaping, numbers, base64, and the few shapes that charts are drawn with.
// Colours are classes of the page's style sheet (page_style.cpp), so that they follow light and
// dark.
#pragma once

#include <string>
#include <vector>

namespace exphoton::study {

std::string Escape(const std::string& text);
std::string Base64(const std::string& bytes);
std::string Coordinate(double value);  // at most two decimals
std::string Percent(double share);     // "12.34%" of 0.1234

inline constexpr int kSeriesColors = 6;  // classes c0 ... c5
inline constexpr int kPhaseColors = 8;   // classes p0 ... p7

struct Point2d {
  double x = 0, y = 0;
};

std::string SvgLine(Point2d a, Point2d b, const std::string& classes);
std::string SvgRect(Point2d corner, Point2d size, const std::string& classes);
// anchor: start, middle or end.
std::string SvgText(Point2d at, const std::string& text, const std::string& anchor,
                    const std::string& classes = "");
std::string SvgPolyline(const std::vector<Point2d>& points, const std::string& classes);
// A circle, square, triangle, diamond, cross or down triangle, by its number; `title` appears on
// hover.
std::string SvgMarker(int shape, Point2d at, double size, const std::string& classes,
                      const std::string& title);

// A logarithmic scale from data to pixels, with ticks at 1, 2 and 5, or closer.
class LogScale {
 public:
  // Covers [low, high] and some space around it.
  LogScale(double low, double high, double pixelLow, double pixelHigh);
  double operator()(double value) const;
  double Low() const { return low_; }
  double High() const { return high_; }
  struct Tick {
    double value;
    bool isDecade;
  };
  std::vector<Tick> Ticks() const;

 private:
  std::vector<Tick> TicksAt(const std::vector<double>& digits) const;
  double low_, high_, pixelLow_, pixelHigh_;
};

}  // namespace exphoton::study
