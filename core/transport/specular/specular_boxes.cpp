// SPDX-License-Identifier: BSD-2-Clause
// SpecularBoxes splits the surfaces recursively at their median centre along the longest axis.
#include "core/transport/specular/specular_boxes.h"

#include <algorithm>
#include <span>

namespace exphoton {
namespace {

Bounds3 BoundsOf(std::span<const Bounds3> parts) {
  Bounds3 bounds;
  for (const Bounds3& part : parts) bounds.Extend(part);
  return bounds;
}

// Appends at most maxBoxes boxes, a power of two, that together contain all parts.
void Split(std::span<Bounds3> parts, int maxBoxes, std::vector<Bounds3>* boxes) {
  if (maxBoxes == 1 || parts.size() == 1) {
    boxes->push_back(BoundsOf(parts));
    return;
  }
  Bounds3 centers;
  for (const Bounds3& part : parts) centers.Extend(part.Center());
  const int axis = centers.LongestAxis();
  const auto middle = parts.begin() + std::ptrdiff_t(parts.size() / 2);
  std::nth_element(parts.begin(), middle, parts.end(), [axis](const Bounds3& a, const Bounds3& b) {
    return a.Center()[axis] < b.Center()[axis];
  });
  Split(parts.first(parts.size() / 2), maxBoxes / 2, boxes);
  Split(parts.subspan(parts.size() / 2), maxBoxes / 2, boxes);
}

// Rounding lets a reported hit lie slightly off its surface. Boxes are wider by this margin, so
// that they contain such hits too.
Vector3 MarginOf(const Bounds3& world) {
  constexpr Real kMargin = Real(1e-4);
  return Vector3(kMargin * std::max(MaxComponent(Abs(world.min)), MaxComponent(Abs(world.max))));
}

}  // namespace

SpecularBoxes::SpecularBoxes(const Scene& scene) {
  const PrimitiveSet& primitives = scene.Primitives();
  std::vector<Bounds3> parts;
  for (std::uint32_t id = 0; id < primitives.Count(); ++id)
    if (Intersects(primitives.PossibleLobes(id), LobeSet::Specular) &&
        !primitives.Bounds(id).IsEmpty())
      parts.push_back(primitives.Bounds(id));
  if (parts.empty()) return;
  Split(parts, kMaxBoxes, &boxes_);
  const Vector3 margin = MarginOf(scene.WorldBounds());
  for (Bounds3& box : boxes_) {
    box.min = box.min - margin;
    box.max = box.max + margin;
  }
  all_ = BoundsOf(boxes_);
}

// The answer may be a false "no", but never a false "yes".
bool SpecularBoxes::Misses(const Ray& ray) const {
  if (all_.IsEmpty() || !IntersectBox(all_, ray.o, ray.d, ray.tMax)) return true;
  return std::none_of(boxes_.begin(), boxes_.end(), [&ray](const Bounds3& box) {
    return IntersectBox(box, ray.o, ray.d, ray.tMax).has_value();
  });
}

}  // namespace exphoton
