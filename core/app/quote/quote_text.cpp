// SPDX-License-Identifier: BSD-2-Clause
// QuoteText: one block for each accuracy, the cheapest integrator first.
#include "core/app/quote/quote_text.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <span>

#include "core/app/analysis/numbers.h"
#include "core/app/options/arguments.h"
#include "core/app/quote/missing_light.h"
#include "core/base/format.h"

namespace exphoton::cli {
namespace {

struct Offer {
  const Quote* quote;
  std::optional<Price> price;
  std::string reason;  // why there is no price
};

std::string Percent(double share) { return Plain(100 * share, 3) + " %"; }

PilotMean MeanOf(const Quote& quote) { return {quote.integrator, quote.light}; }

Offer MakeOffer(const Quote& quote, std::span<const PilotMean> means, const Order& order) {
  Offer offer{&quote, {}, quote.failure};
  if (!offer.reason.empty()) return offer;
  offer.reason = MissingLight(MeanOf(quote), means);
  if (!offer.reason.empty()) return offer;
  offer.price = PriceOf(quote.model, order);
  if (!offer.price)
    offer.reason = "needs more than 64 times the photons (bias " + Percent(quote.model.bias) + ")";
  return offer;
}

std::string CommandOf(const QuoteScene& scene, const Offer& offer) {
  const Quote& quote = *offer.quote;
  std::vector<std::string> words{"exphoton", scene.path, "--integrator", quote.integrator};
  const std::vector<std::string>& common = scene.options.at(quote.integrator);
  words.insert(words.end(), common.begin(), common.end());
  words.insert(words.end(), {"--spp", std::to_string(std::int64_t(offer.price->samples))});
  DialSettings settings = quote.settings;
  settings.photons = offer.price->photons;
  for (const ParameterOverride& set : settings.Overrides())
    words.insert(words.end(), {"--set", set.directive + "." + set.parameter + "=" + set.value});
  return CommandLineText(words);
}

std::string OfferText(const QuoteScene& scene, const Offer& offer) {
  char text[256];
  const std::string& name = offer.quote->integrator;
  if (!offer.price) {
    std::snprintf(text, sizeof text, "  %-14s open: ", name.c_str());
    return text + offer.reason + "\n";
  }
  const Price& price = *offer.price;
  const std::string most =
      std::isfinite(price.most) ? study::SecondsText(price.most) : "no known limit";
  // 60 bytes for each photon and its radiance photon
  const DialSettings& settings = offer.quote->settings;
  const double photons = settings.indirectPhotons + settings.causticPhotons;
  const double memory = offer.quote->memory + 60 * photons * (price.photons - 1);
  std::snprintf(text, sizeof text, "  %-14s %s (%s to %s), %.0f MB\n", name.c_str(),
                study::SecondsText(price.seconds).c_str(), study::SecondsText(price.least).c_str(),
                most.c_str(), memory / 1e6);
  return text + ("    " + CommandOf(scene, offer)) + "\n";
}

}  // namespace

std::string QuoteText(const QuoteScene& scene, const std::vector<Quote>& quotes,
                      const std::vector<double>& accuracies) {
  std::vector<PilotMean> means;
  for (const Quote& quote : quotes) means.push_back(MeanOf(quote));
  std::string text;
  for (const double accuracy : accuracies) {
    std::vector<Offer> offers;
    const Order order{.error = accuracy, .sampler = scene.sampler};
    for (const Quote& quote : quotes) offers.push_back(MakeOffer(quote, means, order));
    std::ranges::stable_sort(offers, {}, [](const Offer& offer) {
      return offer.price ? offer.price->seconds : std::numeric_limits<double>::infinity();
    });
    text += "error " + Percent(accuracy) + ", CPU time:\n";
    for (const Offer& offer : offers) text += OfferText(scene, offer);
  }
  for (const Quote& quote : quotes)
    for (const std::string& part : quote.notCovered)
      text += quote.integrator + ": the bias leaves out " + part + "\n";
  return text;
}

}  // namespace exphoton::cli
