// SPDX-License-Identifier: BSD-2-Clause
// PhotonNoise estimates how much noise one set of photons causes in a picture, from the signed
// light of several passes with these photons (LiContext::signedLight). Let S be the signed light of
// a pixel if it had all possible samples. The expected value of S^2 is the variance that photons
// cause. The passes have independent errors of S, so the product of the light of two passes has the
// expected value S^2. Derivation and measurements:
// docs/decisions/0090-noise-of-one-set-of-photons.md.
#pragma once

#include <cstdint>
#include <vector>

#include "core/imaging/image.h"
#include "core/math/spectrum.h"
#include "core/math/vec.h"

namespace exphoton {

class ByteArchive;

class PhotonNoise {
 public:
  explicit PhotonNoise(const PixelBounds& crop);

  // Adds a camera sample of the current pass. Pixels outside the crop window are ignored, and so is
  // light that is not finite. One thread at a time may add to a pixel.
  void Add(Point2i pixel, const Spectrum& signedLight, Real weight);
  void ClearPixel(Point2i pixel);  // removes what the current pass added
  void EndPass(std::int64_t samplesPerPixel);

  bool IsKnown() const { return passes_ > 1; }
  // Estimates the mean over pixels and channels of var / (r^2 + 0.01), where var is the variance of
  // the picture due to one set of photons. levels: r^2 of each pixel, three channels. The result is
  // at least 0, and infinite if the light is too bright for float. Must be known.
  double RelativeVariance(const std::vector<double>& levels) const;

  void Transfer(ByteArchive* archive);  // saves or loads

 private:
  std::size_t IndexOf(Point2i pixel) const {
    return std::size_t(pixel.y - crop_.y0) * std::size_t(crop_.Width()) +
           std::size_t(pixel.x - crop_.x0);
  }

  PixelBounds crop_;
  // Three channels per pixel: the sum of the light of all samples of the current pass, of all
  // complete passes, and the sum over these passes of the square of their sum.
  std::vector<float> current_, sums_, squares_;
  std::int64_t passes_ = 0;
  double samples_ = 0, squaredSamples_ = 0;  // sums over the complete passes
};

}  // namespace exphoton
