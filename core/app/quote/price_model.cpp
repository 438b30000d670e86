// SPDX-License-Identifier: BSD-2-Clause
#include "core/app/quote/price_model.h"

#include <algorithm>
#include <cmath>

namespace exphoton::cli {
namespace {

constexpr double kMostPhotons = 64;
constexpr double kMargin = 1.35;  // of the seconds: clocks, and small parts of the scene

// Sequences of n samples have errors of order n^-1.5 at edges, and n^-1 or more elsewhere.
constexpr double kMostSlope = 1.5;
constexpr double kStandardErrors = 2;  // at which noise of photons is significant
constexpr double kQuantile90 = 1.645;  // of a two-sided interval of 90 %

// The cheapest setting.
std::optional<Price> Cheapest(const PriceModel& model, const Order& order) {
  std::optional<Price> best;
  const double squared = order.error * order.error, groups = order.groups;
  for (double k = 1; k <= (model.hasPhotons ? kMostPhotons : 1); k *= 2) {
    const double bias = model.bias / k;
    const double left = squared - model.photonNoise / (groups * k) - bias * bias;
    if (!(left > 0)) continue;
    const double camera = model.camera * std::pow(groups, model.slope - 1);
    Price price;
    price.samples = std::max(groups, std::ceil(std::pow(camera / left, 1 / model.slope)));
    price.photons = k;
    price.seconds = model.fixed + groups * k * model.maps + price.samples * model.sample;
    if (!best || price.seconds < best->seconds) best = price;
  }
  return best;
}

}  // namespace

void PriceModel::FitNoise(const std::vector<Pilot>& pilots) {
  std::vector<Pilot> same, own;
  for (const Pilot& pilot : pilots) (pilot.hasOwnPhotons ? own : same).push_back(pilot);
  photonNoise = 0;
  FitCamera(same.empty() ? own : same);
  if (same.empty() && hasPhotons) FitPhotonNoise(own);
  if (!same.empty() && !own.empty()) TakePhotonNoise(own.back());
}

// Noise of camera samples falls as 1/n, and sequences of samples may converge faster. A half has
// n / 2 samples and the noise camera (n / 2)^-slope, and the mean of both halves has half of that.
void PriceModel::FitCamera(const std::vector<Pilot>& pilots) {
  const Pilot& last = pilots.back();
  slope = 1;
  camera = last.noise * last.samples;
  samples = last.samples;
  relativeError = last.noise > 0 ? last.error / last.noise : 0;
  if (pilots.size() < 2 || !(last.noise > 0)) return;
  const Pilot& first = pilots.front();
  const double octaves = std::log(last.samples / first.samples);
  slope = std::clamp(std::log(first.noise / last.noise) / octaves, 1., kMostSlope);
  camera = 2 * last.noise * std::pow(last.samples / 2, slope);
}

// Two halves with photons of their own contain half the noise of one set of maps. What is not
// significant counts as 0.
void PriceModel::TakePhotonNoise(const Pilot& pilot) {
  const double expected = .5 * camera * std::pow(pilot.samples / 2, -slope);
  const double excess = pilot.noise - expected;
  const double error = std::hypot(pilot.error, relativeError * expected);
  if (excess > kStandardErrors * error) photonNoise = 2 * excess;
}

// Fits noise = camera / n + photonNoise / 2 by least squares of relative differences. Does nothing
// if the noise of photons is not significant.
void PriceModel::FitPhotonNoise(const std::vector<Pilot>& pilots) {
  if (pilots.size() < 3) return;
  // Minimises the sum of (a x + b y - 1)^2 over pilots, with x = 1 / (n noise) and y = 1 / noise.
  double xx = 0, xy = 0, yy = 0, x1 = 0, y1 = 0;
  for (const Pilot& pilot : pilots) {
    if (!(pilot.noise > 0)) return;
    const double x = 1 / (pilot.samples * pilot.noise), y = 1 / pilot.noise;
    xx += x * x, xy += x * y, yy += y * y, x1 += x, y1 += y;
  }
  const double determinant = xx * yy - xy * xy;
  if (!(determinant > 0)) return;
  const double a = (x1 * yy - y1 * xy) / determinant, b = (y1 * xx - x1 * xy) / determinant;
  double residual = 0;
  for (const Pilot& pilot : pilots) {
    const double fitted = (a / pilot.samples + b) / pilot.noise;
    residual += (fitted - 1) * (fitted - 1);
  }
  const double variance = residual / double(pilots.size() - 2) * xx / determinant;
  if (!(a > 0) || !(b > kStandardErrors * std::sqrt(variance))) return;
  slope = 1;
  camera = a;
  photonNoise = 2 * b;
}

// The ends of the interval are the prices of two other models: a scene without bias and noise of
// photons, and one with the most bias, whose noise falls as 1/n after the last pilot.
std::optional<Price> PriceOf(const PriceModel& model, const Order& order) {
  std::optional<Price> price = Cheapest(model, order);
  if (!price) return price;
  const double width = kQuantile90 * model.relativeError;
  PriceModel cheap = model, dear = model;
  cheap.photonNoise = cheap.bias = 0;
  cheap.camera /= 1 + width;
  dear.bias = std::max(model.biasUpper, model.bias);
  dear.slope = 1;
  dear.camera *= (1 + width) * std::pow(model.samples, 1 - model.slope);
  const auto least = Cheapest(cheap, order);
  const auto most = Cheapest(dear, order);
  price->least = std::min(least ? least->seconds : price->seconds, price->seconds) / kMargin;
  price->most = (most ? std::max(most->seconds, price->seconds) : double(INFINITY)) * kMargin;
  return price;
}

}  // namespace exphoton::cli
