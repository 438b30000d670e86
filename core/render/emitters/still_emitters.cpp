// SPDX-License-Identifier: BSD-2-Clause
// StillEmitters projects the boxes of emitters to the film.
#include "core/render/emitters/still_emitters.h"

#include <algorithm>
#include <cmath>

namespace exphoton {
namespace {

// A homogeneous point before its division by w.
struct Clip {
  double x, y, w;
};

Clip Project(const Matrix4& worldToNdc, const Point3& p) {
  const auto row = [&](const std::array<double, 4>& m) {
    return m[0] * double(p.x) + m[1] * double(p.y) + m[2] * double(p.z) + m[3];
  };
  return {row(worldToNdc.m[0]), row(worldToNdc.m[1]), row(worldToNdc.m[3])};
}

// FilmBox is the smallest rectangle of the film that contains the projections of some points, in
// pixels.
class FilmBox {
 public:
  explicit FilmBox(const PixelBounds& full) : full_(full) {}

  void Add(const Clip& p) {
    const double x = (p.x / p.w + 1) / 2 * full_.Width(), y = (1 - p.y / p.w) / 2 * full_.Height();
    if (!std::isfinite(x) || !std::isfinite(y)) return;
    x0_ = std::min(x0_, x), x1_ = std::max(x1_, x);
    y0_ = std::min(y0_, y), y1_ = std::max(y1_, y);
  }
  double Area() const { return (x1_ - x0_) * (y1_ - y0_); }
  // Returns the pixels of `crop` whose filters of these half-widths overlap the rectangle.
  PixelBounds Pixels(const PixelBounds& crop, double xWidth, double yWidth) const {
    const auto within = [](double v, int low, int high) {
      return int(std::clamp(v, double(low), double(high)));
    };
    if (!(x0_ <= x1_)) return {crop.x0, crop.y0, crop.x0, crop.y0};
    return {within(std::floor(x0_ - .5 - xWidth), crop.x0, crop.x1),
            within(std::floor(y0_ - .5 - yWidth), crop.y0, crop.y1),
            within(std::ceil(x1_ + .5 + xWidth), crop.x0, crop.x1),
            within(std::ceil(y1_ + .5 + yWidth), crop.y0, crop.y1)};
  }

 private:
  PixelBounds full_;
  double x0_ = double(kInfinity), x1_ = -x0_, y0_ = x0_, y1_ = -x0_;
};

// Adds the projections of the part of the edge from a to b that lies in front of the camera.
void AddEdge(const Clip& a, const Clip& b, FilmBox* box) {
  constexpr double kNear = 1e-6;  // of the distance of the farther end
  const double least = kNear * std::max(a.w, b.w);
  if (!(least > 0)) return;
  for (const auto& [from, to] : {std::pair(a, b), std::pair(b, a)}) {
    if (from.w >= least) {
      box->Add(from);
      continue;
    }
    const double t = (least - from.w) / (to.w - from.w);
    box->Add({from.x + t * (to.x - from.x), from.y + t * (to.y - from.y), least});
  }
}

// Returns the farthest pixel that a filter of this half-width meets, but at most 4, because all
// pixels up to it are examined. It is at least the next one, because the trees in a pixel miss
// small emitters.
int Reach(Real width) { return int(std::clamp(width + Real(.5), Real(1), Real(4))); }

}  // namespace

StillEmitters::StillEmitters(const FilmView& view, int depth)
    : scene_(view.scene),
      depth_(depth),
      reach_{Reach(view.filter.XWidth()), Reach(view.filter.YWidth())},
      shutter_(view.camera.Shutter()),
      crop_(view.film.Crop()) {
  const RequiredFeatures& features = view.scene.Features();
  if (!features.Needs(Feature::Motion)) shutter_.max = shutter_.min;
  const bool hasLens = view.camera.HasLens() && features.Needs(Feature::Lens);
  const bool isBlurred = hasLens || view.camera.MovesWithin(shutter_);
  if (isBlurred || view.camera.WorldToNdc() == Matrix4()) return;
  const Point3 eye = view.camera.CameraToWorld().ApplyPoint({});
  const std::vector<Bounds3> moving = view.scene.Primitives().MovingEmitters(shutter_);
  for (const auto& light : view.scene.Lights()) {
    const auto box = light->IsDelta() ? std::nullopt : light->Bounds();
    if (!box) continue;
    if (depth > 0 && features.Needs(Feature::Specular) && !reflections_)
      reflections_.emplace(Reached());
    if (box->Contains(eye)) continue;
    const bool moves = std::any_of(moving.begin(), moving.end(), [&](const Bounds3& swept) {
      return swept.Contains(box->min) && swept.Contains(box->max);
    });
    if (!moves) Mark(*box, view);
  }
}

void StillEmitters::Mark(const Bounds3& box, const FilmView& view) {
  const Matrix4 worldToNdc = view.camera.WorldToNdc();
  FilmBox onFilm(view.film.Full());
  for (int corner = 0; corner < 8; ++corner)
    for (int axis = 1; axis < 8; axis *= 2)
      if (!(corner & axis))
        AddEdge(Project(worldToNdc, box.Corner(corner)),
                Project(worldToNdc, box.Corner(corner | axis)), &onFilm);
  const PixelBounds marked =
      onFilm.Pixels(crop_, double(view.filter.XWidth()), double(view.filter.YWidth()));
  if (marked.IsEmpty()) return;
  const int places = onFilm.Area() <= kSmallArea ? kMostPlaces : kPlaces;
  pixels_.resize(std::size_t(crop_.Width()) * std::size_t(crop_.Height()), std::uint8_t(1));
  for (int y = marked.y0; y < marked.y1; ++y) {
    for (int x = marked.x0; x < marked.x1; ++x) {
      std::uint8_t& pixel = pixels_[IndexOf({x, y})];
      pixel = std::uint8_t(std::max(int(pixel), places));
    }
  }
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

Spectrum StillEmitters::FirstAlong(Ray ray) const {
  const auto first = scene_.IntersectPoint(ray);
  if (!first) return Spectrum();
  const AreaLight* const light = scene_.Primitives().Attributes(first->hit).areaLight;
  if (!light || !IsStill(first->motion)) return Spectrum();
  const SurfaceInteraction surface = scene_.Complete(ray, first->hit);
  ray.tMax = first->hit.t;
  return light->L(surface, surface.uv, surface.wo) * scene_.Transmittance(ray);
}

}  // namespace exphoton
