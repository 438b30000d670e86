// SPDX-License-Identifier: BSD-2-Clause
#include "core/app/quote/price_model.h"

#include <algorithm>
#include <cmath>

namespace exphoton::cli {
namespace {

constexpr double kMostPhotons = 64;
constexpr double kMargin = 1.35;  // of the seconds: clocks, and small parts of the scene

// The cheapest setting for one squared error. `bias` is the model's or its upper end.
std::optional<Price> Cheapest(const PriceModel& model, double squaredError, double bias) {
  std::optional<Price> best;
  for (double k = 1; k <= (model.hasPhotons ? kMostPhotons : 1); k *= 2) {
    const double left = squaredError - model.photonNoise / k - bias * bias / (k * k);
    if (!(left > 0)) continue;
    Price price;
    price.samples = std::max(1., std::ceil(std::pow(model.camera / left, 1 / model.slope)));
    price.photons = k;
    price.seconds = model.fixed + k * model.maps + price.samples * model.sample;
    if (!best || price.seconds < best->seconds) best = price;
  }
  return best;
}

}  // namespace

// Noise of camera samples falls as 1/n, and as the halves of a pilot have photons of their own, it
// contains half the noise of one set of maps: noise = camera / n + photonNoise / 2. Relative
// differences are fitted by least squares. Noise of photons that is not significant counts as 0.
// With photonNoise 0, sequences of samples may converge faster.
void PriceModel::FitNoise(const std::vector<Pilot>& pilots) {
  const Pilot& last = pilots.back();
  slope = 1;
  photonNoise = 0;
  camera = last.noise * last.samples;
  if (pilots.size() < 2 || !(last.noise > 0)) return;
  if (hasPhotons && FitPhotonNoise(pilots)) return;
  const Pilot& first = pilots.front();
  const double octaves = std::log(last.samples / first.samples);
  slope = std::clamp(std::log(first.noise / last.noise) / octaves, 1., 1.25);
  camera = last.noise * std::pow(last.samples, slope);
}

// Returns false if the noise of photons is not significant.
bool PriceModel::FitPhotonNoise(const std::vector<Pilot>& pilots) {
  if (pilots.size() < 3) return false;
  // Minimises the sum of (a x + b y - 1)^2 over pilots, with x = 1 / (n noise) and y = 1 / noise.
  double xx = 0, xy = 0, yy = 0, x1 = 0, y1 = 0;
  for (const Pilot& pilot : pilots) {
    if (!(pilot.noise > 0)) return false;
    const double x = 1 / (pilot.samples * pilot.noise), y = 1 / pilot.noise;
    xx += x * x, xy += x * y, yy += y * y, x1 += x, y1 += y;
  }
  const double determinant = xx * yy - xy * xy;
  if (!(determinant > 0)) return false;
  const double a = (x1 * yy - y1 * xy) / determinant, b = (y1 * xx - x1 * xy) / determinant;
  double residual = 0;
  for (const Pilot& pilot : pilots) {
    const double fitted = (a / pilot.samples + b) / pilot.noise;
    residual += (fitted - 1) * (fitted - 1);
  }
  const double variance = residual / double(pilots.size() - 2) * xx / determinant;
  constexpr double kStandardErrors = 2;
  if (!(a > 0) || !(b > kStandardErrors * std::sqrt(variance))) return false;
  camera = a;
  photonNoise = 2 * b;
  return true;
}

std::optional<Price> PriceOf(const PriceModel& model, double error) {
  const double squared = error * error;
  std::optional<Price> price = Cheapest(model, squared, model.bias);
  if (!price) return price;
  PriceModel plain = model;  // as if noise fell as 1/n and photons were free of noise
  plain.photonNoise = 0;
  const auto least = Cheapest(plain, squared, 0);
  const auto most = Cheapest(model, squared, model.biasUpper);
  price->least = std::min(least ? least->seconds : price->seconds, price->seconds) / kMargin;
  price->most = (most ? std::max(most->seconds, price->seconds) : INFINITY) * kMargin;
  return price;
}

}  // namespace exphoton::cli
