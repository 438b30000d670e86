// SPDX-License-Identifier: BSD-2-Clause
// EdgePixels compares the surfaces at a few places of a pixel.
#include "core/render/edges/edge_pixels.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/render/sharing/gather_fragments.h"

namespace exphoton {
namespace {

// What a ray sees first.
struct Place {
  Point3 p;
  Normal3 n;  // geometric normal on the side of the viewer
  const Material* material;
};

std::optional<Place> Seen(const Scene& scene, const Ray& ray) {
  const auto found = scene.IntersectPoint(ray);
  if (!found) return std::nullopt;
  const SurfaceInteraction surface = scene.Complete(ray, found->hit);
  return Place{surface.p, FaceForward(surface.ng, surface.wo), found->material};
}

bool ShowOneSurface(const std::optional<Place>& a, const std::optional<Place>& b) {
  if (!a || !b) return !a && !b;
  return a->material == b->material && LieOnOneSurface(a->p, a->n, b->p, b->n);
}

// Returns half of a filter's half-width, within limits: the whole pixel counts, and no more than 25
// rays are needed.
Real GridReach(Real width) { return std::clamp(width / 2, Real(.5), Real(2)); }

}  // namespace

EdgePixels::EdgePixels(const Scene& scene, const Camera& camera, const Filter& filter,
                       const PixelBounds& window)
    : scene_(scene),
      camera_(camera),
      xReach_(GridReach(filter.XWidth())),
      yReach_(GridReach(filter.YWidth())),
      window_(window),
      values_(window) {}

bool EdgePixels::IsOnEdge(Point2i pixel) const {
  const int columns = int(std::ceil(2 * xReach_)), rows = int(std::ceil(2 * yReach_));
  const Point2 first(Real(pixel.x) + Real(.5) - xReach_, Real(pixel.y) + Real(.5) - yReach_);
  const Point2 step(2 * xReach_ / Real(columns), 2 * yReach_ / Real(rows));
  // Without motion, everything stays where it is when the shutter opens.
  const Real time = scene_.Features().Needs(Feature::Motion) ? Real(.5) : Real(0);
  const auto seenAt = [&](int x, int y) {
    CameraSample sample;
    sample.film = first + Point2(step.x * Real(x), step.y * Real(y));
    sample.lens = Point2(Real(.5), Real(.5));
    sample.time = time;
    return Seen(scene_, camera_.GenerateRay(sample, false));
  };
  const std::optional<Place> corner = seenAt(0, 0);
  for (int y = rows; y >= 0; --y)
    for (int x = columns; x >= 0; --x)
      if ((x > 0 || y > 0) && !ShowOneSurface(corner, seenAt(x, y))) return true;
  return false;
}

}  // namespace exphoton
