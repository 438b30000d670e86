// SPDX-License-Identifier: BSD-2-Clause
// PriceModel predicts what an accuracy costs with one integrator, from small renders of the scene
// (pilots). With n samples a pixel and k times the photons,
//   error^2 = camera / n^slope + photons / k + (bias / k)^2,
//   seconds = fixed + k maps + n sample.
// Errors are roots of relMSE. The area of density estimates falls with the number of photons, and
// bias is proportional to this area.
#pragma once

#include <optional>
#include <vector>

namespace exphoton::cli {

// Pilot is one render in two halves with photons of their own.
struct Pilot {
  double samples = 0;  // a pixel, in both halves
  double noise = 0;    // estimated noise part of relMSE of their mean
};

struct PriceModel {
  double camera = 0, slope = 1;            // noise of camera samples
  double photonNoise = 0;                  // of one set of maps
  double bias = 0, biasUpper = 0;          // relative; the upper end of the interval
  double fixed = 0, maps = 0, sample = 0;  // CPU seconds
  bool hasPhotons = false;

  // Fits the noise to the pilots, in ascending order of samples.
  void FitNoise(const std::vector<Pilot>& pilots);

 private:
  bool FitPhotonNoise(const std::vector<Pilot>& pilots);
};

// Price is a setting that reaches an accuracy, with 90 % intervals by experience.
struct Price {
  double samples = 1;  // a pixel
  double photons = 1;  // factor
  double seconds = 0, least = 0, most = 0;
};
// error: > 0. Returns nullopt if no number of photons up to 64 times the scene's is enough.
std::optional<Price> PriceOf(const PriceModel& model, double error);

}  // namespace exphoton::cli
