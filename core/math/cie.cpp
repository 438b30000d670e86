// SPDX-License-Identifier: BSD-2-Clause
// The conversions use the CIE 1931 observer in the analytic fit of Wyman, Sloan and Shirley 2013,
// "Simple Analytic Approximations to the CIE XYZ Color Matching Functions" (JCGT 2:2), table 1.
#include "core/math/cie.h"

#include <algorithm>
#include <cmath>

namespace exphoton {
namespace {

constexpr int kFirstNm = 360, kLastNm = 830;

struct Xyz {
  double x = 0, y = 0, z = 0;
};

// Evaluates a Gaussian whose width differs below and above its peak.
double Lobe(double nm, double peak, double below, double above) {
  const double t = (nm - peak) / (nm < peak ? below : above);
  return std::exp(-.5 * t * t);
}

Xyz Observer(double nm) {
  return {1.056 * Lobe(nm, 599.8, 37.9, 31.0) + .362 * Lobe(nm, 442.0, 16.0, 26.7) -
              .065 * Lobe(nm, 501.1, 20.4, 26.2),
          .821 * Lobe(nm, 568.8, 46.9, 40.5) + .286 * Lobe(nm, 530.9, 16.3, 31.1),
          1.217 * Lobe(nm, 437.0, 11.8, 36.0) + .681 * Lobe(nm, 459.0, 26.0, 13.8)};
}

// Integrates a spectrum over the visible range in steps of 1 nm.
template <class F>
Spectrum RgbOf(F&& valueAt) {
  Xyz sum;
  double luminance = 0;
  for (int nm = kFirstNm; nm <= kLastNm; ++nm) {
    const Xyz observer = Observer(nm);
    const double value = valueAt(double(nm));
    sum.x += value * observer.x;
    sum.y += value * observer.y;
    sum.z += value * observer.z;
    luminance += observer.y;
  }
  return RgbFromXyz(sum.x / luminance, sum.y / luminance, sum.z / luminance);
}

}  // namespace

Spectrum RgbFromXyz(double x, double y, double z) {
  return {Real(3.240479 * x - 1.537150 * y - .498535 * z),
          Real(-.969256 * x + 1.875991 * y + .041556 * z),
          Real(.055648 * x - .204043 * y + 1.057311 * z)};
}

Spectrum RgbFromSamples(const std::vector<SpectralSample>& samples) {
  if (samples.empty()) return {};
  return RgbOf([&](double nm) {
    const auto above = std::lower_bound(
        samples.begin(), samples.end(), nm,
        [](const SpectralSample& sample, double at) { return sample.wavelength < at; });
    if (above == samples.begin()) return samples.front().value;
    if (above == samples.end()) return samples.back().value;
    const SpectralSample &a = above[-1], &b = *above;  // a.wavelength < nm <= b.wavelength
    const double t = (nm - a.wavelength) / (b.wavelength - a.wavelength);
    return (1 - t) * a.value + t * b.value;
  });
}

Spectrum RgbOfBlackbody(double kelvin) {
  // kSecondRadiation is hc/k in nm K. kPeak is x = hc/(lambda k T) at the peak of Planck's law, the
  // root of x = 5 (1 - exp(-x)).
  constexpr double kSecondRadiation = 1.438776877e7, kPeak = 4.965114231744276;
  const double peakNm = kSecondRadiation / (kPeak * kelvin);
  return RgbOf([&](double nm) {
    const double x = kSecondRadiation / (nm * kelvin);
    if (x > 700) return 0.;  // exp(x) overflows
    return std::pow(peakNm / nm, 5) * (std::expm1(kPeak) / std::expm1(x));
  });
}

}  // namespace exphoton
