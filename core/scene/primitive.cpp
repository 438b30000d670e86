// SPDX-License-Identifier: BSD-2-Clause
// PrimitiveSet: one numbering of triangles, shapes and instances, and their intersection tests. The
// order of the tests does not affect the result: a hit replaces another only if it is nearer, or
// equally near with lower ids.
#include "core/scene/primitive.h"

#include "core/base/error.h"
#include "core/geometry/placement.h"
#include "core/geometry/triangle_point.h"
#include "core/geometry/triangle_single.h"
#include "core/scattering/material.h"
#include "core/scene/aggregate.h"
#include "core/scene/cut_out_triangle.h"
#include "core/scene/hit_order.h"

namespace exphoton {
namespace {

LobeSet LobesOf(const PrimitiveAttributes& attributes) {
  return attributes.material ? attributes.material->PossibleLobes() : LobeSet::None;
}

}  // namespace

void PrimitiveSet::AddMesh(std::shared_ptr<const TriangleMesh> mesh,
                           PrimitiveAttributes attributes) {
  if (mesh->alpha) {
    for (std::uint32_t i = 0; i < mesh->TriangleCount(); ++i)
      AddShape(std::make_shared<CutOutTriangle>(mesh, i), attributes);
    return;
  }
  meshFlips_.push_back(mesh->flipNormal);
  meshes_.push_back(std::move(mesh));
  meshAttributes_.push_back(attributes);
}

void PrimitiveSet::AddShape(std::shared_ptr<const Shape> shape, PrimitiveAttributes attributes) {
  shapes_.push_back(std::move(shape));
  shapeAttributes_.push_back(attributes);
}

void PrimitiveSet::AddInstance(const Instance& instance) {
  instances_.push_back(instance);
  worldToInstance_.push_back(instance.instanceToWorld.Inverted());
  instanceBounds_.push_back(InstanceBounds(instance));
}

void PrimitiveSet::Finish() {
  std::size_t count = shapes_.size() + instances_.size();
  for (const auto& mesh : meshes_) count += mesh->TriangleCount();
  if (count >= kNoId)
    throw Error(ExitStatus::Resource, "more than 2^32 - 2 primitives in one scene or object");

  triangles_.clear();
  vertices_.clear();
  for (std::uint32_t m = 0; m < meshes_.size(); ++m) {
    const TriangleMesh& mesh = *meshes_[m];
    for (std::uint32_t i = 0; i < mesh.TriangleCount(); ++i) {
      const auto& v = mesh.indices[i];
      triangles_.push_back({m, i});
      vertices_.push_back({mesh.p[v[0]], mesh.p[v[1]], mesh.p[v[2]]});
    }
  }
  bounds_ = Bounds3();
  for (std::uint32_t id = 0; id < Count(); ++id) bounds_.Extend(Bounds(id));
  FindTraitsOfMaterials();
}

void PrimitiveSet::FindTraitsOfMaterials() {
  lobes_ = LobeSet::None;
  needsDifferentials_ = false;
  const auto add = [&](LobeSet lobes, bool needsDifferentials) {
    lobes_ = lobes_ | lobes;
    needsDifferentials_ = needsDifferentials_ || needsDifferentials;
  };
  for (const auto* list : {&meshAttributes_, &shapeAttributes_})
    for (const PrimitiveAttributes& attributes : *list)
      add(LobesOf(attributes), attributes.material && attributes.material->NeedsDifferentials());
  for (const Instance& instance : instances_) {
    const PrimitiveSet& object = instance.object->Set();
    add(object.PossibleLobes(), object.NeedsDifferentials());
  }
}

LobeSet PrimitiveSet::PossibleLobes(std::uint32_t id) const {
  if (id < triangles_.size()) return LobesOf(meshAttributes_[triangles_[id].mesh]);
  id -= TriangleCount();
  if (id < shapes_.size()) return LobesOf(shapeAttributes_[id]);
  return instances_[id - shapes_.size()].object->Set().PossibleLobes();
}

std::uint32_t PrimitiveSet::Count() const {
  return std::uint32_t(triangles_.size() + shapes_.size() + instances_.size());
}

Bounds3 PrimitiveSet::Bounds(std::uint32_t id) const {
  if (id < triangles_.size()) {
    const auto& v = vertices_[id];
    Bounds3 bounds(v[0], v[1]);
    bounds.Extend(v[2]);
    return bounds;
  }
  id -= TriangleCount();
  if (id < shapes_.size()) return shapes_[id]->Bounds();
  return instanceBounds_[id - shapes_.size()];
}

Bounds3 PrimitiveSet::InstanceBounds(const Instance& instance) const {
  const Bounds3 inner = instance.object->Set().WorldBounds();
  Bounds3 bounds = instance.motion ? instance.motion->ApplyBounds(inner)
                                   : instance.instanceToWorld.ApplyBounds(inner);
  if (bounds.IsEmpty()) return bounds;
  // The transformation to object space rounds a ray in proportion to its distance from the
  // object-space origin. The margin covers this error at the farthest point of the bounds.
  const Bounds3 origins = instance.motion ? instance.motion->ApplyBounds(Bounds3(Point3()))
                                          : Bounds3(instance.instanceToWorld.ApplyPoint(Point3()));
  const Real reach = MaxComponent(Max(bounds.max - origins.min, origins.max - bounds.min));
  const Vector3 margin(reach * Gamma(16));
  bounds.min = bounds.min - margin;
  bounds.max = bounds.max + margin;
  return bounds;
}

void PrimitiveSet::Intersect(std::uint32_t id, const TraceRay& ray, Hit* hit) const {
  if (id < triangles_.size()) {
    const auto& v = vertices_[id];
    const auto found = IntersectTriangle(ray.triangle, hit->t, v[0], v[1], v[2]);
    if (found && Wins(found->t, kNoId, id, *hit))
      *hit = {found->t, {found->b1, found->b2}, id, kNoId};
    return;
  }
  const std::uint32_t index = id - TriangleCount();
  if (index >= shapes_.size()) {
    IntersectInstance(index - std::uint32_t(shapes_.size()), ray, hit);
    return;
  }
  Ray bounded = ray.ray;
  bounded.tMax = NextUp(hit->t);  // include ties, which ids then decide
  const auto found = shapes_[index]->Intersect(bounded);
  if (found && Wins(found->t, kNoId, id, *hit)) *hit = {found->t, found->uv, id, kNoId};
}

Hit PrimitiveSet::Reported(const TraceRay& ray, const Hit& nearest) const {
  if (!nearest.IsHit() || nearest.instance != kNoId || nearest.primitive >= triangles_.size())
    return nearest;
  const auto& v = vertices_[nearest.primitive];
  const Real corners[9] = {v[0].x, v[0].y, v[0].z, v[1].x, v[1].y, v[1].z, v[2].x, v[2].y, v[2].z};
  const auto hit = HitInSingle(ray.triangle, TriangleCorners<3, 1>{corners});
  return hit ? Hit{hit->t, {hit->b1, hit->b2}, nearest.primitive, kNoId} : nearest;
}

// Returns the ray in object space. The direction is not normalised, so t keeps its value.
Ray PrimitiveSet::InstanceRay(std::uint32_t instance, const Ray& ray, Real tMax) const {
  if (const Motion* motion = instances_[instance].motion.get())
    return RayToLocal(motion->At(ray.time).Inverted(), ray, tMax);
  return RayToLocal(worldToInstance_[instance], ray, tMax);
}

// Returns the t by which hits are ordered. Reported may have replaced it by the single-precision t.
Real PrimitiveSet::OrderedDistance(const Ray& ray, const Hit& hit) const {
  if (hit.instance != kNoId || hit.primitive >= triangles_.size()) return hit.t;
  const auto& v = vertices_[hit.primitive];
  const auto found = IntersectTriangle(TriangleRay(ray), kInfinity, v[0], v[1], v[2]);
  return found ? found->t : hit.t;
}

void PrimitiveSet::IntersectInstance(std::uint32_t instance, const TraceRay& ray, Hit* hit) const {
  const std::uint32_t id = TriangleCount() + std::uint32_t(shapes_.size()) + instance;
  const Ray local = InstanceRay(instance, ray.ray, NextUp(hit->t));
  const ObjectGeometry& object = *instances_[instance].object;
  const Hit inner = object.Accelerator().Intersect(local);
  if (!inner.IsHit()) return;
  const Real t = object.Set().OrderedDistance(local, inner);
  if (Wins(t, id, inner.primitive, *hit)) *hit = {t, inner.uv, inner.primitive, id};
}

bool PrimitiveSet::Occludes(std::uint32_t id, const TraceRay& ray) const {
  const Real tMax = ray.ray.tMax;
  if (id < triangles_.size()) {
    const auto& v = vertices_[id];
    const auto found = IntersectTriangle(ray.triangle, tMax, v[0], v[1], v[2]);
    return found && found->t < tMax;
  }
  const std::uint32_t index = id - TriangleCount();
  if (index < shapes_.size()) return shapes_[index]->Occludes(ray.ray);
  const std::uint32_t instance = index - std::uint32_t(shapes_.size());
  return instances_[instance].object->Accelerator().Occluded(InstanceRay(instance, ray.ray, tMax));
}

PrimitiveAttributes PrimitiveSet::Attributes(const Hit& hit) const {
  if (hit.instance != kNoId) {
    Hit inner = hit;
    inner.instance = kNoId;
    return InstanceOf(hit).object->Set().Attributes(inner);
  }
  if (hit.primitive < triangles_.size()) return meshAttributes_[triangles_[hit.primitive].mesh];
  return shapeAttributes_[hit.primitive - TriangleCount()];
}

SurfacePoint PrimitiveSet::Point(const Ray& ray, const Hit& hit) const {
  if (hit.instance != kNoId || hit.primitive >= triangles_.size()) return Surface(ray, hit);
  const auto& v = vertices_[hit.primitive];
  SurfacePoint point = TrianglePoint(Vec3d(v[0]), Vec3d(v[1]), Vec3d(v[2]), hit.uv.x, hit.uv.y);
  if (meshFlips_[triangles_[hit.primitive].mesh]) point.ng = -point.ng;
  point.time = ray.time;
  return point;
}

SurfaceInteraction PrimitiveSet::Surface(const Ray& ray, const Hit& hit) const {
  if (hit.instance != kNoId) return InstanceSurface(ray, hit);
  SurfaceInteraction surface;
  if (hit.primitive < triangles_.size()) {
    const Triangle& triangle = triangles_[hit.primitive];
    surface = TriangleSurface(*meshes_[triangle.mesh], triangle.index, hit.uv.x, hit.uv.y);
  } else {
    surface = shapes_[hit.primitive - TriangleCount()]->Surface(ray, {hit.t, hit.uv});
  }
  const PrimitiveAttributes attributes = Attributes(hit);
  surface.wo = NormalizeOr(-ray.d, Vector3());
  surface.time = ray.time;
  surface.material = attributes.material;
  surface.areaLight = attributes.areaLight;
  surface.objectId = attributes.objectId;
  surface.materialId = attributes.materialId;
  return surface;
}

SurfaceInteraction PrimitiveSet::InstanceSurface(const Ray& ray, const Hit& hit) const {
  const std::uint32_t index = hit.instance - TriangleCount() - std::uint32_t(shapes_.size());
  const Instance& instance = instances_[index];
  Hit inner = hit;
  inner.instance = kNoId;
  const SurfaceInteraction local =
      instance.object->Set().Surface(InstanceRay(index, ray, kInfinity), inner);
  const Motion* motion = instance.motion.get();
  SurfaceInteraction surface =
      SurfaceToWorld(motion ? motion->At(ray.time) : instance.instanceToWorld, local);
  surface.wo = NormalizeOr(-ray.d, Vector3());
  surface.motion = motion;
  if (instance.objectId != 0) surface.objectId = instance.objectId;
  return surface;
}

bool PrimitiveSet::MovesWithin(Interval interval) const {
  return std::any_of(instances_.begin(), instances_.end(), [&](const Instance& instance) {
    return instance.motion && instance.motion->MovesWithin(interval);
  });
}

bool PrimitiveSet::EmitsLight() const {
  const auto emits = [](const PrimitiveAttributes& attributes) { return attributes.areaLight; };
  return std::any_of(meshAttributes_.begin(), meshAttributes_.end(), emits) ||
         std::any_of(shapeAttributes_.begin(), shapeAttributes_.end(), emits);
}

std::vector<Bounds3> PrimitiveSet::MovingEmitters(Interval interval) const {
  std::vector<Bounds3> found;
  for (std::size_t i = 0; i < instances_.size(); ++i) {
    const Instance& instance = instances_[i];
    const bool moves = instance.motion && instance.motion->MovesWithin(interval);
    if (moves && instance.object->Set().EmitsLight()) found.push_back(instanceBounds_[i]);
  }
  return found;
}

}  // namespace exphoton
