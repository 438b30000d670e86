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

bool Walls::AreBetween(const Place& a, const Place& b) const {
  constexpr Real kEnd = Real(.999);  // spares the surface of b, if its free direction is along it
  const Real distance = Distance(a.p, b.p);
  constexpr Real kRounding = 1000 * kMachineEpsilon;  // relative to the coordinates
  if (distance < kRounding * MaxComponent(Max(Abs(a.p), Abs(b.p)))) return false;
  const Real lift = kLift * distance;
  Ray ray;
  ray.o = a.p + a.free * lift;
  ray.d = b.p + b.free * lift - ray.o;
  ray.tMax = kEnd;
  return Blocks(ray);
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
