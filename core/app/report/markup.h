// SPDX-License-Identifier: BSD-2-Clause
// These functions produce the shapes of the charts, numbers and base64. Colours are CSS classes of
// page.css, so they adapt to light and dark mode.
#pragma once

#include <string>
#include <vector>

#include "core/app/report/template.h"

namespace exphoton::study {

std::string Base64(const std::string& bytes);
std::string Percent(double share);  // "12.34%" for 0.1234

inline constexpr int kSeriesColors = 6;  // CSS classes c0 to c5
inline constexpr int kPhaseColors = 8;   // CSS classes p0 to p7

struct Point2d {
  double x = 0, y = 0;
};

Html SvgLine(Point2d a, Point2d b, const std::string& classes);
Html SvgRect(Point2d corner, Point2d size, const std::string& classes);
// `anchor` is start, middle or end.
Html SvgText(Point2d at, const std::string& text, const std::string& anchor,
             const std::string& classes);
// Centres the text at the point and turns it clockwise.
Html SvgTurnedText(Point2d at, double degrees, const std::string& text, const std::string& classes);
Html SvgPolyline(const std::vector<Point2d>& points, const std::string& classes);
std::string ColorClass(std::size_t line);  // "c0" for line 0
// Draws the marker for a line number: a circle, square, triangle, diamond, pentagon or inverted
// triangle. `title` appears on hover, unless it is empty.
Html SvgMarker(int shape, Point2d at, double size, const std::string& classes,
               const std::string& title);

Html LineMarker(std::size_t line);  // colour and shape of a line, to be put into a text

// LogScale maps data to pixels logarithmically, with ticks at 1, 2 and 5 per decade, or denser.
class LogScale {
 public:
  // Covers [low, high] with a small margin.
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
