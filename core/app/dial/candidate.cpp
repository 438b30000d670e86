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

constexpr int kGroups = 2;          // of passes, at least
constexpr double kNoiseShare = .9;  // of what the bias leaves; the rest is for the interval
constexpr double kBiasShares[] = {.06, .125, .25, .5};  // of the wanted relMSE; see AccuracyRule
constexpr double kPilotShare = .1;                      // of the price
constexpr std::size_t kFirstPilots = 2, kMostPilots = 8;
constexpr double kFewPhotons = .1;  // of PilotRequest::hasFewPhotons
// With few photons, guides are worse and fewer hits have a radiance photon. All photons had up to
// this factor less noise in the scenes of docs/decisions/0055-accuracy-dial.md.
constexpr double kGainOfGuide = 2, kGainOfMaps = 20;
constexpr int kMostTries = 3;     // of numbers of photons
constexpr double kScatter = .25;  // of the noise of the last pilot

}  // namespace

Explorer::Explorer(PilotRenderer* pilots, const std::string& integrator, int gatherRays,
                   const Wish& wish)
    : pilots_(pilots), wish_(wish) {
  candidate_.integrator = request_.integrator = integrator;
  request_.settings.gatherRays = gatherRays;
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

void Explorer::Begin() {
  Guarded([&] {
    RenderRoughPilot();
    while (!isRough_ && series_.size() < kFirstPilots) RenderPilot();
    TakePrice();
  });
}

void Explorer::Settle(double most) {
  Guarded([&] {
    if (!isRough_ || IsTooDear(most)) return;
    RenderPilot();
    TakePrice();
  });
}

void Explorer::Refine(double most) {
  Guarded([&] {
    if (isRough_) return;
    while (series_.size() < kMostPilots && !IsTooDear(most) && spent_ + next_ <= Affordable(most))
      RenderPilot();
    if (hasBias_ && !IsTooDear(most)) EstimateBias(most);
    TakePrice();
  });
}

std::optional<Explorer::Split> Explorer::CheapestSplit() const {
  std::optional<Split> best;
  for (const double share : kBiasShares) {
    const double left = hasBias_ ? kNoiseShare * (1 - share) : kNoiseShare;
    std::optional<Price> price = PriceOf(model_, {wish_.error * std::sqrt(left), kGroups});
    if (!price) continue;
    if (hasBias_) {
      const double certificate =
          certificate_.correction * certificate_.Corrections(share * Wanted());
      price->seconds += certificate, price->least += certificate;
    }
    if (!best || price->seconds < best->price.seconds) best = {*price, hasBias_ ? share : 0};
  }
  return best;
}

void Explorer::TakePrice() {
  const std::optional<Split> split = CheapestSplit();
  if (!split) {
    candidate_.reason = "its bias needs too many photons";
    return;
  }
  candidate_.price = split->price;
  candidate_.settings.photons = split->price.photons;
  candidate_.biasShare = split->biasShare;
  candidate_.photonShare = model_.maps * split->price.photons / split->price.seconds;
  candidate_.photonSamples = model_.maps * split->price.photons / model_.sample;
  candidate_.hasScatter = model_.relativeError > kScatter;
  if (!hasBias_) return;
  const double rays = std::max(gatherRays_ * split->price.samples, 1.);
  candidate_.correctedShare =
      std::clamp(certificate_.Corrections(split->biasShare * Wanted()) / rays, 1. / 1024, 1.);
}

// A tenth of the photons shows what all of them cost, for each group of passes. Integrators without
// photons need no such pilot.
void Explorer::RenderRoughPilot() {
  if (request_.integrator == "path") return;
  PilotRequest few = request_;
  few.hasFewPhotons = true;
  const PilotPicture picture = pilots_->Render(few);
  isRough_ = picture.cost.maps > 0;
  if (!isRough_) return;
  TakeCosts(picture);
  model_.maps = picture.cost.maps / kFewPhotons;
  model_.FitNoise({picture.pilot});
}

// Returns what pilots may cost.
double Explorer::Affordable(double most) const {
  const std::optional<Split> split = CheapestSplit();
  const double price = split ? split->price.seconds : 0;
  return kPilotShare * (most > 0 ? std::min(price, most) : price);
}

bool Explorer::IsTooDear(double most) const {
  if (isRough_) return RoughBest() > most;
  const std::optional<Split> split = CheapestSplit();
  return split && split->price.least > most;
}

// Returns the price if all photons make the noise as much smaller as they may.
double Explorer::RoughBest() const {
  Explorer best = *this;
  best.model_.camera /= hasBias_ ? kGainOfMaps : kGainOfGuide;
  const std::optional<Split> split = best.CheapestSplit();
  return split ? split->price.seconds : std::numeric_limits<double>::infinity();
}

void Explorer::RenderPilot() {
  Take(pilots_->Render(request_));
  request_.samples *= 2;
}

void Explorer::TakeCosts(const PilotPicture& picture) {
  hasBias_ = picture.hasBias;
  model_.hasPhotons = hasBias_ && !wish_.keepsPhotons;
  costOfSamples_ = picture.cost.samples / picture.pilot.samples;
  model_.sample = costOfSamples_ * pilots_->Pixels() / picture.pixels;
  gatherRays_ = picture.gatherRays / picture.pilot.samples * pilots_->Pixels() / picture.pixels;
  spent_ += picture.cost.maps + picture.cost.samples;
  next_ = 2 * picture.cost.samples;
  candidate_.mean = {candidate_.integrator, picture.light};
  candidate_.secondsPerCost = picture.seconds / (picture.cost.maps + picture.cost.samples);
}

void Explorer::Take(const PilotPicture& picture) {
  isRough_ = false;
  TakeCosts(picture);
  if (picture.mapCount > 0) TakeMaps(picture);
  series_.push_back(picture.pilot);
  model_.FitNoise(series_);
}

void Explorer::TakeMaps(const PilotPicture& picture) {
  model_.maps = picture.cost.maps / picture.mapCount;
  candidate_.settings = picture.settings;
}

// Where a pilot for it is too dear, the first passes of the picture show the bias and the noise of
// the photons. The first pass of the picture then lacks the photons of the pilots.
void Explorer::EstimateBias(double most) {
  if (spent_ + 2 * model_.maps + next_ > Affordable(most)) return;
  request_.estimatesBias = request_.hasOwnPhotons = true;
  request_.settings = candidate_.settings;
  request_.settings.photons = 1;
  for (int i = 0; i < kMostTries; ++i) {
    const PilotPicture picture = pilots_->Render(request_);
    if (i == 0) {
      series_.push_back(picture.pilot);
      model_.FitNoise(series_);
    }
    TakeBias(picture);
    // Another pilot confirms the number of photons that the model chose.
    const std::optional<Split> split = CheapestSplit();
    if (!split || split->price.photons <= request_.settings.photons) return;
    const double maps = 2 * model_.maps * split->price.photons;
    if (spent_ + maps + next_ > Affordable(most)) return;
    request_.settings.photons = split->price.photons;
  }
}

void Explorer::TakeBias(const PilotPicture& picture) {
  const Certificate& certificate = *picture.certificate;
  model_.bias = request_.settings.photons * BlockBias::Root(certificate.bias.squared);
  model_.biasUpper = request_.settings.photons * BlockBias::Root(certificate.bias.upper);
  const double corrections = double(certificate.corrections);
  if (!(corrections > 0)) return;
  const double extra = std::max(picture.cost.samples - costOfSamples_ * picture.pilot.samples, 0.);
  certificate_ = {corrections * certificate.bias.smallest, extra / corrections * kCorrectionRay};
}

}  // namespace exphoton::cli
