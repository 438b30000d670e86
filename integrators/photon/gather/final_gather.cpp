// SPDX-License-Identifier: BSD-2-Clause
// FinalGather divides the rays between the two techniques, requests their samples and draws them.
#include "integrators/photon/gather/final_gather.h"

#include <limits>

namespace exphoton {
namespace {

// Returns the reflectance of the diffuse lobe if the gather is shared, 0 otherwise. Light that is
// transmitted diffusely comes from another hemisphere, and dark surfaces are not worth sharing.
Spectrum SharedReflectance(const Bsdf& bsdf, const LiContext& context) {
  constexpr Real kMinReflectance = Real(1e-3);
  if (!context.gathers || bsdf.Has(LobeSet::DiffuseTransmission)) return {};
  const Spectrum reflectance = bsdf.Rho(LobeSet::DiffuseReflection);
  return reflectance.MaxComponent() > kMinReflectance ? reflectance : Spectrum();
}

}  // namespace

FinalGather::FinalGather(const PhotonSettings& settings)
    : cone_(Radians(settings.gatherAngle)), rrThreshold_(settings.rrThreshold) {
  const int rays = settings.finalGatherSamples;
  const bool isGuided = settings.gatherSampling != GatherSampling::Bsdf && rays > 1;
  splits_ = SplitsOf(rays, isGuided);
  // Two rays at least, because a single ray has no guide.
  if (settings.edgeSamples > 1)
    dividedSplits_ = SplitsOf(std::max(rays / settings.edgeSamples, std::min(rays, 2)), isGuided);
  guide_ = PhotonGuide(isGuided ? settings.gatherPhotons : 0, cone_, settings.gatherSampling);
}

std::vector<FinalGather::Split> FinalGather::SplitsOf(int rays, bool isGuided) {
  std::vector<Split> splits;
  for (int guided = isGuided ? rays / 2 : 0; guided > 0; guided /= 2)
    splits.push_back({rays - guided, guided});
  splits.push_back({rays, 0});
  return splits;
}

void FinalGather::RequestSamples(bool gathers, SampleLayout* layout) {
  for (std::vector<Split>* splits : {&splits_, &dividedSplits_}) {
    for (Split& split : *splits) {
      const int bsdf = gathers ? split.bsdfRays : 0, photons = gathers ? split.photonRays : 0;
      split.directions = layout->Request2D(bsdf);
      split.lobes = layout->Request1D(bsdf);
      split.cones = layout->Request2D(photons);
      split.radii = layout->Request1D(photons);
    }
  }
}

FinalGather::Rays::Rays(std::size_t most, const Bsdf& bsdf, LiContext& context)
    : directions(context.arena.AllocateArray<Vector3>(most)),
      weights(context.arena.AllocateArray<Spectrum>(most)),
      reflectance(SharedReflectance(bsdf, context)) {
  if (reflectance.IsBlack()) return;
  white = context.arena.AllocateArray<Spectrum>(most);
  isAllShared = !bsdf.Has(LobeSet::Glossy);
  brightest_ = reflectance.g > reflectance.r ? 1 : 0;
  if (reflectance.b > reflectance[brightest_]) brightest_ = 2;
  least_ = Real(1e-4) * reflectance[brightest_];
  for (int c = 0; c < Spectrum::kChannels; ++c)
    hasDarkChannel_ = hasDarkChannel_ || !(reflectance[c] > least_);
}

void FinalGather::Rays::Separate(const Spectrum& weight, const ShadingPoint& point, Real scale) {
  if (isAllShared) {
    white[count] = OffWhite(weight);
    return;
  }
  const Spectrum diffuse =
      point.bsdf.f(point.Wo(), directions[count], LobeSet::DiffuseReflection) * scale;
  white[count] = OffWhite(diffuse);
  weights[count] = Clamp(weight - diffuse, 0, std::numeric_limits<Real>::max());
}

Spectrum FinalGather::Rays::OffWhite(const Spectrum& light) const {
  if (!hasDarkChannel_)
    return {light.r / reflectance.r, light.g / reflectance.g, light.b / reflectance.b};
  Spectrum result;
  for (int c = 0; c < Spectrum::kChannels; ++c) {
    const int shown = reflectance[c] > least_ ? c : brightest_;
    result[c] = light[shown] / reflectance[shown];
  }
  return result;
}

const Spectrum* FinalGather::Rays::AllWeights(LiContext& context) const {
  if (!white) return weights;
  Spectrum* all = context.arena.AllocateArray<Spectrum>(count);
  for (std::size_t i = 0; i < count; ++i) {
    all[i] = white[i] * reflectance;
    if (!isAllShared) all[i] += weights[i];
  }
  return all;
}

FinalGather::Rays FinalGather::DrawRays(const ShadingPoint& point, LiContext& context) const {
  const Bsdf& bsdf = point.bsdf;
  const GuidedDirections guide = guide_.Directions(point, context);
  const GuideDensity density(guide, cone_);
  const Split& split = SplitFor(guide, context.isDivided ? dividedSplits_ : splits_);
  const Vector3& wo = point.Wo();
  RandomStream roulette = context.Stream(kRouletteStream + std::uint64_t(point.depth));

  Rays rays(std::size_t(split.bsdfRays + split.photonRays), bsdf, context);
  // `weight` is |cos| / pdf, times the weight of the power heuristic.
  const auto add = [&](const Vector3& w, const Spectrum& contribution, Real weight, Real photonPdf,
                       int drawn) {
    Real factor =
        SurvivalFactor(contribution.Y(), guide.share * photonPdf, AbsDot(w, bsdf.Ns()), &roulette);
    if (!(factor > 0)) return;
    factor /= Real(drawn);
    rays.Add(w, contribution * factor, point, weight * factor);
  };
  const auto squares = context.samples.Array2D(split.directions);
  const bool picksLobe = bsdf.Count(kLobes) > 1;
  const auto lobes = picksLobe ? context.samples.Array1D(split.lobes) : std::span<const Real>();
  for (std::size_t i = 0; i < squares.size(); ++i) {
    const auto sample = bsdf.Sample(wo, squares[i], picksLobe ? lobes[i] : 0, kLobes);
    if (!sample) continue;
    const Real photonPdf = density.IsEmpty() ? Real(0) : density.Pdf(sample->wi);
    const Real weight = PowerHeuristic(split.bsdfRays, sample->pdf, split.photonRays, photonPdf);
    const Real cosine = AbsDot(sample->wi, bsdf.Ns());
    add(sample->wi, sample->throughput * weight, cosine * weight / sample->pdf, photonPdf,
        split.bsdfRays);
  }
  const auto along = context.samples.Array2D(split.cones);
  const auto radii = context.samples.Array1D(split.radii);
  for (std::size_t i = 0; i < along.size(); ++i) {
    // The axes are in Hilbert order: axis and azimuth are stratified jointly.
    const auto sample = density.Draw(along[i].x, {radii[i], along[i].y});
    const BsdfValue scattered = bsdf.Evaluate(wo, sample.w, kLobes);
    if (scattered.f.IsBlack()) continue;
    const Real weight = PowerHeuristic(split.photonRays, sample.pdf, split.bsdfRays, scattered.pdf);
    const Real scale = AbsDot(sample.w, bsdf.Ns()) * weight / sample.pdf;
    add(sample.w, scattered.f * scale, scale, sample.pdf, split.photonRays);
  }
  return rays;
}

}  // namespace exphoton
