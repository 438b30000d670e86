// SPDX-License-Identifier: BSD-2-Clause
// ChartFrame holds the scales of a chart of error against seconds and draws its grid and axes.
#pragma once

#include <vector>

#include "core/app/report/chart/cost_chart.h"
#include "core/app/report/chart/label_placer.h"
#include "core/app/report/markup.h"

namespace exphoton::study {

// Ranges of the data.
struct ChartRange {
  double lowX = 1e300, highX = 0, lowY = 1e300, highY = 0;
  void Add(const CostPoint& point);
  bool IsEmpty() const { return highX == 0; }
};

class ChartFrame {
 public:
  ChartFrame(const ChartShape& shape, const ChartRange& range);

  Point2d operator()(double seconds, double error) const { return {x_(seconds), y_(error)}; }
  bool Contains(double seconds, double error) const {
    return seconds >= x_.Low() && seconds <= x_.High() && error >= y_.Low() && error <= y_.High();
  }
  const LogScale& X() const { return x_; }
  const LogScale& Y() const { return y_; }
  const Box& Plot() const { return plot_; }
  const ChartShape& Shape() const { return shape_; }

  // Returns grid, ticks and titles. The right axis of a wide chart shows the root of the error,
  // which halves all slopes.
  Html Axes(const std::string& secondsName, const std::string& errorName) const;

 private:
  Html TicksOfX() const;
  Html TicksOfY() const;
  Html TicksOfRoot() const;

  ChartShape shape_;
  Box plot_;
  LogScale x_, y_;
};

// Returns the text of a tick: "0.02", "10⁻⁴".
std::string TickText(double value);

}  // namespace exphoton::study
