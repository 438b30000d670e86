// SPDX-License-Identifier: BSD-2-Clause
// LabelPlacer finds places for the texts of a chart so that they cover no mark, no error bar and no
// other text. It tries places round a point at growing distance, and prefers those off the lines.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/app/report/markup.h"

namespace exphoton::study {

struct Box {
  double x0, y0, x1, y1;
};

// Returns an upper estimate of the width of a text, for the widest usual sans-serif fonts.
double TextWidth(const std::string& text, double fontSize);

class LabelPlacer {
 public:
  // Labels stay inside the area.
  explicit LabelPlacer(const Box& area) : area_(area) {}

  // Labels never cover this box.
  void Block(const Box& box) { blocked_.push_back(box); }
  // Labels avoid this line if another place is as near.
  void Discourage(Point2d from, Point2d to);

  // Returns the centre of a box of this size near the point, and blocks it. Returns nullopt if all
  // places within reach are taken.
  std::optional<Point2d> Place(Point2d near, double width, double height);

 private:
  bool IsFree(const Box& box) const;
  double LinesIn(const Box& box) const;

  Box area_;
  std::vector<Box> blocked_;
  std::vector<Point2d> discouraged_;  // points on lines, close together
};

}  // namespace exphoton::study
