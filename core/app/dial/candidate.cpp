// SPDX-License-Identifier: BSD-2-Clause
// Pilots have doubling numbers of samples, as long as they cost less than a tenth of the price. The
// last one estimates the bias.
#include "core/app/dial/candidate.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/error.h"

namespace exphoton::cli {
namespace {

constexpr const char* kDearBias = "its bias needs too many photons";
constexpr int kGroups = 2;          // of passes, at least
constexpr double kNoiseShare = .9;  // of what the bias leaves; the rest is for the interval
constexpr double kBiasShares[] = {.06, .125, .25, .5};  // of the wanted relMSE; see AccuracyRule
constexpr double kPilotShare = .1;                      // of the price
constexpr std::size_t kMostPilots = 8;
// Rough pilots have few pixels, worse guides, and fewer hits with a radiance photon. Others had up
// to this factor less noise in the scenes of docs/decisions/0055-accuracy-dial.md.
constexpr double kGainOfGuide = 2, kGainOfMaps = 20;
constexpr int kMostTries = 3;     // of numbers of photons
constexpr double kScatter = .25;  // of the noise of the last pilot
// The photons of a picture are expected to cost at least this many times those of a rough pilot,
// which are a tenth of the scene's. With a quarter of the photons, it was 1.68 to 2.3 times in the
// scenes of docs/decisions/0103-cheaper-small-pictures.md.
constexpr double kPhotonsOfPicture = 1.5;
constexpr double kCostOfPath = 1.35;  // one ray, at least; paths that are skipped cost less
constexpr double kMorePaths = 4;      // of a rough pilot that was cut off too early
// With fewer paths, the limit would keep photons from learning where to start.
constexpr double kFewestPaths = 1 << 19;
// The price of path, divided by the price of guidedpath, is less than this in all scenes that were
// tried (docs/decisions/0055-accuracy-dial.md).
constexpr double kMostGainOverPath = 16;
// Pilots with few samples were wrong by up to this factor about the ratio of two prices.
constexpr double kRivalRatio = 4;

// Returns the limit of the paths of a rough pilot whose photons may cost this much in the picture.
double MostPaths(double most) {
  return std::max(most / (kPhotonsOfPicture * kCostOfPath), kFewestPaths);
}

}  // namespace

bool Candidate::IsRivalOf(const Candidate& other) const {
  const double a = KnownPrice(), b = other.KnownPrice();
  return a < kNoPrice && b < kNoPrice && a < kRivalRatio * b && b < kRivalRatio * a;
}

bool MayGuidingWin(const std::vector<Candidate>& others) {
  double path = 0, best = kNoPrice;
  for (const Candidate& other : others) {
    best = std::min(best, other.KnownPrice());
    if (other.integrator == "path" && other.reason.empty()) path = other.price.seconds;
  }
  return !(path > kMostGainOverPath * best);
}

Explorer::Explorer(PilotRenderer* pilots, const std::string& integrator, int gatherRays,
                   const Wish& wish)
    : pilots_(pilots),
      series_(pilots, integrator, gatherRays, PilotSeries::Unit::CountedCost),
      wish_(wish) {
  candidate_.integrator = integrator;
  for (const GivenUp& picture : wish.givenUp)
    if (picture.integrator == integrator) leastSamples_ = picture.samples;
}

// An integrator that cannot render the scene has no price.
template <class Step>
void Explorer::Guarded(const Step& step) {
  if (!candidate_.reason.empty()) return;
  try {
    step();
  } catch (const Error& error) {
    candidate_.reason = error.what();
  }
}

void Explorer::Begin(double most) {
  Guarded([&] {
    pilots_->LimitRoughPaths(MostPaths(most));
    CheckLight();
    // The pilot of path costs little, and shows whether others find still less light.
    if (!candidate_.reason.empty() && candidate_.integrator != "path") return;
    isRough_ = RenderRough(most);
    if (!isRough_) series_.Render();
    TakeLight();
    if (candidate_.reason.empty()) TakePrice();
  });
}

// An integrator that never finds some light has no price.
void Explorer::CheckLight() {
  if (wish_.mayMissLight) return;
  const std::vector<std::string> unseen = series_.UnseenLight();
  if (!unseen.empty()) candidate_.reason = "never finds " + unseen.front();
}

// Takes over the light of the last pilot.
void Explorer::TakeLight() {
  candidate_.mean = {candidate_.integrator, series_.Last().light};
  candidate_.isRough = isRough_;
}

void Explorer::SettleLight() {
  if (candidate_.reason == kDearBias) candidate_.reason.clear();
  Settle(kNoPrice);
}

void Explorer::LookAgain() {
  const bool isDear = candidate_.reason == kDearBias;
  if (isDear) candidate_.reason.clear();
  Guarded([&] {
    if (!isRough_ || hasLookedAgain_) return;
    hasLookedAgain_ = true;
    pilots_->LimitRoughPaths(roughPaths_);
    series_.RenderRoughLight();
    TakeLight();
  });
  if (isDear && candidate_.reason.empty()) candidate_.reason = kDearBias;
}

// Returns whether there is a rough pilot. If it is cut off, and the photons of the picture would
// not cost more than `most`, it is rendered again with more paths.
bool Explorer::RenderRough(double most) {
  double paths = MostPaths(most);
  for (;; paths *= kMorePaths) {
    pilots_->LimitRoughPaths(paths);
    roughPaths_ = paths;
    if (!series_.RenderRough()) return false;
    if (!series_.Last().isCutOff) return true;
    candidate_.leastPrice = kPhotonsOfPicture * series_.Last().cost.maps;
    if (candidate_.leastPrice > most) {
      candidate_.reason = "its photons cost more";
      return true;
    }
    candidate_.leastPrice = 0;
  }
}

void Explorer::Settle(double most) {
  Guarded([&] {
    if (!isRough_ || IsTooDear(most)) return;
    const auto likely = WithGain(std::sqrt(MostGain())).CheapestSplit();
    if (likely) series_.UsePhotons(likely->price.photons);
    isRough_ = false;
    series_.Render();
    TakeLight();
    if (candidate_.reason.empty()) TakePrice();
  });
}

bool Explorer::FindOmissions(double most) {
  Guarded([&] {
    if (!isRough_ || !wish_.findOmissions || !ReadsPhotonMaps(candidate_.integrator) ||
        IsTooDear(most))
      return;
    Candidate likely = LikelyResult();
    if (!likely.reason.empty()) return;
    const std::vector<OmittedEffect> omitted = wish_.findOmissions(&likely);
    candidate_.omitted = omitted;
    candidate_.hasSoughtOmissions = true;
    series_.LeaveOut(omitted);
    wish_.error -= BoundOf(omitted);
  });
  return candidate_.hasSoughtOmissions;
}

void Explorer::Refine(double most, bool hasRivals) {
  Guarded([&] {
    if (isRough_) return;
    // The picture takes the maps, but a choice without rivals needs no exact price.
    const double maps = hasRivals ? 0 : series_.OwnedMaps();
    while (series_.Count() < kMostPilots && !IsTooDear(most) &&
           series_.Spent() + maps + series_.Next() <= Affordable(most))
      series_.Render();
    if (series_.HasBias() && !IsTooDear(most)) EstimateBias(most);
    TakePrice();
  });
}

PriceModel Explorer::Model() const {
  PriceModel model = series_.Model();
  if (wish_.keepsPhotons) model.hasPhotons = false;
  // More photons are also more caustic photons, which the guess is not about.
  if (wish_.isTimed || series_.Settings().causticPhotons > 0) model.mostForGuess = 1;
  return model.WithNoise(1 / gain_, model.slope);
}

std::optional<Explorer::Split> Explorer::CheapestSplit() const {
  std::optional<Split> best;
  const PriceModel model = Model();
  const bool hasBias = series_.HasBias();
  const CertificateCost& certificate = series_.OfCertificates();
  for (const double share : kBiasShares) {
    const double left = hasBias ? kNoiseShare * (1 - share) : kNoiseShare;
    std::optional<Price> price =
        PriceOf(model, {wish_.error * std::sqrt(left), kGroups, !wish_.keepsPhotons});
    if (!price) continue;
    const double more = std::max(leastSamples_ - price->samples, 0.);
    price->samples += more;
    for (double* cost : {&price->seconds, &price->least, &price->most})
      *cost += more * model.sample;
    if (hasBias) {
      const double extra = certificate.correction * certificate.Corrections(share * Wanted());
      price->seconds += extra, price->least += extra;
    }
    if (!best || price->seconds < best->price.seconds) best = {*price, hasBias ? share : 0};
  }
  return best;
}

void Explorer::TakePrice() {
  const std::optional<Split> split = CheapestSplit();
  if (!split) {
    candidate_.reason = kDearBias;
    return;
  }
  const PriceModel& model = series_.Model();
  candidate_.price = split->price;
  candidate_.settings = series_.Settings();
  candidate_.settings.photons = split->price.photons;
  candidate_.secondsPerCost = series_.SecondsPerPrice();
  candidate_.parts = series_.Last().parts;
  candidate_.biasShare = split->biasShare;
  const double maps = model.MapsFor(split->price.photons);
  const int sets = split->price.sets - (split->price.photons == model.owned ? 1 : 0);
  candidate_.photonShare = sets * maps / split->price.seconds;
  candidate_.priceOfSample = model.sample;
  candidate_.photonSamples = maps / model.sample;
  const double caustic = series_.CausticMaps() * std::max(split->price.photons, 1.);
  candidate_.causticShare = sets * caustic / split->price.seconds;
  candidate_.hasScatter = model.relativeError > kScatter;
  if (!series_.HasBias()) return;
  const double rays = std::max(series_.GatherRays() * split->price.samples, 1.);
  candidate_.correctedShare = std::clamp(
      series_.OfCertificates().Corrections(split->biasShare * Wanted()) / rays, 1. / 1024, 1.);
}

// Returns what pilots may cost.
double Explorer::Affordable(double most) const {
  const std::optional<Split> split = CheapestSplit();
  const double price = split ? split->price.seconds : 0;
  return kPilotShare * (most > 0 ? std::min(price, most) : price);
}

bool Explorer::IsTooDear(double most) const {
  const std::optional<Split> split =
      isRough_ ? WithGain(MostGain()).CheapestSplit() : CheapestSplit();
  return split && (isRough_ ? split->price.seconds : split->price.least) > most;
}

Candidate Explorer::LikelyResult() const {
  if (!isRough_ || !candidate_.reason.empty()) return candidate_;
  Explorer likely = WithGain(std::sqrt(MostGain()));
  likely.TakePrice();
  return likely.candidate_;
}

// Returns the factor by which the noise of a rough pilot may be too high.
double Explorer::MostGain() const { return series_.HasBias() ? kGainOfMaps : kGainOfGuide; }

Explorer Explorer::WithGain(double gain) const {
  Explorer better = *this;
  better.gain_ = gain;
  return better;
}

// Where a pilot for it is too dear, the first passes of the picture show the bias.
void Explorer::EstimateBias(double most) {
  double photons = series_.Settings().photons;
  for (int i = 0; i < kMostTries; ++i) {
    const PriceModel& model = series_.Model();
    const double maps = photons == model.owned ? 0 : model.MapsFor(photons);
    if (series_.Spent() + series_.OwnedMaps() + maps + series_.Next() > Affordable(most)) return;
    series_.RenderBias(photons);
    // Another pilot confirms the number of photons that the model chose.
    const std::optional<Split> split = CheapestSplit();
    if (!split || split->price.photons <= photons) return;
    photons = split->price.photons;
  }
}

}  // namespace exphoton::cli
