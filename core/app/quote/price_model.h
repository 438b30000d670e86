// SPDX-License-Identifier: BSD-2-Clause
// PriceModel predicts what an accuracy costs with one integrator, from small renders of the scene
// (pilots). With n samples a pixel in g groups of passes, and k times the photons in each group,
//   error^2 = camera g^(slope - 1) / n^slope + photonNoise / (g k) + (bias / k)^2,
//   seconds = fixed + g k maps + n sample.
// Errors are roots of relMSE. The area of density estimates falls with the number of photons, and
// bias is proportional to this area. Samples of one group converge faster than independent groups
// if the slope exceeds 1.
#pragma once

#include <optional>
#include <vector>

namespace exphoton::cli {

// Pilot is one render in two halves.
struct Pilot {
  double samples = 0;         // a pixel, in both halves
  double noise = 0;           // estimated noise part of relMSE of their mean
  double error = 0;           // its standard error
  bool hasOwnPhotons = true;  // each half has photons of its own; false: both have the same ones
};

struct PriceModel {
  double camera = 0, slope = 1;            // noise of camera samples in one group
  double samples = 1, relativeError = 0;   // of the last pilot, and of its noise
  double photonNoise = 0;                  // of one set of maps
  double bias = 0, biasUpper = 0;          // relative; the upper end of the interval
  double fixed = 0, maps = 0, sample = 0;  // CPU seconds
  bool hasPhotons = false;

  // Fits the noise to the pilots, in ascending order of samples. Those whose halves have the same
  // photons show the noise of camera samples, and the others show the noise of photons as well.
  void FitNoise(const std::vector<Pilot>& pilots);

 private:
  void FitCamera(const std::vector<Pilot>& pilots);
  void FitPhotonNoise(const std::vector<Pilot>& pilots);
  void TakePhotonNoise(const Pilot& pilot);
};

// Price is a setting that reaches an accuracy, with 90 % intervals by experience.
struct Price {
  double samples = 1;  // a pixel
  double photons = 1;  // factor
  double seconds = 0, least = 0, most = 0;
};
struct Order {
  double error = 0;  // > 0
  int groups = 1;
};
// Returns nullopt if no number of photons up to 64 times the scene's is enough.
std::optional<Price> PriceOf(const PriceModel& model, const Order& order);

}  // namespace exphoton::cli
