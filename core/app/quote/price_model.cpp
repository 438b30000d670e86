// SPDX-License-Identifier: BSD-2-Clause
#include "core/app/quote/price_model.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/render/passes/photons/photon_sets.h"
#include "core/render/sharing/sharing_estimate.h"
#include "core/sampling/sampler.h"

namespace exphoton::cli {
namespace {

constexpr double kMostPhotons = 64;
constexpr int kHalvings = 40;
constexpr double kMostSamples = 1e12;
constexpr double kCountable = 0x1p53;  // integers up to this one are exact
constexpr double kLeastNoise = .3;     // the part that sharing leaves for noise
constexpr double kMargin = 1.35;       // of the seconds: clocks, and small parts of the scene

// Sequences of n samples have errors of order n^-1.5 at edges, and n^-1 or more elsewhere. A few
// pilots say little about the slope, so it is drawn to those of many renders.
constexpr double kLeastSlope = 1, kMostSlope = 1.5;
constexpr double kUsualSlope = 1.1, kUsualSpread = .1;
constexpr std::size_t kOctaves = 2;    // of the last pilots, which show the slope
constexpr double kQuantile90 = 1.645;  // of a two-sided interval of 90 %

// Returns the samples of each group so that noise and bias of sharing together are `left`. Both
// fall with the samples. A render that may stop sharing never leaves less than kLeastNoise for the
// noise.
double SamplesOfGroup(const PriceModel& model, double left, const Order& order) {
  const auto missing = [&](double samples) {
    const double noise = left - model.SharingBiasOf(samples);
    return !(noise > 0) || samples < model.SamplesFor(noise * order.groups);
  };
  double low = model.SamplesFor(left * order.groups);
  if (!(model.sharing.bias > 0)) return low;
  double high = order.mayStopSharing ? model.SamplesFor(kLeastNoise * left * order.groups) : low;
  while (!order.mayStopSharing && high < kMostSamples && missing(high)) high *= 2;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = std::sqrt(low * high);
    (missing(middle) ? low : high) = middle;
  }
  return high;
}

// Returns the larger one of the known bias and the guess. A guess may be wrong by much, so it asks
// for mostForGuess times the photons at most. With these it is half of the error or less, so that a
// guess alone never makes an error impossible. Photons that may not change need no guess.
double BiasWith(double k, const PriceModel& model, double error) {
  if (!model.hasPhotons) return model.bias / k;
  const double most = model.mostForGuess;
  const double guess = std::min(model.guessedBias, error * std::sqrt(most) / 2);
  return std::max(model.bias / k, guess / std::sqrt(std::min(k, most)));
}

// Returns the setting with k times the photons; nullopt: no number of samples is enough.
std::optional<Price> PriceWith(double k, const PriceModel& model, const Order& order) {
  const double squared = order.error * order.error;
  const double bias = BiasWith(k, model, order.error);
  const double photonNoise = model.photonNoise / k;
  const auto samplesWith = [&](int sets) -> std::optional<double> {
    const double left = squared - photonNoise / sets - bias * bias;
    if (!(left > 0)) return std::nullopt;
    return SamplesOfGroup(model, left, order);
  };
  Price price;
  auto samples = samplesWith(1);
  const double sharing = samples ? model.SharingBiasOf(*samples) : 0;
  if (!samples || photonNoise > PhotonSets::kSmallShare * (squared - bias * bias - sharing)) {
    price.sets = order.groups;
    samples = samplesWith(price.sets);
  }
  if (!samples) return std::nullopt;
  price.samples = std::clamp(std::ceil(order.groups * *samples), double(order.groups), kCountable);
  if (order.sampler)
    price.samples = double(order.sampler->RoundSamplesPerPixel(std::int64_t(price.samples)));
  price.photons = k;
  const int paid = k == model.owned ? price.sets - 1 : price.sets;
  price.seconds = model.fixed + paid * model.MapsFor(k) + price.samples * model.sample;
  return price;
}

// The cheapest setting.
std::optional<Price> Cheapest(const PriceModel& model, const Order& order) {
  std::optional<Price> best;
  const double first = model.hasPhotons ? model.leastPhotons : 1;
  for (double k = first; k <= (model.hasPhotons ? kMostPhotons : 1); k *= 2) {
    const auto price = PriceWith(k, model, order);
    if (price && (!best || price->seconds < best->seconds)) best = price;
  }
  return best;
}

}  // namespace

