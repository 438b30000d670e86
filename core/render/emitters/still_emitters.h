// SPDX-License-Identifier: BSD-2-Clause
// StillEmitters are the surfaces that emit light and do not move. They are often much brighter than
// their surroundings, so their edges make up much of a picture's noise. The renderer therefore
// replaces their light, seen directly or over specular surfaces, by the mean over several places of
// the film. Boxes of emitters tell which pixels may show them directly, and a few rays for each
// pixel which ones show them over specular surfaces.
#pragma once

#include <algorithm>
#include <bit>
#include <optional>
#include <vector>

#include "core/imaging/film/camera.h"
#include "core/imaging/film/film.h"
#include "core/render/emitters/emitted_light.h"
#include "core/render/emitters/tiny_emitters.h"
#include "core/render/lazy_pixel_bytes.h"
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
  // The places of one camera sample, its own included: for reflections and for emitters whose boxes
  // cover at most kSmallArea pixels, and for others.
  static constexpr int kMostPlaces = 16, kPlaces = 4;
  static constexpr double kSmallArea = 64;
  // PlacesForReflections allows about this number of rays in the specular trees of a sample,
  // because a tree behind glass may have dozens of rays. A box of an emitter in the same pixel may
  // ask for more places.
  static constexpr int kRaysForReflections = 32;

  // Finds the pixels that may show one of the emitters. None is found if the camera moves or has no
  // projection, or if the filter has negative values. With a lens, only tiny emitters are found
  // that are seen directly. `depth` is SurfaceIntegrator::EmissionDepth. Scene and filter must
  // outlive this object.
  StillEmitters(const FilmView& view, int depth);

  // Returns whether the pixels are those of this film.
  bool AreOf(const Film& film) const { return crop_ == film.Crop(); }

  // Returns the number of places for each sample of a pixel, a power of two: 1 if the filter of the
  // pixel meets no box of an emitter that is not tiny. A box that contains the camera, or that lies
  // within the box of a moving emitter, does not count.
  int PlacesIn(Point2i pixel) const {
    return pixels_.empty() || !crop_.Contains(pixel.x, pixel.y) ? 1 : pixels_[IndexOf(pixel)];
  }
  // Returns place i of n for a sample whose own place, number 0, is u. Each place is uniform in
  // [0,1)^2 if u is. The places lie in n rows and n columns.
  static Point2 Place(Point2 u, int i, int n);

  // Returns the number of places for each sample of a pixel whose filter meets pixels in which
  // specular surfaces show an emitter, and 1 for other pixels. At least 1 and at most 4 pixels on
  // each side count. raysIn(pixel) is the number of rays in a specular tree of a pixel, or 0 if
  // none of a few trees meets an emitter. It must be a function of the pixel alone, which may lie
  // outside of the film.
  template <class RaysIn>  // signature: int(Point2i)
  int PlacesForReflections(Point2i pixel, const RaysIn& raysIn) const {
    if (!reflections_) return 1;
    int most = 0;
    for (int y = pixel.y - reach_.y; y <= pixel.y + reach_.y; ++y)
      for (int x = pixel.x - reach_.x; x <= pixel.x + reach_.x; ++x)
        most = std::max(most, reflections_->At({x, y}, raysIn));
    if (most == 0) return 1;
    return int(std::bit_floor(unsigned(std::clamp(kRaysForReflections / most, 1, kMostPlaces))));
  }

  // Returns the tiny emitters. PlacesIn does not count them, except in crowds.
  const TinyEmitters& Tiny() const { return tiny_; }

  // Returns the light of the emitter that the camera ray meets first.
  EmittedLight FirstAlong(Ray ray) const;
  // Returns their light along the camera ray and along specular rays that follow from it. `rays`
  // counts the rays.
  EmittedLight AllAlong(const RayDifferential& ray, const LiContext& sample,
                        RayCounters* rays) const {
    return LightAlong(ray, *this, depth_, sample, rays);
  }
  bool Contain(const SurfaceInteraction& surface) const { return IsStill(surface.motion); }
  bool MayMeet(const Ray&) const { return true; }

 private:
  std::size_t IndexOf(Point2i pixel) const {
    return std::size_t(pixel.y - crop_.y0) * std::size_t(crop_.Width()) +
           std::size_t(pixel.x - crop_.x0);
  }
  bool IsStill(const Motion* motion) const { return !motion || !motion->MovesWithin(shutter_); }
  // Returns the pixels whose reflections count for a pixel of the crop.
  PixelBounds Reached() const {
    return {crop_.x0 - reach_.x, crop_.y0 - reach_.y, crop_.x1 + reach_.x, crop_.y1 + reach_.y};
  }
  void Mark(const Light& light, const Bounds3& box, const TinyEmitters::Lens& projections,
            const FilmView& view);
  void MarkPixel(Point2i pixel, int places);

  const Scene& scene_;
  int depth_;
  Point2i reach_;  // the farthest pixel whose reflections count for a pixel, by axis
  Interval shutter_;
  PixelBounds crop_;
  std::vector<std::uint8_t> pixels_;  // places, of the crop row by row; empty: none
  TinyEmitters tiny_;
  mutable std::optional<LazyPixelBytes> reflections_;  // of the crop and what filters reach
};

}  // namespace exphoton
