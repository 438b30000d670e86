// SPDX-License-Identifier: BSD-2-Clause
// FilmBox is the smallest rectangle of the film that contains the projections of some points.
#pragma once

#include "core/imaging/film/film.h"
#include "core/math/bounds.h"
#include "core/math/transform.h"

namespace exphoton {

class FilmBox {
 public:
  // Contains the part of the box that lies in front of a camera with this projection. `full` is the
  // whole picture.
  FilmBox(const Bounds3& box, const Matrix4& worldToNdc, const PixelBounds& full);

  // Empty boxes have no place on the film.
  bool IsEmpty() const { return !(x0_ <= x1_ && y0_ <= y1_); }
  bool Contains(Point2 place) const {
    const double x = double(place.x), y = double(place.y);
    return x >= x0_ && x <= x1_ && y >= y0_ && y <= y1_;
  }
  double Area() const { return (x1_ - x0_) * (y1_ - y0_); }  // in pixels
  // Returns the pixels of `crop` whose filters of these half-widths overlap the rectangle.
  PixelBounds Pixels(const PixelBounds& crop, double xWidth, double yWidth) const;
  // Makes the rectangle contain another one of the same picture.
  void Extend(const FilmBox& other);
  // A way between two rectangles.
  struct Way {
    const FilmBox &from, &to;
    double t;  // in [0, 1]
  };
  // Returns the rectangle whose x range is interpolated along one way, and whose y range is
  // interpolated along another.
  static FilmBox Between(const Way& x, const Way& y);
  // Returns the rectangle with a margin on each side, in pixels.
  FilmBox Grown(double margin) const;
  // Returns the part within the half-widths from a place of the film, in pixels. It may be empty.
  FilmBox Near(Point2 place, double xWidth, double yWidth) const;
  // Returns a place of the film, in pixels, that is uniform in the rectangle if u is in [0,1)^2.
  Point2 At(Point2 u) const {
    return {Real(x0_ + double(u.x) * (x1_ - x0_)), Real(y0_ + double(u.y) * (y1_ - y0_))};
  }

 private:
  // A homogeneous point before its division by w.
  struct Clip {
    double x, y, w;
  };
  static Clip Project(const Matrix4& worldToNdc, const Point3& p);
  void Add(const Clip& p);
  void AddEdge(const Clip& a, const Clip& b);

  PixelBounds full_;
  double x0_ = double(kInfinity), x1_ = -x0_, y0_ = x0_, y1_ = -x0_;  // in pixels
};

}  // namespace exphoton
