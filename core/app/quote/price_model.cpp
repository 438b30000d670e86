// SPDX-License-Identifier: BSD-2-Clause
#include "core/app/quote/price_model.h"

#include <algorithm>
#include <cmath>

#include "core/render/passes/photon_sets.h"

namespace exphoton::cli {
namespace {

constexpr double kMostPhotons = 64;
constexpr int kSharingRounds = 4;
constexpr double kLeastNoise = .3;    // the part that sharing leaves for noise
constexpr double kSharingSlope = .4;  // of the squared bias of sharing over samples
constexpr double kMargin = 1.35;      // of the seconds: clocks, and small parts of the scene

// Sequences of n samples have errors of order n^-1.5 at edges, and n^-1 or more elsewhere. A few
// pilots say little about the slope, so it is drawn to those of many renders.
constexpr double kLeastSlope = 1, kMostSlope = 1.5;
constexpr double kUsualSlope = 1.1, kUsualSpread = .1;
constexpr std::size_t kOctaves = 2;    // of the last pilots, which show the slope
constexpr double kQuantile90 = 1.645;  // of a two-sided interval of 90 %

// Returns the samples of one of some groups whose noise and bias of sharing together are `left`.
// More samples lower both. Sharing is given up where its bias leaves little for the noise
// (docs/decisions/0093-stop-sharing-for-an-accuracy.md), so some is always left.
double SamplesOfGroup(const PriceModel& model, double left, double groups) {
  double samples = model.SamplesFor(left * groups);
  for (int i = 0; i < kSharingRounds && model.sharing.noise > 0; ++i) {
    const double bias = std::min(model.SharingBiasOf(samples), (1 - kLeastNoise) * left);
    samples = model.SamplesFor((left - bias) * groups);
  }
  return samples;
}

// The cheapest setting.
std::optional<Price> Cheapest(const PriceModel& model, const Order& order) {
  std::optional<Price> best;
  const double squared = order.error * order.error, groups = order.groups;
  const double first = model.hasPhotons ? model.leastPhotons : 1;
  for (double k = first; k <= (model.hasPhotons ? kMostPhotons : 1); k *= 2) {
    const double bias = (k < 1 ? std::max(model.bias, model.biasOfFewer) : model.bias) / k;
    const double photonNoise = model.photonNoise / k;
    const double sets =
        photonNoise <= PhotonSets::kSmallShare * (squared - bias * bias) ? 1 : groups;
    const double left = squared - photonNoise / sets - bias * bias;
    if (!(left > 0)) continue;
    Price price;
    price.samples = std::max(groups, std::ceil(groups * SamplesOfGroup(model, left, groups)));
    price.photons = k;
    price.sets = int(sets);
    const double paid = k == model.owned ? sets - 1 : sets;
    price.seconds = model.fixed + paid * model.MapsFor(k) + price.samples * model.sample;
    if (!best || price.seconds < best->seconds) best = price;
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
  return sharing.noise > 0 ? sharing.noise * std::pow(sharing.samples / samples, kSharingSlope) : 0;
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
  cheap.photonNoise = cheap.bias = 0;
  dear.bias = std::max(model.biasUpper, model.bias);
  const auto least = Cheapest(cheap, order);
  const auto most = Cheapest(dear, order);
  price->least = std::min(least ? least->seconds : price->seconds, price->seconds) / kMargin;
  price->most = (most ? std::max(most->seconds, price->seconds) : double(INFINITY)) * kMargin;
  return price;
}

}  // namespace exphoton::cli
