// SPDX-License-Identifier: BSD-2-Clause
// The search is greedy: a label that is placed stays where it is. Charts have a few dozen labels,
// so each search may compare all boxes.
#include "core/app/report/chart/label_placer.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace exphoton::study {
namespace {

constexpr double kStep = 4;  // pixels between points of a line, and between distances

bool Overlaps(const Box& a, const Box& b) {
  return a.x0 < b.x1 && b.x0 < a.x1 && a.y0 < b.y1 && b.y0 < a.y1;
}

Box BoxAt(Point2d centre, double width, double height) {
  return {centre.x - width / 2, centre.y - height / 2, centre.x + width / 2, centre.y + height / 2};
}

}  // namespace

double TextWidth(const std::string& text, double fontSize) {
  constexpr double kWidthOfLetter = .66;
  const auto letters = std::count_if(text.begin(), text.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xc0u) != 0x80u;  // not a continuation byte of UTF-8
  });
  return kWidthOfLetter * fontSize * double(letters);
}

void LabelPlacer::Discourage(Point2d from, Point2d to) {
  const int count = 1 + int(std::hypot(to.x - from.x, to.y - from.y) / kStep);
  for (int i = 0; i <= count; ++i) {
    const double t = double(i) / count;
    discouraged_.push_back({from.x + t * (to.x - from.x), from.y + t * (to.y - from.y)});
  }
}

bool LabelPlacer::IsFree(const Box& box) const {
  if (box.x0 < area_.x0 || box.x1 > area_.x1 || box.y0 < area_.y0 || box.y1 > area_.y1)
    return false;
  return std::none_of(blocked_.begin(), blocked_.end(),
                      [&](const Box& other) { return Overlaps(box, other); });
}

double LabelPlacer::LinesIn(const Box& box) const {
  return double(std::count_if(discouraged_.begin(), discouraged_.end(), [&](const Point2d& p) {
    return p.x > box.x0 && p.x < box.x1 && p.y > box.y0 && p.y < box.y1;
  }));
}

std::optional<Point2d> LabelPlacer::Place(Point2d near, double width, double height) {
  constexpr int kDirections = 16;
  constexpr double kGap = 3, kFarthest = 72, kPriceOfLine = 2.5;
  std::optional<Point2d> best;
  double least = 1e300;
  for (double distance = kGap; distance <= kFarthest; distance += kStep) {
    for (int i = 0; i < kDirections; ++i) {
      // The first direction is to the right, and the others alternate above and below it.
      const double angle = std::numbers::pi * ((i + 1) / 2) / (kDirections / 2) * (i % 2 ? -1 : 1);
      const Point2d centre{near.x + std::cos(angle) * (width / 2 + distance),
                           near.y + std::sin(angle) * (height / 2 + distance)};
      const Box box = BoxAt(centre, width, height);
      const double price = distance + .2 * i;
      if (price >= least || !IsFree(box)) continue;
      const double full = price + kPriceOfLine * LinesIn(box);
      if (full >= least) continue;
      least = full;
      best = centre;
    }
  }
  if (best) Block(BoxAt(*best, width, height));
  return best;
}

}  // namespace exphoton::study
