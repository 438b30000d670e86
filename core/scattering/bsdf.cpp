// SPDX-License-Identifier: BSD-2-Clause
// Bsdf combines lobes under a mask. The geometric normal alone separates reflection from
// transmission. A direction on different sides of the shading normal and the geometric normal is
// handled before any lobe sees it (Veach 1997, section 5.3).
#include "core/scattering/bsdf.h"

#include <span>

#include "core/base/error.h"
#include "core/scattering/lobes/local_frame.h"

namespace exphoton {
namespace {

// The frame's x axis follows dpdu, so that anisotropic lobes lie along the surface's parameters.
Frame ShadingFrame(const SurfaceInteraction& si) {
  const Normal3& n = si.shading.n;
  const Vector3 tangent = NormalizeOr(si.shading.dpdu, Vector3());
  const Vector3 x = tangent - n * Dot(n, tangent);
  const Real length2 = LengthSquared(x);
  if (!(length2 > Real(1e-8))) return Frame::FromZ(n);  // no tangent, or parallel to n
  Frame frame;
  frame.x = x / std::sqrt(length2);
  frame.y = Cross(n, frame.x);
  frame.z = n;
  return frame;
}

// LocalOut is wo in the local frame, on the side of the geometric normal. If the two normals
// disagree, the sign of its cosine is flipped, so that the point is seen under a grazing view
// instead of being black.
struct LocalOut {
  Vector3 wo;
  Real side = 0;  // wo . ng
  bool isMirrored = false;
};

LocalOut ToLocalOut(const Frame& frame, const Normal3& ng, const Vector3& wo) {
  LocalOut out{frame.ToLocal(wo), Dot(wo, ng), false};
  out.isMirrored = (out.wo.z < 0) != (out.side < 0);
  if (out.isMirrored) out.wo.z = -out.wo.z;
  return out;
}

// Returns the lobe kinds that scatter between two directions with these cosines to the geometric
// normal.
LobeSet ScatteringSides(Real woSide, Real wiSide) {
  if (woSide == 0 || wiSide == 0) return LobeSet::None;
  return (woSide > 0) == (wiSide > 0) ? LobeSet::Reflection : LobeSet::Transmission;
}

// MatchingLobes holds the lobes under a mask, with the specular lobes separate.
struct MatchingLobes {
  std::array<const Bxdf*, Bsdf::kMaxLobes> specular, smooth;
  std::size_t specularCount = 0, smoothCount = 0;

