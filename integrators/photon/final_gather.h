// SPDX-License-Identifier: BSD-2-Clause
// FinalGather: indirect light at a point by rays over its hemisphere, half of them drawn by the
// BSDF, half round the directions of nearby photons, combined with the power heuristic
// (Veach 1997, section 9.2; docs/exphotonmap.md, eq. 16 and 17). What a ray brings is another's
// affair.
#pragma once

#include "core/math/mis.h"
#include "core/transport/integrator.h"
#include "core/transport/shading_point.h"
#include "integrators/photon/cone_mixture.h"
#include "integrators/photon/gather_guide.h"
#include "integrators/photon/photon_map.h"
#include "integrators/photon/photon_settings.h"

namespace exphoton {

class FinalGather {
 public:
  FinalGather() = default;
  explicit FinalGather(const PhotonSettings& settings);

  // Where nothing will be gathered the requests are empty, and leave those of others as they are.
  void RequestSamples(bool gathers, SampleLayout* layout);

  // To be called when the photons are there, which must outlive the pass.
  void Prepare(const PhotonMap& photons) { guide_.Prepare(photons); }

  // Integral over the non-specular lobes of f * incident * |cos|, by rays with 0 < t < infinity.
  // All are traced before the first is read, so that caches hold the one or the other:
  // incident.Trace(ray) gives an Incident::Segment, incident.Look(segments) then looks at all of
  // them together, incident.Read(segment) gives the radiance.
  template <class Incident>
  Spectrum Gather(const ShadingPoint& point, const PhotonMap& photons, LiContext& context,
                  const Incident& incident) const;

 private:
  // Fixed once a gather, and the same for f, Pdf and Sample.
  static constexpr LobeSet kLobes = LobeSet::NonSpecular;
  static constexpr std::uint64_t kRouletteStream = 0x676174686572ull;

  // Roulette (eq. 18): the factor to trace a ray of weight c with, or 0. Photons tell how many
  // times brighter than on average its direction is, pi lightPdf / |cos|; where they found nothing
  // they may have missed something.
  Real SurvivalFactor(Real c, Real lightPdf, Real absCos, RandomStream* random) const {
    const Real expected = c * std::max(absCos, kPi * lightPdf);
    const Real threshold = rrThreshold_ * absCos;
    if (!(expected < threshold)) return 1;
    const Real survival = expected / threshold;
    return random->Uniform() < survival ? 1 / survival : Real(0);
  }

  int bsdfCount_ = 0, photonCount_ = 0;  // rays by each technique
  GatherGuide guide_;
  Cone cone_;
  Real rrThreshold_ = 0;
  int bsdfDirections_ = -1, bsdfLobes_ = -1, photonDirections_ = -1, photonRadii_ = -1;
};

template <class Incident>
Spectrum FinalGather::Gather(const ShadingPoint& point, const PhotonMap& photons,
                             LiContext& context, const Incident& incident) const {
  const Bsdf& bsdf = point.bsdf;
  if (!bsdf.Has(kLobes)) return {};
  const Arena::Mark mark = context.arena.GetMark();
  const GuideDirections guide = guide_.Directions(point, photons, context);
  const ConeMixture cones(guide.axes, cone_);
  const bool isGuided = !cones.IsEmpty();
  // Without a guide the photons' share of the rays follows the BSDF too.
  const int bsdfRays = isGuided ? bsdfCount_ : bsdfCount_ + photonCount_;
  const int photonRays = isGuided ? photonCount_ : 0;
  const Vector3& wo = point.Wo();
  const RayFan fan(point.surface);
  RandomStream roulette = context.Stream(kRouletteStream + std::uint64_t(point.depth));

  const auto rays = std::size_t(bsdfRays + photonRays);
  using Segment = typename Incident::Segment;
  Segment* const segments = context.arena.template Room<Segment>(rays);
  Spectrum* const weights = context.arena.template Room<Spectrum>(rays);
  std::size_t count = 0;
  const auto add = [&](const Vector3& w, const Spectrum& contribution, Real photonPdf, int drawn) {
    const Real factor =
        SurvivalFactor(contribution.Y(), guide.share * photonPdf, AbsDot(w, bsdf.Ns()), &roulette);
    if (!(factor > 0)) return;
    new (segments + count) Segment(incident.Trace(fan.Towards(w)));
    weights[count++] = contribution * (factor / Real(drawn));
  };
  for (int i = 0; i < bsdfRays; ++i) {
    const bool isOwn = i < bsdfCount_;
    const auto at = std::size_t(isOwn ? i : i - bsdfCount_);
    const Point2 u = context.samples.Array2D(isOwn ? bsdfDirections_ : photonDirections_)[at];
    const Real uLobe = context.samples.Array1D(isOwn ? bsdfLobes_ : photonRadii_)[at];
    const auto sample = bsdf.Sample(wo, u, uLobe, kLobes);
    if (!sample) continue;
    const Real photonPdf = isGuided ? cones.Pdf(sample->wi) : Real(0);
    const Real weight = PowerHeuristic(bsdfRays, sample->pdf, photonRays, photonPdf);
    add(sample->wi, sample->throughput * weight, photonPdf, bsdfRays);
  }
  for (int i = 0; i < photonRays; ++i) {
    const auto at = std::size_t(i);
    // The axes follow a curve: where along it and which way from there are stratified together.
    const Point2 u = context.samples.Array2D(photonDirections_)[at];
    const Real uRadius = context.samples.Array1D(photonRadii_)[at];
    const auto sample = cones.Draw(u.x, {uRadius, u.y});
    const BsdfValue scattered = bsdf.Evaluate(wo, sample.w, kLobes);
    if (scattered.f.IsBlack()) continue;
    const Real weight = PowerHeuristic(photonRays, sample.pdf, bsdfRays, scattered.pdf);
    add(sample.w, scattered.f * (AbsDot(sample.w, bsdf.Ns()) * weight / sample.pdf), sample.pdf,
        photonRays);
  }

  incident.Look(std::span<Segment>(segments, count));
  Spectrum gathered;
  for (std::size_t i = 0; i < count; ++i) gathered += weights[i] * incident.Read(segments[i]);
  context.arena.Rewind(mark);
  return gathered;
}

}  // namespace exphoton
