// SPDX-License-Identifier: BSD-2-Clause
// Bsdf combines lobes under a mask. The geometric normal alone separates reflection from
// transmission. A direction on different sides of the shading normal and the geometric normal is
// handled before any lobe sees it (Veach 1997, section 5.3): diffuse lobes scatter its light by the
// absolute cosine, which neither gains nor loses energy, and glossy lobes scatter none. Mirrors
// reflect it about the geometric normal (docs/decisions/0029-light-between-normals.md).
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

// LocalDirection is a direction in the local frame, on the side of the geometric normal. If the two
// normals disagree, the sign of its cosine is flipped, so that the point is seen under a grazing
// view instead of being black.
struct LocalDirection {
  Vector3 w;
  Real side = 0;  // w . ng
  bool isMirrored = false;
};

LocalDirection ToLocal(const Frame& frame, const Normal3& ng, const Vector3& w) {
  LocalDirection local{frame.ToLocal(w), Dot(w, ng), false};
  local.isMirrored = (local.w.z < 0) != (local.side < 0);
  if (local.isMirrored) local.w.z = -local.w.z;
  return local;
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
// differ for a direction between the normals: the sampled direction was behind the geometric normal
// and was reversed, and lobes see the reversed direction mirrored in z. The hemisphere of the
// geometric normal is thus covered once, with the density |wi.ns| of the sampled direction. `wo` is
// the outgoing direction.
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
  if (lobe->Matches(LobeSet::Diffuse)) isLambertian_ = isLambertian_ && lobe->IsLambertian();
  isCoated_ = isCoated_ || lobe->IsCoated();
}

int Bsdf::Count(LobeSet mask) const {
  int count = 0;
  for (int i = 0; i < count_; ++i) count += lobes_[std::size_t(i)]->Matches(mask);
  return count;
}

// Calls visit(lobe, drawn) for each masked smooth lobe that scatters between these sides.
template <class Visit>
void Bsdf::VisitMatching(const Vector3& wo, const Vector3& wi, LobeSet mask,
                         const Visit& visit) const {
  const LocalDirection out = ToLocal(frame_, ng_, wo), in = ToLocal(frame_, ng_, wi);
  LobeSet served = mask & ScatteringSides(out.side, in.side) & LobeSet::NonSpecular;
  if (in.isMirrored) served = served & LobeSet::Diffuse;
  if (!Has(served)) return;
  // Between the normals, Sample makes a direction by reversing the opposite one.
  const Drawn drawn{out.w, in.isMirrored ? Vector3(-in.w.x, -in.w.y, in.w.z) : in.w, in.w};
  for (int i = 0; i < count_; ++i) {
    const Bxdf& lobe = *lobes_[std::size_t(i)];
    if (lobe.Matches(served)) visit(lobe, drawn);
  }
}

Spectrum Bsdf::f(const Vector3& wo, const Vector3& wi, LobeSet mask) const {
  Spectrum sum;
  VisitMatching(wo, wi, mask,
                [&](const Bxdf& lobe, const Drawn& d) { sum += lobe.f(d.wo, d.seen); });
  return sum;
}

Real Bsdf::Pdf(const Vector3& wo, const Vector3& wi, LobeSet mask) const {
  Real sum = 0;
  VisitMatching(wo, wi, mask,
                [&](const Bxdf& lobe, const Drawn& d) { sum += lobe.Pdf(d.wo, d.drawn); });
  return sum == 0 ? 0 : sum / Real(Count(mask));
}

BsdfValue Bsdf::Evaluate(const Vector3& wo, const Vector3& wi, LobeSet mask) const {
  BsdfValue value;
  VisitMatching(wo, wi, mask, [&](const Bxdf& lobe, const Drawn& d) {
    value.f += lobe.f(d.wo, d.seen);
    value.pdf += lobe.Pdf(d.wo, d.drawn);
  });
  if (value.pdf != 0) value.pdf /= Real(Count(mask));
  return value;
}

