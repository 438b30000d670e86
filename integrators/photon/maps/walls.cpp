// SPDX-License-Identifier: BSD-2-Clause
#include "integrators/photon/maps/walls.h"

#include "core/scene/scene.h"

namespace exphoton {

Walls::Walls(const Scene& scene) {
  if (!scene.Primitives().MovesWithin({-kInfinity, kInfinity})) scene_ = &scene;
  hasGlass_ = Intersects(scene.Primitives().PossibleLobes(), LobeSet::SpecularTransmission);
}

// Whatever lies behind a pane counts as seen.
bool Walls::Blocks(const Ray& ray) const {
  if (!scene_->Occluded(ray)) return false;
  if (!hasGlass_) return true;
  const auto hit = scene_->IntersectPoint(ray);
  return !hit || !hit->material ||
         !Intersects(hit->material->PossibleLobes(), LobeSet::SpecularTransmission);
}

bool Walls::BlockLifted(const Place& a, const Place& b, Real lift) const {
  constexpr Real kEnd = Real(.999);  // spares the surface of b, if its free direction is along it
  const Real distance = Distance(a.p, b.p);
  constexpr Real kRounding = 1000 * kMachineEpsilon;  // relative to the coordinates
  if (distance < kRounding * MaxComponent(Max(Abs(a.p), Abs(b.p)))) return false;
  Ray ray;
  ray.o = a.p + a.free * (lift * distance);
  ray.d = b.p + b.free * (lift * distance) - ray.o;
  ray.tMax = kEnd;
  return Blocks(ray);
}

bool Walls::AreBetween(const Place& a, const Place& b) const { return BlockLifted(a, b, kLift); }

bool Walls::AreBetweenRoundAnEdge(const Place& a, const Place& b) const {
  const Real distance = Distance(a.p, b.p);
  const auto isFree = [&](const Place& place) {
    Ray ray;
    ray.o = place.p + place.free * (kLift * distance);
    ray.d = place.free * ((1 - kLift) * distance);
    ray.tMax = 1;
    return !Blocks(ray);
  };
  return BlockLifted(a, b, 1) && isFree(a) && isFree(b);
}

bool Walls::SurfaceContinues(const Place& from, const Vector3& along, Real distance) const {
  const Vector3 lift = from.free * (kLift * distance);
  Ray ray;
  ray.o = from.p + along * distance + lift;
  ray.d = lift * -2;
  ray.tMax = 1;
  return scene_->Occluded(ray);
}

}  // namespace exphoton
