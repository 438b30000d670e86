// SPDX-License-Identifier: BSD-2-Clause
// PriceModel predicts what an accuracy costs with one integrator, from small renders of the scene
// (pilots). With n samples a pixel in g groups of passes, and m sets of maps with k times the
// photons,
//   error^2 = noise(n / g) / g + photonNoise / (m k) + bias(k)^2 + sharing(n / g),
//   seconds = fixed + m MapsFor(k) + n sample.
// m is 1 where the groups should keep their photons (core/render/passes/photons/photon_sets.h),
// otherwise g. Errors are roots of relMSE. noise(m) is the noise of the camera samples of one
// group: pilots show it, and it falls as m^-slope beyond them. bias(k) is the larger one of
// bias / k, which pilots show in blocks of pixels, and guessedBias / sqrt(k), a guess for single
// pixels: the area of density estimates falls with the number of photons, the bias of large regions
// is proportional to the area, and the bias at edges to the radius
// (docs/decisions/0112-guess-of-the-bias-of-photons.md). sharing(m) is the squared bias of shared
// gathers, which share within a group.
#pragma once

#include <optional>
#include <vector>

namespace exphoton {
class Sampler;
}

namespace exphoton::cli {

// Pilot is one render in two halves with the same photons.
struct Pilot {
  double samples = 0;      // a pixel, in both halves
  double noise = 0;        // of relMSE, what their difference shows
  double error = 0;        // its standard error
  double photonNoise = 0;  // noise part of relMSE that one set of the scene's photons causes
};

// MapPrices are the prices of the maps of one group.
struct MapPrices {
  double all = 0;
  // Parts of it. Fewer photons leave the caustic map as it is. The number of direct photons may be
  // given, so that they never change; 0: it is not given.
  double caustic = 0, direct = 0;
};

struct PriceModel {
  struct Point {                    // the noise of one group
    double samples = 0, noise = 0;  // the former: of the group, a pixel
  };
  std::vector<Point> points;       // ascending samples; noise falls
  double camera = 0, slope = 1;    // beyond the points, noise is camera / samples^slope
  double slopeError = 0;           // standard error
  double relativeError = 0;        // of the noise of the last pilot
  double photonNoise = 0;          // of one set of maps
  struct Sharing {                 // of one group
    double samples = 0, bias = 0;  // the latter: squared; 0: none is shared
    double error = 0;              // the standard error of the bias
  } sharing;
  double bias = 0, biasUpper = 0;          // relative; the upper end of the interval
  double guessedBias = 0;                  // of the scene's photons, in single pixels
  double mostForGuess = 4;                 // the largest k for the sake of the guess, >= 1
  double leastPhotons = 1;                 // the smallest k
  double fixed = 0, maps = 0, sample = 0;  // CPU seconds
  double keptMaps = 0;                     // the part of `maps` that does not fall where k < 1
  bool hasPhotons = false;                 // k may differ from 1
  double owned = 0;  // the k of maps that exist already, so that one set costs nothing; 0: none

  // Fits the noise to the pilots, in ascending order of samples. The last one knows the noise of
  // the photons best.
  void FitNoise(const std::vector<Pilot>& pilots);
  // Takes the prices of maps with k times the photons.
  void FitMaps(const MapPrices& prices, double k);
  // Returns what the maps of one group cost with k times the photons.
  double MapsFor(double k) const;
  // Returns the samples of one group with this noise.
  double SamplesFor(double noise) const;
  // Returns the squared bias of sharing in a group with this number of samples.
  double SharingBiasOf(double samples) const;
  // Returns the same model with other noise, which falls with another slope beyond the points.
  PriceModel WithNoise(double factor, double otherSlope) const;

 private:
  void FitCamera(const std::vector<Pilot>& pilots);
  void FitSlope(const Pilot& first, const Pilot& last);
};

// Price is a setting that reaches an accuracy, with 90 % intervals by experience.
struct Price {
  double samples = 1;  // a pixel
  double photons = 1;  // factor
  int sets = 1;        // of maps
  double seconds = 0, least = 0, most = 0;
};
struct Order {
  double error = 0;  // > 0
  int groups = 1;
  // Whether the render stops to share gathers where their bias leaves little for the noise
  // (docs/decisions/0093-stop-sharing-for-an-accuracy.md).
  bool mayStopSharing = false;
  // Rounds the samples of a render to a number that its sampler takes. Null: it takes any number.
  const Sampler* sampler = nullptr;
};
// Returns nullopt if no number of photons up to 64 times the scene's is enough.
std::optional<Price> PriceOf(const PriceModel& model, const Order& order);

}  // namespace exphoton::cli
