// SPDX-License-Identifier: BSD-2-Clause
// PhotonGuide selects the photons of a cell to follow from a point, and reuses them nearby.
#include "integrators/photon/gather/photon_guide.h"

#include "integrators/photon/gather/reprojected_cell.h"
#include "integrators/photon/maps/rest_pose.h"

namespace exphoton {
namespace {

// SeenFrom is a point that looks at photons, with its pose at rest.
struct SeenFrom {
  RestPose rest;
  Point3 p;
  LitSide side;
};

// Selects the directions from which clearly more light comes than a diffuse surface sends rays.
// BSDF rays find the other light as well; guided rays spent on it would be missing where light is
// dense (Karlik et al. 2019, MIS Compensation: Optimizing Sampling Techniques in Multiple
// Importance Sampling). A direction's own photon does not count.
GuidedDirections WorthFollowing(const GuideCell& cell, const SeenFrom& from, const Cone& cone,
                                Arena* arena) {
  const auto& [rest, p, side] = from;
  const LitSide atRest(rest.Normal(side.ng), rest.Normal(side.ns), side.isTwoSided);
  const ReprojectedCell view(cell, rest.Point(p), atRest, arena);
  // Expected photons in a cone about the normal, with the density of a diffuse surface's rays.
  const Real diffusePdf = side.isTwoSided ? kInvPi / 2 : kInvPi;
  const Real expected = Real(std::max(view.lit - 1, 1)) * diffusePdf / cone.Pdf();
  ConeDirections axes(cell.size(), arena);
  axes.AddChosen({view.x, view.y, view.z, view.cosine, cell.DenserThan(), cell.size()}, expected);
  if (rest.IsMoved())
    for (std::size_t i = 0; i < axes.size(); ++i) axes.Set(i, rest.DirectionBack(axes[i]));
  axes.Finish();
  return {axes, Real(axes.size()) / Real(std::max(view.lit, 1)),
          cell.IrradiancePerPhoton() * Real(view.lit)};
}

// Uses all photons that light the side, for the distributions of other authors.
GuidedDirections AllPhotons(const GuideCell& cell, const SeenFrom& from, GatherSampling kind,
                            Arena* arena) {
  const auto& [rest, p, side] = from;
  const LitSide atRest(rest.Normal(side.ng), rest.Normal(side.ns), side.isTwoSided);
  const ReprojectedCell view(cell, rest.Point(p), atRest, arena);
  GuidedDirections guide;
  guide.axes = ConeDirections(cell.size(), arena);
  for (std::size_t i = 0; i < cell.size(); ++i) {
    if (!(view.cosine[i] < ReprojectedCell::kUnlit)) continue;
    const Vector3 w{view.x[i], view.y[i], view.z[i]};
    guide.axes.Add(rest.IsMoved() ? rest.DirectionBack(w) : w);
  }
  guide.axes.Finish();
  if (guide.axes.size() == 0) return guide;
  guide.share = 1;
  guide.irradiance = cell.IrradiancePerPhoton() * Real(view.lit);
  if (kind == GatherSampling::Hey) {
    guide.footprints = arena->Make<PhotonFootprints>(guide.axes, arena);
    return guide;
  }
  DirectionHistogram* const histogram = arena->Make<DirectionHistogram>(side.ns);
  for (std::size_t i = 0; i < guide.axes.size(); ++i) histogram->Add(guide.axes[i]);
  guide.histogram = histogram;
  return guide;
}

// LastGuide is the guide of the previous camera sample in the pixel, and its shading point.
struct LastGuide {
  GuidedDirections directions;
  Real radius2 = 0;  // squared distance of the farthest photon
  Point3 p;
  LitSide side;

  // Returns whether the guide is valid at `at`: well within reach, on nearly the same plane.
  bool IsValidAt(const Point3& at, const LitSide& seen) const {
    constexpr Real kRadii2 = Square(Real(.25)), kMinCosine = Real(.95);
    return DistanceSquared(at, p) < kRadii2 * radius2 && Dot(seen.ng, side.ng) > kMinCosine &&
           Dot(seen.ns, side.ns) > kMinCosine && seen.isTwoSided == side.isTwoSided;
  }
};

}  // namespace

void PhotonGuide::Prepare(const PhotonMap& map) {
  cells_.reset();
  if (count_ == 0 || map.IsEmpty()) return;
  constexpr Real kRadii = Real(.75);  // twice as much is noisier, a third is no better
  Arena arena;
  Real width = kRadii * map.TypicalRadius(count_, &arena);
  if (!(width > 0)) width = 1;  // all photons at one point
  cells_ = std::make_unique<GuideTable>(GuideGrid(map, count_, cone_, width));
}

template <class Follow>
GuidedDirections PhotonGuide::WithCell(const Point3& p, LiContext& context,
                                       const Follow& follow) const {
  if (const GuideCell* cell = cells_->At(p, &context.arena)) return follow(*cell);
  const GuideGrid& grid = cells_->Grid();
  if (context.threadState) return follow(context.threadState->Get<GuideCache>(grid).At(p));
  return follow(grid.MakeCell(grid.KeyOf(p), &context.arena));
}

GuidedDirections PhotonGuide::Directions(const ShadingPoint& point, LiContext& context) const {
  if (!cells_) return {};
  const Point3& p = point.surface.p;
  const LitSide side(point);
  LastGuide* const last = context.pixelState ? &context.pixelState->Get<LastGuide>() : nullptr;
  if (last && last->IsValidAt(p, side)) return last->directions;

  const SeenFrom from{RestPose(point.surface), p, side};
  Arena& arena = context.pixelState ? context.pixelState->FreshArena() : context.arena;
  return WithCell(from.rest.Point(p), context, [&](const GuideCell& cell) {
    const GuidedDirections directions = kind_ == GatherSampling::Photons
                                            ? WorthFollowing(cell, from, cone_, &arena)
                                            : AllPhotons(cell, from, kind_, &arena);
    if (last) *last = {directions, cell.Radius2(), p, side};
    return directions;
  });
}

GuidedDirections PhotonGuide::DirectionsOnPath(const ShadingPoint& point,
                                               LiContext& context) const {
  const SeenFrom from{RestPose(point.surface), point.surface.p, LitSide(point)};
  return WithCell(from.rest.Point(from.p), context, [&](const GuideCell& cell) {
    return WorthFollowing(cell, from, cone_, &context.arena);
  });
}

}  // namespace exphoton