std::optional<BsdfSample> Bsdf::Sample(const Vector3& wo, Point2 u, Real uLobe, LobeSet mask,
                                       TransportMode mode) const {
  const MatchingLobes lobes(std::span(lobes_.data(), std::size_t(count_)), mask);
  const int count = int(lobes.specularCount + lobes.smoothCount);
  if (count == 0) return std::nullopt;
  const LocalDirection out = ToLocal(frame_, ng_, wo);
  if (out.side == 0 || out.w.z == 0) return std::nullopt;

  const Real position = uLobe * Real(count);
  if (position < Real(lobes.specularCount)) {
    auto sample = SampleSpecular(lobes.Specular(), out.w, position / Real(lobes.specularCount));
    if (!sample) return std::nullopt;
    // Undo the flip of wo's cosine for transmission, so that an invisible boundary bends no ray.
    // The shading normal would reflect to the back, so the geometric normal takes its place.
    if (out.isMirrored && !sample->IsTransmission()) {
      sample->wi = ng_ * (2 * out.side) - wo;
    } else {
      sample->wi = frame_.ToWorld(out.isMirrored ? MirrorZ(sample->wi) : sample->wi);
    }
    if (!Intersects(sample->lobe, ScatteringSides(out.side, Dot(sample->wi, ng_))))
      return std::nullopt;
    const Real share = Real(lobes.specularCount) / Real(count);
    sample->pdf *= share;
    sample->throughput /= share;
    if (!(sample->pdf > 0) || !sample->throughput.IsFinite()) return std::nullopt;
    return sample;
  }

  const std::size_t picked =
      std::min(std::size_t(position) - lobes.specularCount, lobes.smoothCount - 1);
  const Bxdf& lobe = *lobes.smooth[picked];
  const auto local = lobe.Sample(out.w, u);
  if (!local) return std::nullopt;
  BsdfSample sample{frame_.ToWorld(local->wi), local->throughput, local->pdf, lobe.Lobe()};
  Drawn drawn{out.w, local->wi, local->wi};
  const bool isTurned = !Intersects(sample.lobe, ScatteringSides(out.side, Dot(sample.wi, ng_)));
  if (isTurned) {
    sample.wi = -sample.wi;
    drawn.seen = {-local->wi.x, -local->wi.y, local->wi.z};
  }
  // Only diffuse lobes scatter light that arrives between the normals, as in f.
  const bool arrivesBetween = mode == TransportMode::Radiance ? isTurned : out.isMirrored;
  const LobeSet served = ScatteringSides(out.side, Dot(sample.wi, ng_)) &
                         (arrivesBetween ? LobeSet::Diffuse : LobeSet::All);
  if (!Intersects(sample.lobe, served)) return std::nullopt;
  if (count > 1 || isTurned) CombineSmooth(lobes, picked, served, drawn, &sample);
  if (!(sample.pdf > 0) || !sample.throughput.IsFinite()) return std::nullopt;
  return sample;
}

// Smooth lobes: with f_l cos <= bound_l pdf_l, the sum of f_l cos over the mean of pdf_l over all
// `count` lobes is at most count times the largest bound_l. Specular lobes: see SampleSpecular.
std::optional<Spectrum> Bsdf::ThroughputBound(const Vector3& wo, LobeSet mask) const {
  const MatchingLobes lobes(std::span(lobes_.data(), std::size_t(count_)), mask);
  const Real count = Real(lobes.specularCount + lobes.smoothCount);
  const Vector3 local = ToLocal(frame_, ng_, wo).w;
  Spectrum bound;
  const auto include = [&bound](const Spectrum& value) {
    for (int c = 0; c < Spectrum::kChannels; ++c) bound[c] = std::max(bound[c], value[c]);
  };
  Real total = 0;
  for (std::size_t i = 0; i < lobes.smoothCount; ++i) {
    const auto smooth = lobes.smooth[i]->ThroughputBound(local);
    if (!smooth) return std::nullopt;
    include(*smooth * count);
  }
  for (const Bxdf* lobe : lobes.Specular())
    if (const auto coefficient = lobe->ThroughputBound(local)) total += coefficient->MaxComponent();
  for (const Bxdf* lobe : lobes.Specular()) {
    const auto coefficient = lobe->ThroughputBound(local);
    if (!coefficient) return std::nullopt;
    const Real largest = coefficient->MaxComponent();
    if (largest > 0) include(*coefficient * (total / largest * count / Real(lobes.specularCount)));
  }
  return bound;
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
