// SPDX-License-Identifier: BSD-2-Clause
// StillEmitters are the surfaces that emit light and do not move. They are often much brighter than
// their surroundings, so their edges make up much of a picture's noise. The renderer therefore
// replaces their light, seen directly, by the mean over several places of the film.
#pragma once

#include <optional>
#include <vector>

#include "core/imaging/film/camera.h"
#include "core/imaging/film/film.h"
#include "core/sampling/filter.h"
#include "core/scene/scene.h"

namespace exphoton {

// What the camera and the filter show of the scene.
struct FilmView {
  const Scene& scene;
  const Camera& camera;
  const Filter& filter;
  const Film& film;
};

class StillEmitters {
 public:
  // The places of one camera sample, its own included: for emitters whose boxes cover at most
  // kSmallArea pixels, and for others.
  static constexpr int kPlacesOfSmall = 16, kPlaces = 4;
  static constexpr double kSmallArea = 64;

  // Finds the pixels that may show one of the emitters. None is found if the camera moves or has a
  // lens or no projection. The scene must outlive this object.
  explicit StillEmitters(const FilmView& view);

  // Returns the number of places for each sample of a pixel, a power of two: 1 if the filter of the
  // pixel meets no box of an emitter. A box that contains the camera, or that lies within the box
  // of a moving emitter, does not count.
  int PlacesIn(Point2i pixel) const {
    return pixels_.empty() || !crop_.Contains(pixel.x, pixel.y) ? 1 : pixels_[IndexOf(pixel)];
  }
  // Returns place i of n for a sample whose own place, number 0, is u. Each place is uniform in
  // [0,1)^2 if u is. The places lie in n rows and n columns.
  static Point2 Place(Point2 u, int i, int n);
  // Returns the light of the first surface along the ray, 0 if it is not a still emitter. Returns
  // nullopt if a medium dims this light.
  std::optional<Spectrum> Along(Ray ray) const;

 private:
  std::size_t IndexOf(Point2i pixel) const {
    return std::size_t(pixel.y - crop_.y0) * std::size_t(crop_.Width()) +
           std::size_t(pixel.x - crop_.x0);
  }
  void Mark(const Bounds3& box, const FilmView& view);

  const Scene& scene_;
  Interval shutter_;
  PixelBounds crop_;
  std::vector<std::uint8_t> pixels_;  // places, of the crop row by row; empty: none
};

}  // namespace exphoton
