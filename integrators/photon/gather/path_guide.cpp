// SPDX-License-Identifier: BSD-2-Clause
// PathGuide: BSDF sampling and the photons' cones at one vertex.
#include "integrators/photon/gather/path_guide.h"

#include <algorithm>

namespace exphoton {
namespace {

// The probability that a technique samples a direction lies between these bounds. The lower one
// keeps the estimate unbiased, and limits the weight of a path where photons missed light. The
// upper one is as in plain path tracing, and ends paths between surfaces that absorb nothing.
constexpr Real kMinCount = Real(.1), kMaxCount = Real(.98);
constexpr int kLimitedDepth = 4;  // vertices before the upper bound begins
// Number of paths that carry on the light of a camera sample where there is enough of it. More than
// one, because then both techniques are sampled at the first vertices. The error at equal time
// hardly changes from 3 to 10.
constexpr Real kPaths = 4;

Real Count(Real expected, int depth) {
  return std::clamp(expected, kMinCount, depth < kLimitedDepth ? Real(1) : kMaxCount);
}

// Returns the share of the diffuse lobes in the reflectance of the non-specular lobes, > 0.
Real DiffuseShare(const Bsdf& bsdf, const Spectrum& reflectance) {
  if (!bsdf.Has(LobeSet::Glossy)) return 1;
  return std::min(bsdf.Rho(LobeSet::Diffuse).Y() / reflectance.Y(), Real(1));
}

}  // namespace

std::optional<PathDirection> GuidedVertex::Sample(const PathVertexVariates& u,
                                                  LobeSet lobes) const {
  if (!(u.roulette < bsdfCount_) && isRouletted_) return std::nullopt;
  const auto sample = point_.bsdf.Sample(point_.Wo(), u.bsdf, u.bsdfLobe, lobes);
  if (!sample) return std::nullopt;
  PathDirection direction{*sample, isRouletted_};
  if (!isRouletted_) return direction;
  if (sample->IsSpecular()) {
    direction.sample.throughput /= bsdfCount_;
  } else {
    direction.sample.pdf = Pdf(sample->wi, sample->pdf);
    direction.sample.throughput *= sample->pdf / direction.sample.pdf;
  }
  return direction;
}

std::optional<PathDirection> GuidedVertex::SampleBranch(const PathVertexVariates& u,
                                                        LobeSet lobes) const {
  if (!(u.branchRoulette < guideCount_)) return std::nullopt;
  // The axes are in Hilbert order: axis and azimuth are stratified jointly.
  const auto drawn = guide_.Draw(u.branch.x, {u.branchPart, u.branch.y});
  const BsdfValue scattered = point_.bsdf.Evaluate(point_.Wo(), drawn.w, lobes);
  if (scattered.f.IsBlack()) return std::nullopt;
  PathDirection direction;
  direction.isRouletted = true;
  BsdfSample& sample = direction.sample;
  sample.wi = drawn.w;
  sample.pdf = guideCount_ * drawn.pdf + bsdfCount_ * scattered.pdf;
  sample.throughput = scattered.f * (AbsDot(drawn.w, point_.bsdf.Ns()) / sample.pdf);
  sample.lobe = lobes & LobeSet::NonSpecular;
  return direction;
}

GuidedVertex PathGuide::At(const ShadingPoint& point, bool maySplit, PathWeight* weight,
                           LiContext& context) const {
  if (!photons_.IsOn() || !maySplit || !point.bsdf.Has(LobeSet::NonSpecular))
    return GuidedVertex(point);
  const GuidedDirections guide = photons_.DirectionsOnPath(point, context);
  const Spectrum reflectance = point.bsdf.Rho(LobeSet::NonSpecular);
  const Real expected = (weight->beta * reflectance).Y() * guide.irradiance;
  if (!(expected > 0)) return GuidedVertex(point);
  if (!(weight->expectedLight > 0)) weight->expectedLight = expected;
  const Real paths = kPaths * expected / weight->expectedLight;
  // The photons speak for diffuse lobes. The BSDF alone finds the light of narrow glossy lobes.
  const Real guided = guide.share * DiffuseShare(point.bsdf, reflectance);
  Real bsdfCount = Count(paths * (1 - guided), point.depth);
  // Photons do not know the light that arrives over specular lobes.
  if (point.bsdf.Has(LobeSet::Specular)) {
    const Real survival = weight->beta.MaxComponent() * weight->rouletteScale;
    bsdfCount =
        std::max(bsdfCount, point.depth < kLimitedDepth ? Real(1) : Count(survival, point.depth));
  }
  if (guide.axes.size() == 0) return {point, bsdfCount, {}, 0};
  return {point, bsdfCount, ConeMixture(guide.axes, cone_),
          Count(paths * guide.share, point.depth)};
}

}  // namespace exphoton
