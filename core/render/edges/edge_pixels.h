// SPDX-License-Identifier: BSD-2-Clause
// EdgePixels finds the pixels that show more than one surface. Most noise of a picture with final
// gathers comes from them, so the renderer takes several camera samples there for each one of other
// pixels (SurfaceIntegrator::EdgeSamples). A few rays decide, one through each corner of the pixel.
// No camera sample uses them, so the decision is independent of the samples, and the picture stays
// unbiased. docs/decisions/0089-edges-of-surfaces.md has the measurements.
#pragma once

#include "core/imaging/film/camera.h"
#include "core/render/lazy_pixel_bytes.h"
#include "core/sampling/filter.h"
#include "core/scene/scene.h"

namespace exphoton {

class EdgePixels {
 public:
  // `window` holds the pixels to ask for. The scene and the camera must outlive this object.
  EdgePixels(const Scene& scene, const Camera& camera, const Filter& filter,
             const PixelBounds& window);

  const PixelBounds& Window() const { return window_; }
  // Returns whether rays through the pixel meet different surfaces or materials, or a surface that
  // turns away. They form a grid over the inner half of the filter's width and height, at most a
  // pixel apart: at least over the pixel, and at most 2 pixels to each side. Several threads may
  // ask at once. These rays are not counted.
  bool Has(Point2i pixel) const {
    return values_.At(pixel, [this](Point2i p) { return int(IsOnEdge(p)); }) > 0;
  }

 private:
  bool IsOnEdge(Point2i pixel) const;

  const Scene& scene_;
  const Camera& camera_;
  Real xReach_, yReach_;  // from the centre of a pixel to the ends of the grid, in pixels
  PixelBounds window_;
  mutable LazyPixelBytes values_;
};

}  // namespace exphoton
