// SPDX-License-Identifier: BSD-2-Clause
// FinalGather divides the rays between the two techniques, requests their samples and draws them.
#include "integrators/photon/gather/final_gather.h"

namespace exphoton {

FinalGather::FinalGather(const PhotonSettings& settings)
    : cone_(Radians(settings.gatherAngle)), rrThreshold_(settings.rrThreshold) {
  const int rays = settings.finalGatherSamples;
  const bool isGuided = settings.gatherSampling == GatherSampling::Photons && rays > 1;
  for (int guided = isGuided ? rays / 2 : 0; guided > 0; guided /= 2)
    splits_.push_back({rays - guided, guided});
  splits_.push_back({rays, 0});
  guide_ = PhotonGuide(isGuided ? settings.gatherPhotons : 0, cone_);
}

void FinalGather::RequestSamples(bool gathers, SampleLayout* layout) {
  for (Split& split : splits_) {
    const int bsdf = gathers ? split.bsdfRays : 0, photons = gathers ? split.photonRays : 0;
    split.directions = layout->Request2D(bsdf);
    split.lobes = layout->Request1D(bsdf);
    split.cones = layout->Request2D(photons);
    split.radii = layout->Request1D(photons);
  }
}

FinalGather::Rays FinalGather::DrawRays(const ShadingPoint& point, const PhotonMap& photons,
                                        LiContext& context) const {
  const Bsdf& bsdf = point.bsdf;
  const GuidedDirections guide = guide_.Directions(point, photons, context);
  const ConeMixture cones(guide.axes, cone_);
  const Split& split = SplitFor(guide);
  const Vector3& wo = point.Wo();
  RandomStream roulette = context.Stream(kRouletteStream + std::uint64_t(point.depth));

  const auto most = std::size_t(split.bsdfRays + split.photonRays);
  Rays rays{context.arena.AllocateArray<Vector3>(most),
            context.arena.AllocateArray<Spectrum>(most)};
  const auto add = [&](const Vector3& w, const Spectrum& contribution, Real photonPdf, int drawn) {
    const Real factor =
        SurvivalFactor(contribution.Y(), guide.share * photonPdf, AbsDot(w, bsdf.Ns()), &roulette);
    if (!(factor > 0)) return;
    rays.directions[rays.count] = w;
    rays.weights[rays.count++] = contribution * (factor / Real(drawn));
  };
  const auto squares = context.samples.Array2D(split.directions);
  const bool picksLobe = bsdf.Count(kLobes) > 1;
  const auto lobes = picksLobe ? context.samples.Array1D(split.lobes) : std::span<const Real>();
  for (std::size_t i = 0; i < squares.size(); ++i) {
    const auto sample = bsdf.Sample(wo, squares[i], picksLobe ? lobes[i] : 0, kLobes);
    if (!sample) continue;
    const Real photonPdf = cones.IsEmpty() ? Real(0) : cones.Pdf(sample->wi);
    const Real weight = PowerHeuristic(split.bsdfRays, sample->pdf, split.photonRays, photonPdf);
    add(sample->wi, sample->throughput * weight, photonPdf, split.bsdfRays);
  }
  const auto along = context.samples.Array2D(split.cones);
  const auto radii = context.samples.Array1D(split.radii);
  for (std::size_t i = 0; i < along.size(); ++i) {
    // The axes are in Hilbert order: axis and azimuth are stratified jointly.
    const auto sample = cones.Draw(along[i].x, {radii[i], along[i].y});
    const BsdfValue scattered = bsdf.Evaluate(wo, sample.w, kLobes);
    if (scattered.f.IsBlack()) continue;
    const Real weight = PowerHeuristic(split.photonRays, sample.pdf, split.bsdfRays, scattered.pdf);
    add(sample.w, scattered.f * (AbsDot(sample.w, bsdf.Ns()) * weight / sample.pdf), sample.pdf,
        split.photonRays);
  }
  return rays;
}

}  // namespace exphoton
