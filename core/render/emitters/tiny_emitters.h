// SPDX-License-Identifier: BSD-2-Clause
// TinyEmitters are still emitters whose projected boxes are smaller than the filter of a pixel. Few
// places of the filter meet them, so their light, seen directly, is estimated from places in their
// boxes instead:
//   the integral of f Le over a box of area A = the mean of A f(x) Le(x) over uniform places x,
// where f is the filter, with the integral 1 (docs/decisions/0106-lamps-smaller-than-pixels.md).
// With a lens, the box is the one that rays through one point of the lens show.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/lights/light.h"
#include "core/render/emitters/emitted_light.h"
#include "core/render/emitters/film_box.h"
#include "core/sampling/filter.h"

namespace exphoton {

class TinyEmitters {
 public:
  static constexpr int kMost = 4;  // emitters in the filter of a pixel
  // Places in a box, for one camera sample and one point of the lens. They are at least as dense as
  // the 16 places in the filter that other small emitters have (StillEmitters::kMostPlaces).
  static constexpr int kFewPlaces = 4, kManyPlaces = 16;
  // A lamp out of focus has a point of the lens for each support of the filter in its disk of blur,
  // up to this number, because few of them show the lamp in one pixel.
  static constexpr int kMostLensPlaces = 16;
  // Boxes that cover more than this share of the filter's area have many places.
  static constexpr double kFewShare = 1. / 4;

  struct Emitter {
    const Light* light;
    FilmBox box;                  // through the centre of the lens
    std::vector<FilmBox> border;  // through the points of Lens::border
    int places = 0;
    int lensPlaces = 1;  // points of the lens for one camera sample, a power of two
  };
  // What the camera shows through the points of its lens: the centre, and (-1, 0), (1, 0), (0, -1)
  // and (0, 1) of the unit disk. Without a lens there is no border.
  struct Lens {
    Matrix4 centre;
    std::vector<Matrix4> border;
  };

  // For pixels of `crop` of a picture. The filter must have no negative values and outlive this
  // object.
  TinyEmitters(const Filter& filter, const PixelBounds& full, const PixelBounds& crop)
      : filter_(filter), full_(full), crop_(crop) {}

  // Adds an emitter with these bounds. Returns whether it is tiny.
  bool Add(const Light& light, const Bounds3& bounds, const Lens& lens);
  // Ends the additions. Removes the emitters of pixels that have too many, and returns these
  // pixels.
  std::vector<Point2i> RemoveCrowds();

  // Returns the emitters that the filter of a pixel of the crop meets, as indices for operator[].
  struct InPixel {
    std::uint32_t pixel, emitter;  // row by row in the crop; in the order of additions
  };
  std::span<const InPixel> In(Point2i pixel) const;
  // Returns the light without what comes first from one of these emitters.
  EmittedLight Without(std::span<const InPixel> emitters, EmittedLight light) const;
  const Emitter& operator[](const InPixel& one) const { return emitters_[one.emitter]; }

  // Returns the filter's value at an offset from the centre of its pixel, for the integral 1. In
  // pixels^-2.
  Real FilterDensity(Point2 offset) const { return filter_.Evaluate(offset) / integral_; }
  // Returns a box of an emitter for a point of the lens, in the unit disk. It contains the smallest
  // one: film places depend linearly on the point, so the lower sides of that one are concave
  // functions of the point, and the upper sides are convex.
  static FilmBox BoxThrough(const Emitter& emitter, Point2 lens);
  // Returns the part of it that the filter of a pixel with this centre meets, in pixels.
  FilmBox BoxIn(const Emitter& emitter, Point2 centre, Point2 lens) const {
    return NearPixel(BoxThrough(emitter, lens), centre);
  }

 private:
  std::uint32_t IndexOf(int x, int y) const {
    return std::uint32_t(y - crop_.y0) * std::uint32_t(crop_.Width()) + std::uint32_t(x - crop_.x0);
  }
  FilmBox BoxOf(const Bounds3& bounds, const Matrix4& projection) const;
  void CountIn(const FilmBox& reach);
  FilmBox NearPixel(const FilmBox& box, Point2 centre) const {
    return box.Near(centre, double(filter_.XWidth()), double(filter_.YWidth()));
  }

  const Filter& filter_;
  PixelBounds full_, crop_;
  Real integral_ = 0;  // of the filter; 0: not known yet
  std::vector<Emitter> emitters_;
  std::vector<InPixel> pixels_;       // sorted by pixel
  std::vector<std::uint8_t> counts_;  // of emitters in each pixel, up to kMost + 1; empty: none
};

}  // namespace exphoton
