// SPDX-License-Identifier: BSD-2-Clause
// PhotonMapSet builds the three maps and computes kernel density estimates.
#include "integrators/photon/maps/photon_map_set.h"

#include "core/base/parallel.h"
#include "core/base/progress.h"
#include "core/transport/shading_normal.h"
#include "integrators/photon/maps/density_kernel.h"
#include "integrators/photon/maps/hidden_photons.h"
#include "integrators/photon/maps/rest_pose.h"
#include "integrators/photon/maps/timed_search.h"

namespace exphoton {
namespace {

struct SignedSum {
  Spectrum plain, withSigns;

  void Add(const Spectrum& value, Real sign) {
    plain += value;
    if (sign != 0) withSigns += value * sign;
  }
};

// Returns the lower bound of a search radius, relative to the scene radius. It applies if photons
// coincide, or if they are too few to measure their spacing.
Real SmallestRadius(std::size_t photons, int nUsed, Real sceneRadius) {
  return sceneRadius * (photons < std::size_t(nUsed) ? Real(.01) : Real(1e-6));
}

// Returns the weight of the photon at a radiance photon. A smaller disk area leaves as many
// radiance photons in a disk, because their share grows.
OwnPhotonWeight WeightOfOwnPhoton(const PhotonSettings& settings, double diskArea) {
  const double share = double(settings.radianceFraction) / diskArea;
  const auto reach = double(settings.radianceReach);
  return share * reach > 0 ? OwnPhotonWeight(share, reach) : OwnPhotonWeight();
}

}  // namespace

std::vector<PointTree<PhotonBlock>> MakePhotonTrees(std::span<PhotonBuffer> buffers,
                                                    ThreadPool& threads) {
  using Tree = PointTree<PhotonBlock>;
  std::vector<BlockStore<PhotonBlock>> unsorted;
  for (PhotonBuffer& buffer : buffers)
    unsorted.push_back(buffer.isSorted ? BlockStore<PhotonBlock>() : std::move(buffer.photons));
  std::vector<Tree> trees = Tree::MakeAll(unsorted, threads);
  for (std::size_t i = 0; i < trees.size(); ++i)
    if (buffers[i].isSorted) trees[i] = Tree::OfBlocks(std::move(buffers[i].photons));
  return trees;
}

PhotonMapSet::PhotonMapSet(PhotonPassResult* result, const PhotonSettings& settings,
                           Real sceneRadius, PreprocessContext& context, const Walls& walls)
    : nUsed_(settings.nUsed),
      ownWeight_(WeightOfOwnPhoton(settings, context.diskArea)),
      walls_(walls),
      diskArea_(context.diskArea),
      widest_(settings.maxDist ? Real(1) : kInfinity),
      kernel_(settings.kernel) {
  context.progress.Begin("Building photon maps", kPhotonKindCount);
  auto trees = MakePhotonTrees(result->buffers, context.threads);
  Arena arena;
  for (std::size_t at = 0; at < kPhotonKindCount; ++at) {
    maps_[at] = PhotonMap(std::move(trees[at]), result->buffers[at], context.threads);
    radii_[at] = settings.maxDist.value_or(
        std::max(maps_[at].TypicalRadius(settings.nUsed, &arena),
                 SmallestRadius(maps_[at].Size(), settings.nUsed, sceneRadius)));
    context.progress.Advance();
  }
  context.progress.End();
}

Spectrum PhotonMapSet::Radiance(PhotonKind kind, const ShadingPoint& point, Arena* arena,
                                LobeSet lobes, Spectrum* signedRadiance) const {
  return Radiance({kind, lobes}, point, arena, signedRadiance);
}

Spectrum PhotonMapSet::Radiance(const Part& part, const ShadingPoint& point, Arena* arena,
                                Spectrum* signedRadiance) const {
  if (signedRadiance) *signedRadiance = {};
  if (Map(part.kind).IsEmpty() || !point.bsdf.Has(part.lobes)) return {};
  const Arena::Mark mark = arena->GetMark();
  const PhotonNeighbourhood around = Around(part, point, arena);
  const Spectrum radiance = Estimate(part, point, around, around.radius2, signedRadiance);
  arena->Rewind(mark);
  return radiance;
}

PhotonMapSet::CorrectedRadiance PhotonMapSet::Corrected(PhotonKind kind, const ShadingPoint& point,
                                                        Arena* arena, LobeSet lobes,
                                                        Spectrum* signedRadiance) const {
  if (signedRadiance) *signedRadiance = {};
  if (Map(kind).IsEmpty() || !point.bsdf.Has(lobes)) return {};
  const Arena::Mark mark = arena->GetMark();
  const Part part{kind, lobes};
  const PhotonNeighbourhood around = Around(part, point, arena);
  const Spectrum wide = Estimate(part, point, around, around.radius2, signedRadiance);
  const Spectrum narrow = Estimate(part, point, around, around.radius2 / 2, nullptr);
  arena->Rewind(mark);
  return {wide, (narrow - wide) * 2};
}

PhotonNeighbourhood PhotonMapSet::Around(const Part& part, const ShadingPoint& point,
                                         Arena* arena) const {
  const Normal3 n = FaceForward(point.surface.ng, point.Wo());
  const bool isOneSided = !point.bsdf.Has(part.lobes & LobeSet::NonSpecularTransmission);
  const RestPose rest(point.surface);
  const PhotonQuery query{rest.Point(point.surface.p),
                          rest.Normal(n),
                          nUsed_,
                          MaxDistance(part.kind),
                          isOneSided,
                          false,
                          diskArea_};
  const PhotonMap& map = Map(part.kind);
  const PhotonNeighbourhood around = FindAt(point.surface.time, map, query, widest_, arena);
  if (part.hidden == HiddenPhotons::LeftOutInTheMean)
    return ProbablySeen(map, query, around, walls_, arena);
  return WithoutHidden(map, query, around, walls_, arena).around;
}

Spectrum PhotonMapSet::Estimate(const Part& part, const ShadingPoint& point,
                                const PhotonNeighbourhood& around, Real radius2,
                                Spectrum* signedRadiance) const {
  const LobeSet lobes = part.lobes;
  const PhotonMap& map = Map(part.kind);
  const Bsdf& bsdf = point.bsdf;
  const Normal3 n = FaceForward(point.surface.ng, point.Wo());
  const bool isOneSided = !bsdf.Has(lobes & LobeSet::NonSpecularTransmission);
  const RestPose rest(point.surface);
  // If every lobe is Lambertian, sum the power on each side first and reflect it once.
  constexpr LobeSet kGlossy = LobeSet::GlossyReflection | LobeSet::GlossyTransmission;
  const bool isDiffuse = !bsdf.Has(lobes & kGlossy) && bsdf.IsLambertian();
  const KernelDisk disk(kernel_, radius2);
  SignedSum front, back, glossy;
  // If the surface is also one-sided and has no bumps, photon directions do not matter: the search
  // has already tested the side.
  const bool isPlain = isDiffuse && isOneSided && bsdf.Ns() == point.smooth;
  for (std::size_t i = 0; i < around.photons.size(); ++i) {
    if (around.distance2[i] > radius2) continue;
    const std::uint32_t photon = around.photons[i];
    const Spectrum weighted = map.Alpha(photon) * disk.Weight(around.distance2[i]);
    const Real sign = signedRadiance ? map.Sign(photon) : Real(0);
    if (isPlain) {
      front.Add(weighted, sign);
      continue;
    }
    const Vector3 wi = rest.DirectionBack(map.Direction(photon));
    const Spectrum flux = weighted * CosineRatio(wi, bsdf.Ns(), point.smooth);
    if (!isDiffuse)
      glossy.Add(bsdf.f(point.Wo(), wi, lobes) * flux, sign);
    else
      (Dot(wi, n) > 0 ? front : back).Add(flux, sign);
  }
  const auto scattered = [&](Spectrum SignedSum::*sum) {
    const Real paths = Real(map.Paths()) * around.share;
    if (!isDiffuse) return glossy.*sum / paths;
    Spectrum both = front.*sum * bsdf.Rho(lobes & LobeSet::NonSpecularReflection) * kInvPi;
    if (!isOneSided)
      both += back.*sum * bsdf.Rho(lobes & LobeSet::NonSpecularTransmission) * kInvPi;
    return both / paths;
  };
  if (signedRadiance) *signedRadiance = scattered(&SignedSum::withSigns);
  return scattered(&SignedSum::plain);
}

Spectrum PhotonMapSet::Radiance(const ShadingPoint& point, Arena* arena, LobeSet lobes,
                                Spectrum* signedRadiance, HiddenPhotons hidden) const {
  Spectrum sum, signedSum;
  for (const PhotonKind kind : {PhotonKind::Direct, PhotonKind::Caustic, PhotonKind::Indirect}) {
    Spectrum signedPart;
    sum += Radiance({kind, lobes, hidden}, point, arena, signedRadiance ? &signedPart : nullptr);
    signedSum += signedPart;
  }
  if (signedRadiance) *signedRadiance = signedSum;
  return sum;
}

double PhotonMapSet::PhotonDensity(const ShadingPoint& point, Arena* arena) const {
  const Normal3 n = FaceForward(point.surface.ng, point.Wo());
  const bool isOneSided = !point.bsdf.Has(LobeSet::NonSpecularTransmission);
  const RestPose rest(point.surface);
  double density = 0;
  for (std::size_t m = 0; m < kPhotonKindCount; ++m) {
    if (maps_[m].IsEmpty()) continue;
    const Arena::Mark mark = arena->GetMark();
    const PhotonNeighbourhood around = maps_[m].Find(
        {rest.Point(point.surface.p), rest.Normal(n), nUsed_, radii_[m], isOneSided}, arena);
    density += double(around.photons.size()) / (double(kPi) * double(around.radius2));
    arena->Rewind(mark);
  }
  return density;
}

PhotonMapSet::Irradiance PhotonMapSet::EstimateIrradiance(const Point3& p, const Normal3& n,
                                                          Arena* arena, bool isCoated,
                                                          const ShadingNormals& normals) const {
  std::array<PhotonMap::Irradiance, kPhotonKindCount> parts;
  double density = 0;
  for (std::size_t m = 0; m < kPhotonKindCount; ++m) {
    if (maps_[m].IsEmpty()) continue;
    parts[m] = maps_[m].EstimateIrradiance(
        {p, n, nUsed_, radii_[m], true, isCoated, diskArea_, normals}, arena, walls_);
    density += parts[m].density;
  }
  Irradiance total;
  Real weight = 0, weightedRadius = 0;
  for (const PhotonMap::Irradiance& part : parts) {
    const Real light = (part.e + part.own).Y();
    weight += light;
    weightedRadius += light * part.radius;
    total.radius = std::max(total.radius, part.radius);
    total.isBesideWall = total.isBesideWall || part.isBesideWall;
  }
  if (weight > 0) total.radius = weightedRadius / weight;
  const double inReach = density * double(Square(total.radius)) * ownWeight_.Reach2();
  for (const PhotonMap::Irradiance& part : parts) {
    const Real own = Real(ownWeight_.In(density * part.ownDisk2, inReach));
    total.e += part.e + part.own * own;
    total.signedE += part.signedE + part.signedOwn * own;
  }
  return total;
}

}  // namespace exphoton
