// SPDX-License-Identifier: BSD-2-Clause
// PhotonRejection keeps the luminance of every photon exactly constant (photonroulette "constant").
// A step of a path, emission or scattering, states a bound on the power of one sample. The step
// draws n independent samples, n >= bound / unit, and accepts each with probability power / (n
// unit). An accepted sample carries one unit of luminance, so the mean power is kept. Source: von
// Neumann 1951, "Various Techniques Used in Connection with Random Digits" (rejection sampling).
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/lights/selection/fixed_light_sampler.h"

namespace exphoton {

// PhotonSources describes how photon paths begin.
struct PhotonSources {
  std::span<const std::unique_ptr<Light>> lights;
  const FixedLightSampler& choice;
  double mediaShare = 0;  // share of the paths that begin in a medium
  double mediaPower = 0;  // luminance of the power that media emit
};

class PhotonRejection {
 public:
  PhotonRejection() = default;  // not in use
  explicit PhotonRejection(const PhotonSources& sources);

  bool IsInUse() const { return isInUse_; }
  // Returns the luminance of a photon: the largest quotient of a source's power and the probability
  // of its choice.
  Real Unit() const { return unit_; }
  // Returns the number of samples that a path draws from the light that it begins at.
  int CopiesOfLight(int light) const { return lightCopies_[std::size_t(light)]; }
  // Returns the number of samples to draw if no sample has a luminance above `bound`; at most 64.
  int Copies(Real bound) const;

  struct Accepted {
    Spectrum power;
    bool isBeyondBound;  // the luminance is above one unit, because n was too small
  };
  // Accepts or rejects one of `copies` samples of this power. u is uniform in [0,1).
  std::optional<Accepted> Accept(const Spectrum& power, int copies, Real u) const;

 private:
  bool isInUse_ = false;
  Real unit_ = 0;  // 0: the power of no source is known, and photons keep their weights
  std::vector<int> lightCopies_;
};

}  // namespace exphoton
