// SPDX-License-Identifier: BSD-2-Clause
// ExactRadiance: one vertex of a guided path, with several rays, at each hit whose read is
// corrected.
#include "integrators/photon/certificate/exact_radiance.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/transport/light_sample.h"
#include "integrators/photon/certificate/caustic_rays.h"

namespace exphoton {
namespace {

// Bounds of the expected number of reads that the rays of a hit have corrected, where they read as
// much as the hit. In between, it is a^1.5 for the albedo a. The variance of nested corrections
// then falls by a^.5 from bounce to bounce. With a^2 it would be the same at each bounce, so that a
// few long chains would have most of it. The upper bound ends chains between surfaces that absorb
// nothing.
constexpr Real kMinNested = Real(.1), kMaxNested = Real(.95);
// Bounds the stack. Reads after more bounces keep their error.
constexpr int kMostNested = 100;
// Rays of a hit. They take little time beside the BSDF and the guide of the hit, which they share.
constexpr int kRays = 4;
// Bounds of the share of guided rays, where there is a guide.
constexpr Real kMinGuided = Real(.25), kMaxGuided = Real(.5);

Real Fraction(Real x) { return std::min(x - std::floor(x), kOneMinusEpsilon); }

}  // namespace

ExactRadiance::ExactRadiance(const CorrectionSources& sources, LiContext& context,
                             RandomStream* random)
    : sources_(sources),
      context_(context),
      random_(random),
      cone_(Radians(sources.settings.gatherAngle)),
      gather_(sources.maps, sources.radianceMap, sources.settings, sources.lights, context,
              random) {
  gather_.SetCorrector(this);
}

Spectrum ExactRadiance::Correction(const GatherRay::Segment& segment, Real light) {
  light_ = light;
  parent_ = {};
  return gather_.Follow(segment, {}, 0).correction;
}

// Russian roulette in proportion to what the ray adds to its parent: the error of a read is about
// as large as its light. `light_` is added to all reads, so that no chance becomes too small. Along
// a chain, the ratios of importances multiply to the ratio of the last and the first one, so its
// expected length is bounded.
Real ExactRadiance::Survival(Real importance, Real throughput) const {
  if (!parent_) return 1;
  const Real ratio = light_ > 0 ? importance / parent_->importance : Real(1);
  return std::min(parent_->count * parent_->share * std::min(throughput, Real(1)) * ratio, Real(1));
}

Spectrum ExactRadiance::Correct(const GatherRay::Segment& segment, const Spectrum& read,
                                Real throughput) {
  const Real importance = read.Y() + light_;
  const Real survival = Survival(importance, throughput);
  if (survival < 1 && !(random_->Uniform() < survival)) return {};
  if (depth_ == kMostNested) return {};
  const Arena::Mark mark = context_.arena.GetMark();
  const ShadingPoint point = gather_.Shade(segment);
  const Real albedo = point.bsdf.Rho(gather_.MappedLobes()).MaxComponent();
  const std::optional<Parent> parent = parent_;
  const Real expected = std::clamp(albedo * std::sqrt(albedo), kMinNested, kMaxNested);
  parent_ = {expected, importance, 0};
  ++depth_;
  const Spectrum exact = Sample(point);
  --depth_;
  parent_ = parent;
  context_.arena.Rewind(mark);
  return (exact - read) / survival;
}

Spectrum ExactRadiance::Sample(const ShadingPoint& point) {
  const LobeSet lobes = gather_.MappedLobes();
  if (!point.bsdf.Has(lobes)) return {};
  const Rays rays = RaysAt(point);
  return Direct(point, rays) + Caustic(point) + AlongRays(point, rays);
}

Spectrum ExactRadiance::Caustic(const ShadingPoint& point) {
  const LobeSet lobes = gather_.MappedLobes();
  if (sources_.causticGuide)
    return CausticRays(*sources_.causticGuide, cone_, context_, random_).Sample(point, lobes);
  const auto corrected =
      sources_.maps.Corrected(PhotonKind::Caustic, point, &context_.arena, lobes);
  return corrected.radiance + corrected.correction;
}

ExactRadiance::Rays ExactRadiance::RaysAt(const ShadingPoint& point) {
  const GuidedDirections guide = sources_.guide.Directions(point, context_);
  if (guide.axes.size() == 0) return {{}, kRays, 0};
  const Real share = std::clamp(guide.share, kMinGuided, kMaxGuided);
  const int guided = int(std::lround(share * Real(kRays)));
  return {ConeMixture(guide.axes, cone_), kRays - guided, guided};
}

Spectrum ExactRadiance::Direct(const ShadingPoint& point, const Rays& rays) {
  const LightSampler& lights = sources_.lights;
  if (lights.IsEmpty()) return {};
  const auto choice = lights.Sample(point.surface.p, random_->Uniform());
  const Point2 place{random_->Uniform(), random_->Uniform()};
  const SampledLight sample{choice.light, choice.probability, place, random_->Uniform()};
  return FromLightSample(point, sample, rays, gather_.MappedLobes(), context_);
}

std::optional<BsdfSample> ExactRadiance::Draw(const ShadingPoint& point, const Rays& rays,
                                              int index, const Point2& u) {
  const LobeSet lobes = gather_.MappedLobes();
  // A rank-1 lattice: the golden ratio spreads any number of points.
  constexpr Real kGolden = Real(.6180339887);
  const bool isGuided = index >= rays.bsdfCount;
  const int own = isGuided ? index - rays.bsdfCount : index;
  const int count = isGuided ? rays.guideCount : rays.bsdfCount;
  const Point2 place{Fraction(u.x + Real(own) / Real(count)), Fraction(u.y + Real(own) * kGolden)};
  const Real part = random_->Uniform();
  std::optional<BsdfSample> sample;
  if (!isGuided) {
    sample = point.bsdf.Sample(point.Wo(), place, part, lobes);
    if (!sample) return sample;
    const Real pdf = rays.Pdf(sample->wi, sample->pdf);
    sample->throughput *= sample->pdf / pdf;
    sample->pdf = pdf;
    return sample;
  }
  // The axes are in Hilbert order, so the first number stratifies directions.
  sample.emplace();
  sample->wi = rays.guide.Draw(place.x, {part, place.y}).w;
  const BsdfValue scattered = point.bsdf.Evaluate(point.Wo(), sample->wi, lobes);
  sample->pdf = rays.Pdf(sample->wi, scattered.pdf);
  sample->throughput = scattered.f * (AbsDot(sample->wi, point.bsdf.Ns()) / sample->pdf);
  return sample;
}

Spectrum ExactRadiance::AlongRays(const ShadingPoint& point, const Rays& rays) {
  std::array<std::optional<GatherRay::Segment>, kRays> segments;
  std::array<BsdfSample, kRays> samples;
  Real throughput = 0;  // luminance of all rays
  const Point2 u{random_->Uniform(), random_->Uniform()};
  for (int i = 0; i < kRays; ++i) {
    const auto sample = Draw(point, rays, i, u);
    if (!sample || sample->throughput.IsBlack() || !sample->throughput.IsFinite()) continue;
    samples[std::size_t(i)] = *sample;
    throughput += sample->throughput.Y();
    segments[std::size_t(i)] = gather_.Trace(SpawnRay(point.surface, sample->wi));
  }
  Spectrum sum;
  for (std::size_t i = 0; i < kRays; ++i) {
    if (!segments[i]) continue;
    gather_.LookUp({&*segments[i], 1});
    parent_->share = samples[i].throughput.Y() / throughput;
    const auto light = gather_.Follow(*segments[i], point.surface, samples[i].pdf);
    sum += samples[i].throughput * (light.radiance + light.correction);
  }
  return sum;
}

}  // namespace exphoton
