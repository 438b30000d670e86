// SPDX-License-Identifier: BSD-2-Clause
// MeasuredBrdf weights rings of half vectors by the mean of the table, and integrates the table.
#include "materials/measured/measured_brdf.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/math/sampling/sampling.h"
#include "materials/measured/half_angle_table.h"
#include "materials/measured/scattered_samples.h"

namespace exphoton {
namespace {

constexpr double kHalfPi = 1.57079632679489661923;
constexpr int kRings = 64;

// The rings are narrow near the normal, where highlights are.
double RingAngle(double ring) { return ring * ring / (double(kRings) * kRings) * kHalfPi; }

// Returns the mean of the BRDF over pairs of directions with this angle of the half vector.
double MeanOfRing(const MeasuredValues& values, double angle) {
  constexpr std::array<double, 4> kDifferences{.09, .44, .79, 1.13};
  constexpr int kAzimuths = 4;
  const Vector3 h(Real(std::sin(angle)), 0, Real(std::cos(angle)));
  const Vector3 x(h.z, 0, -h.x), y(0, 1, 0);
  double sum = 0;
  int count = 0;
  for (const double difference : kDifferences) {
    for (int i = 0; i < kAzimuths; ++i) {
      const double azimuth = (i + .5) * 2 * kHalfPi / kAzimuths;
      const Vector3 d =
          SphericalDirection(Real(std::sin(difference)), Real(std::cos(difference)), Real(azimuth));
      const Vector3 wi = x * d.x + y * d.y + h * d.z, wo = h * (2 * d.z) - wi;
      if (!(wi.z > 0 && wo.z > 0)) continue;
      const Spectrum f = values.f(wo, wi);
      sum += double(f.r + f.g + f.b);
      ++count;
    }
  }
  return count > 0 ? sum / count : 0;
}

}  // namespace

std::unique_ptr<const MeasuredValues> ReadMeasuredValues(const std::string& path) {
  if (path.ends_with(".brdf")) return std::make_unique<ScatteredSamples>(path);
  return std::make_unique<HalfAngleTable>(path);
}

MeasuredBrdf::MeasuredBrdf(std::unique_ptr<const MeasuredValues> values)
    : values_(std::move(values)) {
  std::vector<double> weights;
  for (int i = 0; i <= kRings; ++i) {
    const double sine = std::sin(RingAngle(i));
    sin2_.push_back(sine * sine);
  }
  for (int i = 0; i < kRings; ++i)
    weights.push_back(MeanOfRing(*values_, RingAngle(i + .5)) *
                      (sin2_[std::size_t(i + 1)] - sin2_[std::size_t(i)]));
  rings_ = DiscreteDistribution(weights);
  rho_ = MeanAlbedo();
}

// The table is isotropic, so the albedo depends on the cosine of wo alone. The cosines are the
// midpoints of equal shares of the projected hemisphere.
Spectrum MeasuredBrdf::MeanAlbedo() const {
  constexpr int kCosines = 16, kColumns = 32, kRows = 16;
  Spectrum sum;
  for (int i = 0; i < kCosines; ++i) {
    const Real cosine = std::sqrt((Real(i) + Real(.5)) / kCosines);
    const Vector3 wo(SafeSqrt(1 - cosine * cosine), 0, cosine);
    for (int j = 0; j < kColumns * kRows; ++j) {
      const Vector3 wi = Sample(wo, {(Real(j % kColumns) + Real(.5)) / kColumns,
                                     (Real(j / kColumns) + Real(.5)) / kRows});
      const Real pdf = wi.z > 0 ? Pdf(wo, wi) : 0;
      if (pdf > 0) sum += f(wo, wi) * (wi.z / pdf);
    }
  }
  return sum / Real(kCosines * kColumns * kRows);
}

Real MeasuredBrdf::HalfVectorPdf(const Vector3& h) const {
  const double sin2 = double(h.x) * double(h.x) + double(h.y) * double(h.y);
  const auto edge = std::upper_bound(sin2_.begin() + 1, sin2_.end() - 1, sin2);
  const auto ring = std::size_t(edge - sin2_.begin()) - 1;
  const double area = 3.14159265358979323846 * (sin2_[ring + 1] - sin2_[ring]);
  return Real(double(rings_.Probability(int(ring))) * double(h.z) / area);
}

Real MeasuredBrdf::Pdf(const Vector3& wo, const Vector3& wi) const {
  const Real cosine = CosineHemispherePdf(wi.z);
  if (rings_.IsEmpty()) return cosine;
  const Vector3 sum = wo + wi;
  const Real length = Length(sum);
  if (!(length > std::sqrt(std::numeric_limits<Real>::min()))) return cosine / 2;
  // The cosine between wo and the half vector is length / 2.
  return (cosine + HalfVectorPdf(sum / length) / (2 * length)) / 2;
}

Vector3 MeasuredBrdf::Sample(const Vector3& wo, Point2 u) const {
  if (rings_.IsEmpty()) return SampleCosineHemisphere(u);
  if (u.x < Real(.5)) return SampleCosineHemisphere({2 * u.x, u.y});
  const DiscreteDistribution::Choice choice = rings_.Sample(2 * u.x - 1);
  const auto ring = std::size_t(choice.index);
  const double sin2 = sin2_[ring] + double(choice.remapped) * (sin2_[ring + 1] - sin2_[ring]);
  const double cosine = std::sqrt(std::max(1 - sin2, 0.));
  const Vector3 h = SphericalDirection(Real(std::sqrt(sin2)), Real(cosine), 2 * kPi * u.y);
  return h * (2 * Dot(wo, h)) - wo;
}

}  // namespace exphoton
