// SPDX-License-Identifier: BSD-2-Clause
// PhotonRejection chooses the unit and decides on candidates.
#include "integrators/photon/shooting/photon_rejection.h"

#include <algorithm>
#include <cmath>

namespace exphoton {
namespace {

constexpr int kMaxCopies = 64;
// Weights this close to 1 count as 1, because bounds and powers are rounded differently.
constexpr double kRounding = 1 + 1. / (1 << 18);

// Returns x if it is finite and positive, else 0.
double Usable(double x) { return x > 0 && std::isfinite(x) ? x : 0; }

// Returns a power of the same colour whose luminance is `target`. Scaling rounds each channel, and
// Y rounds again, so the channel that brings most is corrected at the end.
Spectrum WithLuminance(const Spectrum& power, double target) {
  const Real shares[] = {Spectrum(1, 0, 0).Y(), Spectrum(0, 1, 0).Y(), Spectrum(0, 0, 1).Y()};
  Spectrum scaled = power * Real(target / double(power.Y()));
  int most = 0;
  for (int c = 1; c < Spectrum::kChannels; ++c)
    if (scaled[c] * shares[c] > scaled[most] * shares[most]) most = c;
  scaled[most] += Real((target - double(scaled.Y())) / double(shares[most]));
  return scaled;
}

}  // namespace

PhotonRejection::PhotonRejection(const PhotonSources& sources) : isInUse_(true) {
  const double lightShare = 1 - sources.mediaShare;
  std::vector<double> bounds;  // over the probability of the choice
  double unit = sources.mediaShare > 0 ? Usable(sources.mediaPower / sources.mediaShare) : 0;
  for (const auto& light : sources.lights) {
    const double probability = double(sources.choice.Pmf(*light)) * lightShare;
    const double power = UsablePower(*light);
    const double bound = Usable(double(light->EmissionBound().value_or(Real(power))));
    bounds.push_back(probability > 0 ? bound / probability : 0);
    if (probability > 0) unit = std::max(unit, Usable((power > 0 ? power : bound) / probability));
  }
  unit_ = Real(unit);
  for (const double bound : bounds) lightCopies_.push_back(Copies(Real(bound)));
}

int PhotonRejection::Copies(Real bound) const {
  const double copies = std::ceil(double(bound) / (double(unit_) * kRounding));
  return copies < kMaxCopies ? std::max(1, int(copies)) : kMaxCopies;  // also if it is not finite
}

std::optional<PhotonRejection::Accepted> PhotonRejection::Accept(const Spectrum& power, int copies,
                                                                 Real u) const {
  const double luminance = double(power.Y());
  if (!(luminance > 0)) return std::nullopt;
  if (!(unit_ > 0)) return Accepted{power / Real(copies), true};
  const double weight = luminance / (double(unit_) * copies);
  if (!(double(u) < weight)) return std::nullopt;
  const bool isBeyondBound = weight > kRounding;
  return Accepted{WithLuminance(power, double(unit_) * (isBeyondBound ? weight : 1)),
                  isBeyondBound};
}

}  // namespace exphoton
