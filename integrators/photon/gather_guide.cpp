// SPDX-License-Identifier: BSD-2-Clause
// The search for guiding photons, and whom else it serves.
#include "integrators/photon/gather_guide.h"

#include "integrators/photon/direction_order.h"
#include "integrators/photon/rest_pose.h"

namespace exphoton {
namespace {

// The side of a surface that photons light.
struct Side {
  Normal3 ng, ns;  // towards the viewer
  bool isTwoSided = false;

  Side() = default;
  explicit Side(const ShadingPoint& point)
      : ng(FaceForward(point.surface.ng, point.Wo())),
        ns(FaceForward(point.bsdf.Ns(), ng)),
        isTwoSided(point.bsdf.Has(LobeSet::NonSpecularTransmission)) {}

  // Light from below the horizon of a surface that transmits none is no guide.
  bool IsLitFrom(const Vector3& w) const {
    return isTwoSided || (Dot(w, ng) > 0 && Dot(w, ns) > 0);
  }
};

struct Guide {
  ConeAxes axes;
  Real radius2 = 0;  // of the search
};

Guide FindGuide(const ShadingPoint& point, const Side& side, const PhotonMap& map, int photons,
                Arena* arena) {
  const RestPose rest(point.surface);
  const NearPoints near = map.Nearest(rest.Point(point.surface.p), photons, arena);
  if (near.size() == 0) return {};
  ConeAxes axes(near.size(), arena);
  for (const std::uint32_t photon : OrderByDirection(map, near.index, arena)) {
    const Vector3 w = rest.DirectionBack(map.LongDirection(photon));
    axes.Add(w, side.IsLitFrom(w));
  }
  axes.Finish();
  return {axes, near.distance2[near.farthest]};
}

// The guide of the camera sample that looked last, and where it was.
struct LastGuide {
  Guide guide;
  Point3 p;
  Side side;

  // Well within the photons that were found, and on as good as the same plane.
  bool Serves(const Point3& at, const Side& seen) const {
    constexpr Real kRadii2 = Square(Real(.5)), kMinCosine = Real(.95);
    return DistanceSquared(at, p) < kRadii2 * guide.radius2 && Dot(seen.ng, side.ng) > kMinCosine &&
           Dot(seen.ns, side.ns) > kMinCosine && seen.isTwoSided == side.isTwoSided;
  }
};

}  // namespace

ConeAxes GatherGuide::Directions(const ShadingPoint& point, const PhotonMap& map,
                                 LiContext& context) const {
  if (count_ == 0 || map.IsEmpty()) return {};
  const Side side(point);
  if (!context.notes) return FindGuide(point, side, map, count_, &context.arena).axes;
  LastGuide& last = context.notes->Note<LastGuide>();
  if (!last.Serves(point.surface.p, side)) {
    Arena& arena = context.notes->FreshArena();
    last = {FindGuide(point, side, map, count_, &arena), point.surface.p, side};
  }
  return last.guide.axes;
}

}  // namespace exphoton
