// SPDX-License-Identifier: BSD-2-Clause
#include "integrators/photon/maps/hidden_photons.h"

#include <algorithm>
#include <bit>

#include "core/math/sampling/random.h"

namespace exphoton {
namespace {

// Layer is the place of a photon relative to the tangent plane of a point.
enum class Layer { Behind, On, Before };

// View is the view of photons from the point of an estimate.
class View {
 public:
  View(const PhotonMap& map, const PhotonQuery& query, const Walls& walls)
      : map_(map), walls_(walls), p_(query.p), n_(query.n), isOneSided_(query.isOneSided) {}

  // Returns the signed square of the sine of the photon's angle over the tangent plane; 0 for a
  // photon at the point.
  Real Sine2(std::uint32_t photon) const {
    const Vector3 to = map_.Position(photon) - p_;
    const Real height = Dot(to, SideOf(photon));
    return SafeDivide(height * std::abs(height), LengthSquared(to), Real(0));
  }
  Layer LayerOf(std::uint32_t photon) const {
    // Of 3 degrees: Walls lifts both ends of a segment by as much.
    constexpr Real kOnPlane2 = Square(Walls::kLift);
    const Real sine2 = Sine2(photon);
    if (sine2 > kOnPlane2) return Layer::Before;
    return sine2 < -kOnPlane2 ? Layer::Behind : Layer::On;
  }
  bool Hides(std::uint32_t photon) const {
    const Walls::Place here{p_, SideOf(photon)},
        there{map_.Position(photon), map_.Direction(photon)};
    if (LayerOf(photon) == Layer::Behind) return walls_.AreBetweenRoundAnEdge(here, there);
    return walls_.AreBetween(here, there);
  }
  // Returns whether the surface of the point goes on, at this distance, behind the wall on which
  // the photon lies.
  bool HasGroundBehind(std::uint32_t photon, Real distance) const {
    const Vector3 up = SideOf(photon), to = map_.Position(photon) - p_;
    const Vector3 along = to - up * Dot(to, up);
    const Real away = Length(along);
    return away > 0 && away < distance && walls_.SurfaceContinues({p_, up}, along / away, distance);
  }

 private:
  // Returns the normal on the side of the point's surface where the photon arrived. On a surface
  // that transmits, photons of both sides count.
  Vector3 SideOf(std::uint32_t photon) const {
    if (isOneSided_) return n_;
    return Dot(map_.Direction(photon), n_) < 0 ? -n_ : n_;
  }

  const PhotonMap& map_;
  const Walls& walls_;
  Point3 p_;
  Vector3 n_;
  bool isOneSided_;
};

// Returns the photons for which `counts` is true.
template <typename Counts>
PhotonNeighbourhood Only(const PhotonNeighbourhood& around, Arena* arena, const Counts& counts) {
  const std::size_t size = around.photons.size();
  const std::span<std::uint32_t> photons{arena->AllocateArray<std::uint32_t>(size), size};
  const std::span<Real> distance2{arena->AllocateArray<Real>(size), size};
  std::size_t count = 0;
  for (std::size_t i = 0; i < size; ++i) {
    if (!counts(around.photons[i])) continue;
    photons[count] = around.photons[i];
    distance2[count++] = around.distance2[i];
  }
  PhotonNeighbourhood some = around;
  some.photons = photons.first(count);
  some.distance2 = distance2.first(count);
  return some;
}

// Returns the photons that most often show a wall: those before the plane, or if there are none,
// those behind it.
std::span<const std::uint32_t> Suspects(const View& view, const PhotonNeighbourhood& around,
                                        std::span<const std::uint32_t> before, Arena* arena) {
  if (!before.empty()) return before;
  return Only(around, arena,
              [&](std::uint32_t photon) { return view.LayerOf(photon) == Layer::Behind; })
      .photons;
}

// Returns a random key that depends on the point of the estimate, but not on the scene's scale.
std::uint64_t KeyOf(const PhotonNeighbourhood& around) {
  const auto nearness = float(SafeDivide(around.distance2.front(), around.radius2, Real(0)));
  return HashKey({around.photons.front(), std::bit_cast<std::uint32_t>(nearness)});
}

}  // namespace

SeenPhotons WithoutHidden(const PhotonMap& map, const PhotonQuery& query,
                          const PhotonNeighbourhood& around, const Walls& walls, Arena* arena) {
  constexpr std::size_t kTried = 4;
  constexpr Real kLeastShare = Real(.5);
  SeenPhotons seen{around, {}, false};
  if (!walls.Exist()) return seen;
  const View view(map, query, walls);
  seen.before = Only(around, arena, [&](std::uint32_t photon) {
                  return view.LayerOf(photon) == Layer::Before;
                }).photons;
  const auto suspects = Suspects(view, around, seen.before, arena);
  const std::size_t count = suspects.size(), tried = std::min(count, kTried);
  for (std::size_t i = 0; i < tried && !seen.areSomeHidden; ++i)
    seen.areSomeHidden = view.Hides(suspects[i * count / tried]);
  if (!seen.areSomeHidden) return seen;
  seen.around = Only(around, arena, [&](std::uint32_t photon) { return !view.Hides(photon); });
  const Real share = Real(seen.around.photons.size()) / Real(around.photons.size());
  seen.around.share *= std::max(share, kLeastShare);
  return seen;
}

PhotonNeighbourhood ProbablySeen(const PhotonMap& map, const PhotonQuery& query,
                                 const PhotonNeighbourhood& around, const Walls& walls,
                                 Arena* arena) {
  if (!walls.Exist() || around.photons.empty()) return around;
  const View view(map, query, walls);
  RandomStream random(KeyOf(around));
  const auto hidesOneOf = [&](std::span<const std::uint32_t> photons) {
    const auto chosen = std::size_t(random.Uniform() * Real(photons.size()));
    return view.Hides(photons[std::min(chosen, photons.size() - 1)]);
  };
  const auto before = Only(
      around, arena, [&](std::uint32_t photon) { return view.LayerOf(photon) == Layer::Before; });
  const auto suspects = Suspects(view, around, before.photons, arena);
  if (suspects.empty() || !hidesOneOf(suspects)) return around;
  if (!hidesOneOf(around.photons) || !hidesOneOf(around.photons)) return around;
  PhotonNeighbourhood none = around;
  none.photons = {}, none.distance2 = {};
  return none;
}

bool IsBesideWall(const PhotonMap& map, const PhotonQuery& query, const SeenPhotons& seen,
                  const Walls& walls) {
  if (seen.areSomeHidden) return true;
  if (seen.before.empty()) return false;
  const View view(map, query, walls);
  const std::uint32_t highest = *std::max_element(
      seen.before.begin(), seen.before.end(),
      [&](std::uint32_t a, std::uint32_t b) { return view.Sine2(a) < view.Sine2(b); });
  return view.HasGroundBehind(highest, std::sqrt(seen.around.radius2));
}

}  // namespace exphoton
