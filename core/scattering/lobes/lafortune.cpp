// SPDX-License-Identifier: BSD-2-Clause
// Lafortune evaluates and samples generalised cosine lobes.
#include "core/scattering/lobes/lafortune.h"

#include <algorithm>

#include "core/math/sampling/sampling.h"
#include "core/scattering/lobes/local_frame.h"

namespace exphoton {
namespace {

// Smaller sums of |q|^n / (n + 1) are no light worth a sample, and rounding would spoil ratios.
constexpr Real kLeastTotal = Real(1e-30);

Real PositivePower(Real x, Real exponent) { return x > 0 ? std::pow(x, exponent) : 0; }

// One lobe in one channel, seen from a direction wo above the surface.
struct CosinePower {
  Vector3 q;
  Real exponent;

  CosinePower(const LafortuneLobe& lobe, int channel, const Vector3& wo)
      : q(lobe.xy[channel] * wo.x, lobe.xy[channel] * wo.y,
          std::max(lobe.z[channel], Real(0)) * wo.z),
        exponent(lobe.exponent[channel]) {}

  // Returns the integral over the sphere, divided by 2 pi.
  Real Weight() const { return PositivePower(LengthSquared(q), exponent / 2) / (exponent + 1); }
  // Returns g(wi) + g(mirrored wi).
  Real Density(const Vector3& wi) const {
    const Real across = q.x * wi.x + q.y * wi.y, up = q.z * wi.z;
    return PositivePower(across + up, exponent) + PositivePower(across - up, exponent);
  }
};

template <class Visit>
void ForEach(std::span<const LafortuneLobe> lobes, const Vector3& wo, const Visit& visit) {
  for (const LafortuneLobe& lobe : lobes)
    for (int c = 0; c < Spectrum::kChannels; ++c) visit(CosinePower(lobe, c, wo));
}

Real TotalWeight(std::span<const LafortuneLobe> lobes, const Vector3& wo) {
  Real total = 0;
  ForEach(lobes, wo, [&](const CosinePower& power) { total += power.Weight(); });
  return total;
}

Vector3 Upwards(const Vector3& w) { return {w.x, w.y, std::abs(w.z)}; }

}  // namespace

// The lobes have one coefficient for x and y, so the albedo depends on the cosine of wo alone. The
// cosines are the midpoints of equal shares of the projected hemisphere.
LafortuneFit::LafortuneFit(std::initializer_list<LafortuneLobe> lobes) : lobes_(lobes) {
  constexpr int kCosines = 16, kSide = 16;
  const Lafortune lobe(lobes_, Spectrum());
  for (int i = 0; i < kCosines; ++i) {
    const Real cosine = std::sqrt((Real(i) + Real(.5)) / kCosines);
    const Vector3 wo(SafeSqrt(1 - cosine * cosine), 0, cosine);
    for (int j = 0; j < kSide * kSide; ++j) {
      const Point2 u((Real(j % kSide) + Real(.5)) / kSide, (Real(j / kSide) + Real(.5)) / kSide);
      if (const auto sample = lobe.Sample(wo, u)) rho_ += sample->throughput;
    }
  }
  rho_ /= Real(kCosines * kSide * kSide);
}

Spectrum Lafortune::f(const Vector3& wo, const Vector3& wi) const {
  if (!SameHemisphere(wo, wi)) return {};
  const Real across = wo.x * wi.x + wo.y * wi.y, up = wo.z * wi.z;
  Spectrum sum;
  for (const LafortuneLobe& lobe : lobes_)
    for (int c = 0; c < Spectrum::kChannels; ++c)
      sum[c] += PositivePower(lobe.xy[c] * across + lobe.z[c] * up, lobe.exponent[c]);
  return sum;
}

Real Lafortune::Pdf(const Vector3& wo, const Vector3& wi) const {
  if (!SameHemisphere(wo, wi)) return 0;
  const Vector3 up = Upwards(wo), to = Upwards(wi);
  Real total = 0, density = 0;
  ForEach(lobes_, up, [&](const CosinePower& power) {
    total += power.Weight();
    density += power.Density(to);
  });
  return total > kLeastTotal ? density / (2 * kPi * total) : 0;
}

std::optional<BxdfSample> Lafortune::Sample(const Vector3& wo, Point2 u) const {
  if (wo.z == 0) return std::nullopt;
  const Vector3 up = Upwards(wo);
  const Real total = TotalWeight(lobes_, up);
  if (!(total > kLeastTotal)) return std::nullopt;
  // Pick a lobe and a channel. `left` becomes the rest of u.x within the picked one.
  Real left = u.x * total;
  std::optional<CosinePower> picked;
  Real weight = 0;
  ForEach(lobes_, up, [&](const CosinePower& power) {
    if (picked && left < weight) return;
    const Real next = power.Weight();
    if (!(next > 0)) return;
    if (picked) left -= weight;
    picked = power;
    weight = next;
  });
  if (!picked) return std::nullopt;
  // Sample the cosine power about its axis, and mirror directions below the surface.
  const Real v = std::clamp(left / weight, Real(0), kOneMinusEpsilon);
  const PolarAngle angle = SampleCosinePower(v, picked->exponent + 1);
  const Vector3 local = SphericalDirection(angle.sine, angle.cosine, 2 * kPi * u.y);
  const Vector3 axis = NormalizeOr(picked->q, {0, 0, 1});
  const Vector3 wi = OnSideOf(Frame::FromZ(axis).ToWorld(local), wo);
  const Real pdf = Pdf(wo, wi);
  if (!(pdf > 0) || !std::isfinite(pdf)) return std::nullopt;
  const Spectrum weightOf = f(wo, wi) * (std::abs(wi.z) / pdf);
  if (!weightOf.IsFinite()) return std::nullopt;
  return BxdfSample{wi, weightOf, pdf};
}

// Each channel of f is at most the sum of all cosine powers, which is 2 pi TotalWeight times the
// density. The cosine of wi is at most 1.
std::optional<Spectrum> Lafortune::ThroughputBound(const Vector3& wo) const {
  return Spectrum(2 * kPi * TotalWeight(lobes_, Upwards(wo)));
}

}  // namespace exphoton
