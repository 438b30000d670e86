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
      : map_(map), walls_(walls), from_{query.p, Vector3(query.n)} {}

  // Returns the signed square of the sine of the photon's angle over the tangent plane; 0 for a
  // photon at the point.
  Real Sine2(std::uint32_t photon) const {
    const Vector3 to = map_.Position(photon) - from_.p;
    const Real height = Dot(to, from_.free);
    return SafeDivide(height * std::abs(height), LengthSquared(to), Real(0));
  }
  Layer LayerOf(std::uint32_t photon) const {
    constexpr Real kOnPlane2 = Square(Real(.05));  // 3 degrees
    const Real sine2 = Sine2(photon);
    if (sine2 > kOnPlane2) return Layer::Before;
    return sine2 < -kOnPlane2 ? Layer::Behind : Layer::On;
  }
  bool Hides(std::uint32_t photon) const {
    return walls_.AreBetween(from_, {map_.Position(photon), map_.Direction(photon)});
  }
  // Returns whether the surface of the point goes on, at this distance, behind the wall on which
  // the photon lies.
  bool HasGroundBehind(std::uint32_t photon, Real distance) const {
    const Vector3 to = map_.Position(photon) - from_.p;
    const Vector3 along = to - from_.free * Dot(to, from_.free);
    const Real away = Length(along);
    return away > 0 && away < distance && walls_.SurfaceContinues(from_, along / away, distance);
  }

 private:
  const PhotonMap& map_;
  const Walls& walls_;
  Walls::Place from_;
};

// Returns the photons of a layer.
std::span<const std::uint32_t> In(Layer layer, const View& view, const PhotonNeighbourhood& around,
                                  Arena* arena) {
  const std::size_t size = around.photons.size();
  const std::span<std::uint32_t> photons{arena->AllocateArray<std::uint32_t>(size), size};
  std::size_t count = 0;
  for (const std::uint32_t photon : around.photons)
    if (view.LayerOf(photon) == layer) photons[count++] = photon;
  return photons.first(count);
}

// Returns a random key that depends on the point of the estimate, but not on the scene's scale.
std::uint64_t KeyOf(const PhotonNeighbourhood& around) {
  const auto nearness = float(SafeDivide(around.distance2.front(), around.radius2, Real(0)));
  return HashKey({around.photons.front(), std::bit_cast<std::uint32_t>(nearness)});
}

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

}  // namespace

SeenPhotons WithoutHidden(const PhotonMap& map, const PhotonQuery& query,
                          const PhotonNeighbourhood& around, const Walls& walls, Arena* arena) {
  constexpr std::size_t kTried = 4;
  SeenPhotons seen{around, false};
  if (!walls.Exist()) return seen;
  const View view(map, query, walls);
  const auto before = In(Layer::Before, view, around, arena);
  if (before.empty()) return seen;
  const std::size_t tried = std::min(before.size(), kTried);
  for (std::size_t i = 0; i < tried && !seen.isBesideWall; ++i)
    seen.isBesideWall = view.Hides(before[i * before.size() / tried]);
  if (seen.isBesideWall) {
    seen.around = Only(around, arena, [&](std::uint32_t photon) {
      return view.LayerOf(photon) == Layer::Behind || !view.Hides(photon);
    });
  } else {
    const std::uint32_t highest = *std::max_element(
        before.begin(), before.end(),
        [&](std::uint32_t a, std::uint32_t b) { return view.Sine2(a) < view.Sine2(b); });
    seen.isBesideWall = view.HasGroundBehind(highest, std::sqrt(around.radius2));
  }
  return seen;
}

PhotonNeighbourhood ProbablySeen(const PhotonMap& map, const PhotonQuery& query,
                                 const PhotonNeighbourhood& around, const Walls& walls,
                                 Arena* arena) {
  if (!walls.Exist() || around.photons.empty()) return around;
  const View view(map, query, walls);
  RandomStream random(KeyOf(around));
  const auto isHidden = [&](Layer layer) {
    const auto photons = In(layer, view, around, arena);
    if (photons.empty()) return false;
    const auto chosen = std::size_t(random.Uniform() * Real(photons.size()));
    return view.Hides(photons[std::min(chosen, photons.size() - 1)]);
  };
  if (!isHidden(Layer::Before)) return around;
  const bool isPlaneHidden = isHidden(Layer::On);
  return Only(around, arena, [&](std::uint32_t photon) {
    const Layer layer = view.LayerOf(photon);
    return layer == Layer::Behind || (layer == Layer::On && !isPlaneHidden);
  });
}

}  // namespace exphoton