  MatchingLobes(std::span<const Bxdf* const> lobes, LobeSet mask) {
    for (const Bxdf* lobe : lobes) {
      if (!lobe->Matches(mask)) continue;
      if (lobe->Matches(LobeSet::Specular)) {
        specular[specularCount++] = lobe;
      } else {
        smooth[smoothCount++] = lobe;
      }
    }
  }
  std::span<const Bxdf* const> Specular() const { return {specular.data(), specularCount}; }
};

// Samples one of these specular lobes in proportion to the largest component of its coefficient.
// Glass thus reflects a Fresnel share of the photons, each with nearly its full power. wi stays
// local.
std::optional<BsdfSample> SampleSpecular(std::span<const Bxdf* const> lobes, const Vector3& wo,
                                         Real u) {
  std::array<BsdfSample, Bsdf::kMaxLobes> found;
  std::array<Real, Bsdf::kMaxLobes> weight;
  std::size_t count = 0;
  Real total = 0;
  for (const Bxdf* lobe : lobes) {
    const auto local = lobe->Sample(wo, {});
    if (!local) continue;
    const Real w = local->throughput.MaxComponent();
    if (!(w > 0) || !std::isfinite(w)) continue;
    found[count] = {local->wi, local->throughput, local->pdf, lobe->Lobe(), local->eta};
    weight[count++] = w;
    total += w;
  }
  if (count == 0) return std::nullopt;
  std::size_t i = 0;
  for (Real left = u * total; i + 1 < count && left >= weight[i]; ++i) left -= weight[i];
  BsdfSample sample = found[i];
  const Real probability = count == 1 ? 1 : weight[i] / total;
  sample.pdf *= probability;
  sample.throughput /= probability;
  return sample;
}

// Drawn is a direction sampled from a smooth lobe, in the local frame. `drawn` is the direction as
// sampled, where its density is known. `seen` is the direction for which lobes are evaluated. They
// differ for a photon that leaves behind the shading normal: the sampled direction was behind the
// geometric normal and was reversed, and lobes see the reversed direction mirrored in z. The
// hemisphere of the geometric normal is thus covered once, with the density |wi.ns| of the sampled
// direction. `wo` is the outgoing direction.
struct Drawn {
  Vector3 wo, drawn, seen;
};

// Replaces the density of the picked lobe by the mean over all matching lobes, and its value by the
// sum of the lobes that scatter between these sides.
void CombineSmooth(const MatchingLobes& lobes, std::size_t picked, LobeSet served, const Drawn& wi,
                   BsdfSample* sample) {
  Spectrum f;
  Real pdf = 0;
  for (std::size_t i = 0; i < lobes.smoothCount; ++i) {
    const Bxdf& lobe = *lobes.smooth[i];
    if (!lobe.Matches(served)) continue;
    f += lobe.f(wi.wo, wi.seen);
    pdf += i == picked ? sample->pdf : lobe.Pdf(wi.wo, wi.drawn);
  }
  sample->pdf = pdf / Real(lobes.specularCount + lobes.smoothCount);
  if (sample->pdf > 0) sample->throughput = f * (std::abs(wi.drawn.z) / sample->pdf);
}

}  // namespace

Bsdf::Bsdf(const SurfaceInteraction& si) : frame_(ShadingFrame(si)), ng_(si.ng) {}

void Bsdf::Add(const Bxdf* lobe) {
  if (!lobe) return;
  if (count_ == kMaxLobes) throw Error(ExitStatus::Internal, "a material made too many lobes");
  lobes_[std::size_t(count_++)] = lobe;
  present_ = present_ | lobe->Lobe();
  isCoated_ = isCoated_ || lobe->IsCoated();
}

int Bsdf::Count(LobeSet mask) const {
  int count = 0;
  for (int i = 0; i < count_; ++i) count += lobes_[std::size_t(i)]->Matches(mask);
  return count;
}

// Calls visit(lobe, wo, wi) for each masked smooth lobe that scatters between these sides, in the
// local frame.
template <class Visit>
void Bsdf::VisitMatching(const Vector3& wo, const Vector3& wi, LobeSet mask,
                         const Visit& visit) const {
  const LocalOut out = ToLocalOut(frame_, ng_, wo);
  const LobeSet served = mask & ScatteringSides(out.side, Dot(wi, ng_)) & LobeSet::NonSpecular;
  if (!Has(served)) return;
  const Vector3 localWi = frame_.ToLocal(wi);
  for (int i = 0; i < count_; ++i) {
    const Bxdf& lobe = *lobes_[std::size_t(i)];
    if (lobe.Matches(served)) visit(lobe, out.wo, localWi);
  }
}

Spectrum Bsdf::f(const Vector3& wo, const Vector3& wi, LobeSet mask) const {
  Spectrum sum;
  VisitMatching(wo, wi, mask,
                [&](const Bxdf& lobe, const Vector3& o, const Vector3& i) { sum += lobe.f(o, i); });
  return sum;
}

Real Bsdf::Pdf(const Vector3& wo, const Vector3& wi, LobeSet mask) const {
  Real sum = 0;
  VisitMatching(wo, wi, mask, [&](const Bxdf& lobe, const Vector3& o, const Vector3& i) {
    sum += lobe.Pdf(o, i);
  });
  return sum == 0 ? 0 : sum / Real(Count(mask));
}

BsdfValue Bsdf::Evaluate(const Vector3& wo, const Vector3& wi, LobeSet mask) const {
  BsdfValue value;
  VisitMatching(wo, wi, mask, [&](const Bxdf& lobe, const Vector3& o, const Vector3& i) {
    value.f += lobe.f(o, i);
    value.pdf += lobe.Pdf(o, i);
  });
  if (value.pdf != 0) value.pdf /= Real(Count(mask));
  return value;
}

std::optional<BsdfSample> Bsdf::Sample(const Vector3& wo, Point2 u, Real uLobe, LobeSet mask,
                                       TransportMode mode) const {
  const MatchingLobes lobes(std::span(lobes_.data(), std::size_t(count_)), mask);
  const int count = int(lobes.specularCount + lobes.smoothCount);
  if (count == 0) return std::nullopt;
  const LocalOut out = ToLocalOut(frame_, ng_, wo);
  if (out.side == 0 || out.wo.z == 0) return std::nullopt;

  const Real position = uLobe * Real(count);
  if (position < Real(lobes.specularCount)) {
    auto sample = SampleSpecular(lobes.Specular(), out.wo, position / Real(lobes.specularCount));
    if (!sample) return std::nullopt;
    // Undo the flip of wo's cosine for transmission, so that an invisible boundary bends no ray.
    const bool isUndone = out.isMirrored && sample->IsTransmission();
    sample->wi = frame_.ToWorld(isUndone ? MirrorZ(sample->wi) : sample->wi);
    if (!Intersects(sample->lobe, ScatteringSides(out.side, Dot(sample->wi, ng_))))
      return std::nullopt;
    const Real share = Real(lobes.specularCount) / Real(count);
    sample->pdf *= share;
    sample->throughput /= share;
    if (!(sample->pdf > 0) || !sample->throughput.IsFinite()) return std::nullopt;
    return sample;
  }

  // A photon from a direction on different sides of the two normals is not scattered, as in f(wi,
  // wo).
  if (mode == TransportMode::Importance && out.isMirrored) return std::nullopt;
  const std::size_t picked =
      std::min(std::size_t(position) - lobes.specularCount, lobes.smoothCount - 1);
  const Bxdf& lobe = *lobes.smooth[picked];
  const auto local = lobe.Sample(out.wo, u);
  if (!local) return std::nullopt;
  BsdfSample sample{frame_.ToWorld(local->wi), local->throughput, local->pdf, lobe.Lobe()};
  Drawn drawn{out.wo, local->wi, local->wi};
  const bool isTurned = !Intersects(sample.lobe, ScatteringSides(out.side, Dot(sample.wi, ng_)));
  if (isTurned) {
    if (mode == TransportMode::Radiance) return std::nullopt;
    sample.wi = -sample.wi;
    drawn.seen = {-local->wi.x, -local->wi.y, local->wi.z};
  }
  const LobeSet served = ScatteringSides(out.side, Dot(sample.wi, ng_));
  if (!Intersects(sample.lobe, served)) return std::nullopt;
  if (count > 1 || isTurned) CombineSmooth(lobes, picked, served, drawn, &sample);
  if (!(sample.pdf > 0) || !sample.throughput.IsFinite()) return std::nullopt;
  return sample;
}

Spectrum Bsdf::Rho(LobeSet mask) const {
  Spectrum sum;
  for (int i = 0; i < count_; ++i) {
    const Bxdf& lobe = *lobes_[std::size_t(i)];
    if (lobe.Matches(mask)) sum += lobe.Rho();
  }
  return sum;
}

}  // namespace exphoton
