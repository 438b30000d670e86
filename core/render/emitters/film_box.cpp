// SPDX-License-Identifier: BSD-2-Clause
// FilmBox projects the edges of a box.
#include "core/render/emitters/film_box.h"

#include <algorithm>
#include <cmath>

namespace exphoton {

FilmBox::FilmBox(const Bounds3& box, const Matrix4& worldToNdc, const PixelBounds& full)
    : full_(full) {
  for (int corner = 0; corner < 8; ++corner)
    for (int axis = 1; axis < 8; axis *= 2)
      if (!(corner & axis))
        AddEdge(Project(worldToNdc, box.Corner(corner)),
                Project(worldToNdc, box.Corner(corner | axis)));
}

FilmBox::Clip FilmBox::Project(const Matrix4& worldToNdc, const Point3& p) {
  const auto row = [&](const std::array<double, 4>& m) {
    return m[0] * double(p.x) + m[1] * double(p.y) + m[2] * double(p.z) + m[3];
  };
  return {row(worldToNdc.m[0]), row(worldToNdc.m[1]), row(worldToNdc.m[3])};
}

void FilmBox::Add(const Clip& p) {
  const double x = (p.x / p.w + 1) / 2 * full_.Width(), y = (1 - p.y / p.w) / 2 * full_.Height();
  if (!std::isfinite(x) || !std::isfinite(y)) return;
  x0_ = std::min(x0_, x), x1_ = std::max(x1_, x);
  y0_ = std::min(y0_, y), y1_ = std::max(y1_, y);
}

// Adds the projections of the part of the edge from a to b that lies in front of the camera.
void FilmBox::AddEdge(const Clip& a, const Clip& b) {
  constexpr double kNear = 1e-6;  // of the distance of the farther end
  const double least = kNear * std::max(a.w, b.w);
  if (!(least > 0)) return;
  for (const auto& [from, to] : {std::pair(a, b), std::pair(b, a)}) {
    if (from.w >= least) {
      Add(from);
      continue;
    }
    const double t = (least - from.w) / (to.w - from.w);
    Add({from.x + t * (to.x - from.x), from.y + t * (to.y - from.y), least});
  }
}

PixelBounds FilmBox::Pixels(const PixelBounds& crop, double xWidth, double yWidth) const {
  const auto within = [](double v, int low, int high) {
    return int(std::clamp(v, double(low), double(high)));
  };
  if (IsEmpty()) return {crop.x0, crop.y0, crop.x0, crop.y0};
  return {within(std::floor(x0_ - .5 - xWidth), crop.x0, crop.x1),
          within(std::floor(y0_ - .5 - yWidth), crop.y0, crop.y1),
          within(std::ceil(x1_ + .5 + xWidth), crop.x0, crop.x1),
          within(std::ceil(y1_ + .5 + yWidth), crop.y0, crop.y1)};
}

void FilmBox::Extend(const FilmBox& other) {
  x0_ = std::min(x0_, other.x0_), x1_ = std::max(x1_, other.x1_);
  y0_ = std::min(y0_, other.y0_), y1_ = std::max(y1_, other.y1_);
}

FilmBox FilmBox::Between(const Way& x, const Way& y) {
  FilmBox box = x.from;
  box.x0_ += x.t * (x.to.x0_ - x.from.x0_), box.x1_ += x.t * (x.to.x1_ - x.from.x1_);
  box.y0_ = y.from.y0_ + y.t * (y.to.y0_ - y.from.y0_);
  box.y1_ = y.from.y1_ + y.t * (y.to.y1_ - y.from.y1_);
  return box;
}

FilmBox FilmBox::Grown(double margin) const {
  FilmBox grown = *this;
  grown.x0_ -= margin, grown.x1_ += margin;
  grown.y0_ -= margin, grown.y1_ += margin;
  return grown;
}

FilmBox FilmBox::Near(Point2 place, double xWidth, double yWidth) const {
  FilmBox near = *this;
  near.x0_ = std::max(x0_, double(place.x) - xWidth);
  near.x1_ = std::min(x1_, double(place.x) + xWidth);
  near.y0_ = std::max(y0_, double(place.y) - yWidth);
  near.y1_ = std::min(y1_, double(place.y) + yWidth);
  return near;
}

}  // namespace exphoton
