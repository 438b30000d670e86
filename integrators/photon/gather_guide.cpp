// SPDX-License-Identifier: BSD-2-Clause
// The search for guiding photons, which of them are followed, and whom else they serve.
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
  // Of directions that a surface scatters to with equal radiance.
  Real DiffusePdf(const Vector3& w) const {
    return AbsDot(w, ns) * (isTwoSided ? kInvPi / 2 : kInvPi);
  }
};

// Directions by the density of which more light comes than a diffuse surface sends rays. What else
// lights it the other half of the rays finds as well; rays spent on it here would be missed where
// light is dense (Karlik et al. 2019, MIS Compensation: Optimizing Sampling Techniques in Multiple
// Importance Sampling). A direction's own photon does not count.
ConeAxes WorthFollowing(const ConeAxes& all, const Side& side, const Cone& cone, Arena* arena) {
  constexpr Real kDenser = 2;
  ConeAxes worth(all.size(), arena);
  const Real perOther = cone.Pdf() / Real(std::max<std::size_t>(all.size(), 2) - 1);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Vector3 w = all[i];
    const int others = all.CountWithin(w, cone.Chord2()) - 1;
    worth.Add(w, Real(others) * perOther > kDenser * side.DiffusePdf(w));
  }
  worth.Finish();
  return worth;
}

struct Guide {
  GuideDirections directions;
  Real radius2 = 0;  // of the search
};

Guide FindGuide(const ShadingPoint& point, const Side& side, const PhotonMap& map, int photons,
                const Cone& cone, Arena* arena) {
  const RestPose rest(point.surface);
  const NearPoints near = map.Nearest(rest.Point(point.surface.p), photons, arena);
  if (near.size() == 0) return {};
  ConeAxes all(near.size(), arena);
  for (const std::uint32_t photon : OrderByDirection(map, near.index, arena)) {
    const Vector3 w = rest.DirectionBack(map.LongDirection(photon));
    all.Add(w, side.IsLitFrom(w));
  }
  all.Finish();
  const ConeAxes worth = WorthFollowing(all, side, cone, arena);
  const Real share = SafeDivide(Real(worth.size()), Real(all.size()), Real(0));
  return {{worth, share}, near.distance2[near.farthest]};
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

GuideDirections GatherGuide::Directions(const ShadingPoint& point, const PhotonMap& map,
                                        LiContext& context) const {
  if (count_ == 0 || map.IsEmpty()) return {};
  const Side side(point);
  if (!context.notes) return FindGuide(point, side, map, count_, cone_, &context.arena).directions;
  LastGuide& last = context.notes->Note<LastGuide>();
  if (!last.Serves(point.surface.p, side)) {
    Arena& arena = context.notes->FreshArena();
    last = {FindGuide(point, side, map, count_, cone_, &arena), point.surface.p, side};
  }
  return last.guide.directions;
}

}  // namespace exphoton