void PriceModel::FitNoise(const std::vector<Pilot>& pilots) {
  FitCamera(pilots);
  photonNoise = pilots.back().photonNoise;
}

// A half has half of the samples and twice the noise of both.
void PriceModel::FitCamera(const std::vector<Pilot>& pilots) {
  points.clear();
  for (const Pilot& pilot : pilots) {
    if (!(pilot.noise > 0)) continue;
    while (!points.empty() && points.back().noise <= 2 * pilot.noise) points.pop_back();
    points.push_back({pilot.samples / 2, 2 * pilot.noise});
  }
  const Pilot& last = pilots.back();
  relativeError = last.noise > 0 ? last.error / last.noise : 0;
  slope = 1, slopeError = 0;
  if (pilots.size() > 1 && last.noise > 0)
    FitSlope(pilots[pilots.size() - std::min(pilots.size(), kOctaves + 1)], last);
  camera = 2 * last.noise * std::pow(last.samples / 2, slope);
}

// The mean of what the pilots show and of the usual slope, weighted by the inverse variances.
void PriceModel::FitSlope(const Pilot& first, const Pilot& last) {
  const double octaves = std::log(last.samples / first.samples);
  if (!(first.noise > 0) || !(octaves > 0)) return;
  const double shown = std::log(first.noise / last.noise) / octaves;
  const double error = std::hypot(first.error / first.noise, relativeError) / octaves;
  const double weight = kUsualSpread * kUsualSpread / (kUsualSpread * kUsualSpread + error * error);
  slope = std::clamp(weight * shown + (1 - weight) * kUsualSlope, kLeastSlope, kMostSlope);
  slopeError = std::sqrt(weight) * error;
}

void PriceModel::FitMaps(const MapPrices& prices, double k) {
  const double kept = prices.direct + prices.caustic;
  keptMaps = k < 1 ? kept : prices.direct + prices.caustic / k;
  maps = k < 1 ? kept + (prices.all - kept) / k : prices.all / k;
}

double PriceModel::MapsFor(double k) const {
  return k < 1 ? k * (maps - keptMaps) + keptMaps : k * maps;
}

double PriceModel::SamplesFor(double noise) const {
  if (points.empty() || noise <= points.back().noise) return std::pow(camera / noise, 1 / slope);
  for (std::size_t i = points.size() - 1; i > 0; --i) {
    const Point &a = points[i - 1], &b = points[i];
    if (noise > a.noise) continue;
    const double t = std::log(a.noise / noise) / std::log(a.noise / b.noise);
    return a.samples * std::pow(b.samples / a.samples, t);
  }
  return points.front().samples * points.front().noise / noise;
}

double PriceModel::SharingBiasOf(double samples) const {
  if (!(sharing.bias > 0)) return 0;
  return sharing.bias * std::pow(sharing.samples / samples, kSharingSlope);
}

PriceModel PriceModel::WithNoise(double factor, double otherSlope) const {
  PriceModel other = *this;
  for (Point& point : other.points) point.noise *= factor;
  const double end = points.empty() ? 1 : points.back().samples;
  other.camera *= factor * std::pow(end, otherSlope - slope);
  other.slope = otherSlope;
  return other;
}

// The ends of the interval are the prices of two other models: a scene without bias and noise of
// photons, and one with the most bias, whose noise falls as 1/n after the last pilot.
std::optional<Price> PriceOf(const PriceModel& model, const Order& order) {
  std::optional<Price> price = Cheapest(model, order);
  if (!price) return price;
  const double width = kQuantile90 * model.relativeError;
  const double steep = std::min(model.slope + kQuantile90 * model.slopeError, kMostSlope);
  PriceModel cheap = model.WithNoise(1 / (1 + width), std::max(steep, model.slope));
  PriceModel dear = model.WithNoise(1 + width, std::min(model.slope, kLeastSlope));
  cheap.photonNoise = cheap.bias = cheap.guessedBias = 0;
  cheap.sharing = {};
  dear.bias = std::max(model.biasUpper, model.bias);
  dear.sharing.bias = std::max(dear.sharing.bias, 0.) + kQuantile90 * model.sharing.error;
  const auto least = Cheapest(cheap, order);
  const auto most = Cheapest(dear, order);
  price->least = std::min(least ? least->seconds : price->seconds, price->seconds) / kMargin;
  price->most = (most ? std::max(most->seconds, price->seconds) : double(INFINITY)) * kMargin;
  return price;
}

}  // namespace exphoton::cli
