// SPDX-License-Identifier: BSD-2-Clause
// StillEmitters projects the boxes of emitters to the film.
#include "core/render/emitters/still_emitters.h"

#include <algorithm>
#include <cmath>

#include "core/render/splat_weights.h"

namespace exphoton {
namespace {

// Returns the farthest pixel that a filter of this half-width meets, but at most 4, because all
// pixels up to it are examined. It is at least the next one, because the trees in a pixel miss
// small emitters.
int Reach(Real width) { return int(std::clamp(width + Real(.5), Real(1), Real(4))); }

// Returns the box with a margin for the rounding of camera rays and of intersections, which is
// proportional to the coordinates.
Bounds3 WithMargin(const Bounds3& box, const Point3& eye) {
  constexpr int kRoundings = 16;
  Real largest = 0;
  for (const Point3& p : {box.min, box.max, eye})
    largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  const Real margin = Gamma(kRoundings) * largest;
  const Vector3 by{margin, margin, margin};
  return {box.min - by, box.max + by};
}

// Returns the projections through points of the lens; nullopt: the camera does not know them all.
std::optional<TinyEmitters::Lens> ProjectionsOf(const Camera& camera, bool hasLens) {
  TinyEmitters::Lens projections{camera.WorldToNdc(), {}};
  if (projections.centre == Matrix4()) return std::nullopt;
  if (!hasLens) return projections;
  for (const Point2& border : {Point2(-1, 0), Point2(1, 0), Point2(0, -1), Point2(0, 1)}) {
    const auto through = camera.WorldToNdcThrough(border);
    if (!through) return std::nullopt;
    projections.border.push_back(*through);
  }
  return projections;
}

}  // namespace

StillEmitters::StillEmitters(const FilmView& view, int depth)
    : scene_(view.scene),
      depth_(depth),
      reach_{Reach(view.filter.XWidth()), Reach(view.filter.YWidth())},
      shutter_(view.camera.Shutter()),
      crop_(view.film.Crop()),
      tiny_(view.filter, view.film.Full(), view.film.Crop()) {
  const RequiredFeatures& features = view.scene.Features();
  if (!features.Needs(Feature::Motion)) shutter_.max = shutter_.min;
  const bool hasLens = view.camera.HasLens() && features.Needs(Feature::Lens);
  const auto projections = ProjectionsOf(view.camera, hasLens);
  const bool isBlurred = view.camera.MovesWithin(shutter_);
  if (isBlurred || HasNegativeValues(view.filter) || !projections) return;
  const Point3 eye = view.camera.CameraToWorld().ApplyPoint({});
  const std::vector<Bounds3> moving = view.scene.Primitives().MovingEmitters(shutter_);
  for (const auto& light : view.scene.Lights()) {
    const auto box = light->IsDelta() ? std::nullopt : light->Bounds();
    if (!box) continue;
    if (!hasLens && depth > 0 && features.Needs(Feature::Specular) && !reflections_)
      reflections_.emplace(Reached());
    if (box->Contains(eye)) continue;
    const bool moves = std::any_of(moving.begin(), moving.end(), [&](const Bounds3& swept) {
      return swept.Contains(box->min) && swept.Contains(box->max);
    });
    if (!moves) Mark(*light, *box, *projections, view);
  }
  for (const Point2i& pixel : tiny_.RemoveCrowds()) MarkPixel(pixel, kMostPlaces);
}

void StillEmitters::Mark(const Light& light, const Bounds3& box,
                         const TinyEmitters::Lens& projections, const FilmView& view) {
  const Point3 eye = view.camera.CameraToWorld().ApplyPoint({});
  if (tiny_.Add(light, WithMargin(box, eye), projections) || !projections.border.empty()) return;
  const FilmBox onFilm(box, projections.centre, view.film.Full());
  const PixelBounds marked =
      onFilm.Pixels(crop_, double(view.filter.XWidth()), double(view.filter.YWidth()));
  if (marked.IsEmpty()) return;
  const int places = onFilm.Area() <= kSmallArea ? kMostPlaces : kPlaces;
  for (int y = marked.y0; y < marked.y1; ++y)
    for (int x = marked.x0; x < marked.x1; ++x) MarkPixel({x, y}, places);
}

void StillEmitters::MarkPixel(Point2i pixel, int places) {
  pixels_.resize(std::size_t(crop_.Width()) * std::size_t(crop_.Height()), std::uint8_t(1));
  std::uint8_t& known = pixels_[IndexOf(pixel)];
  known = std::uint8_t(std::max(int(known), places));
}

Point2 StillEmitters::Place(Point2 u, int i, int n) {
  int reversed = 0;
  for (int bit = 1, end = n / 2; bit < n; bit *= 2, end /= 2)
    if (i & bit) reversed |= end;
  const auto shifted = [&](Real v, int steps) {
    const Real sum = v + Real(steps) / Real(n);
    return sum < 1 ? sum : sum - 1;
  };
  return {shifted(u.x, i), shifted(u.y, reversed)};
}

EmittedLight StillEmitters::FirstAlong(Ray ray) const {
  const auto first = scene_.IntersectPoint(ray);
  if (!first) return {};
  const AreaLight* const light = scene_.Primitives().Attributes(first->hit).areaLight;
  if (!light || !IsStill(first->motion)) return {};
  const SurfaceInteraction surface = scene_.Complete(ray, first->hit);
  ray.tMax = first->hit.t;
  EmittedLight emitted;
  emitted.first = light->L(surface, surface.uv, surface.wo) * scene_.Transmittance(ray);
  emitted.lamp = light;
  return emitted;
}

}  // namespace exphoton
