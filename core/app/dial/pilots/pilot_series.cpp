// SPDX-License-Identifier: BSD-2-Clause
#include "core/app/dial/pilots/pilot_series.h"

#include <algorithm>

namespace exphoton::cli {
namespace {

constexpr double kLeastPhotons = 1. / 4;  // of the scene's
constexpr int kMoreSamples = 8;           // for the light of a rough pilot

}  // namespace

PilotSeries::PilotSeries(PilotRenderer* pilots, const std::string& integrator, int gatherRays,
                         Unit unit)
    : renderer_(pilots), unit_(unit) {
  request_.integrator = integrator;
  request_.settings.gatherRays = gatherRays;
  request_.estimatesSharing = unit == Unit::CountedCost;  // seconds are those of plain renders
  model_.fixed = unit == Unit::CpuSeconds ? pilots->LoadSeconds() : 0;
}

// Returns the request of the first pilot. It is rough before pictures, except for path.
PilotRequest PilotSeries::FirstRequest() const {
  PilotRequest first = request_;
  first.isRough = unit_ == Unit::CountedCost && request_.integrator != "path";
  return first;
}

std::vector<std::string> PilotSeries::UnseenLight() {
  return renderer_->UnseenLight(FirstRequest());
}

bool PilotSeries::RenderRough() {
  const PilotRequest rough = FirstRequest();
  if (!rough.isRough) return false;
  last_ = renderer_->Render(rough);
  TakeCosts(last_);
  settings_ = last_.settings;
  const MapPrices tenth = OneSetOf(last_);
  model_.FitMaps({tenth.all / kFewPhotons, tenth.caustic / kFewPhotons, tenth.direct / kFewPhotons},
                 1);
  causticMaps_ = tenth.caustic / kFewPhotons;
  model_.leastPhotons = settings_.indirectPhotons > 0 ? kLeastPhotons : 1;
  model_.guessedBias = last_.guessedBias;
  model_.FitNoise({PilotOf(last_, kFewPhotons)});
  return true;
}

void PilotSeries::RenderRoughLight() {
  PilotRequest rough = FirstRequest();
  rough.samples *= kMoreSamples;
  last_ = renderer_->Render(rough);
  spent_ += CostOf(last_).maps + CostOf(last_).samples;
}

// The photons of the pilot cost nothing in the first pass of the picture.
void PilotSeries::UsePhotons(double photons) {
  request_.settings = settings_;
  request_.settings.photons = photons;
  model_.leastPhotons = photons;
}

void PilotSeries::Render() {
  last_ = renderer_->Render(request_);
  request_.samples *= 2;
  TakeCosts(last_);
  if (last_.mapCount > 0) {
    model_.FitMaps(OneSetOf(last_), request_.settings.photons);
    causticMaps_ = OneSetOf(last_).caustic / std::max(request_.settings.photons, 1.);
    settings_ = last_.settings;
  }
  Pilot pilot = PilotOf(last_, request_.settings.photons);
  pilot.noise *= last_.noiseOfPicture;
  pilot.error *= last_.noiseOfPicture;
  pilots_.push_back(pilot);
  model_.FitNoise(pilots_);
  TakeSharing();
  OwnMaps(request_.settings.photons);
}

// The gathers of a half are shared alone.
void PilotSeries::TakeSharing() {
  const SharingBias& bias = last_.sharing;
  model_.sharing = {last_.pilot.samples / 2, bias.squared, bias.standardError};
}

// The picture of an accuracy takes the maps of the last pilot. Quotes are for other renders.
void PilotSeries::OwnMaps(double photons) {
  if (unit_ != Unit::CountedCost) return;
  model_.owned = photons;
  if (last_.mapCount > 0) ownedMaps_ = last_.cost.maps;
}

// Returns the pilot with the noise of the scene's photons.
Pilot PilotSeries::PilotOf(const PilotPicture& picture, double photons) {
  Pilot pilot = picture.pilot;
  pilot.photonNoise *= photons;
  return pilot;
}

// Returns the prices of the maps of one group. Direct photons become fewer with indirect ones
// unless the scene gives their number.
MapPrices PilotSeries::OneSetOf(const PilotPicture& picture) const {
  const CountedCost cost = CostOf(picture);
  const double sets = std::max(picture.mapCount, 1);
  return {cost.maps / sets, cost.causticMaps / sets,
          renderer_->GivesDirectPhotons() ? cost.directMaps / sets : 0};
}

void PilotSeries::RenderBias(double photons) {
  PilotRequest request = request_;
  request.estimatesBias = true;
  request.samples = std::max(request_.samples / 2, 2);
  request.settings = settings_;
  request.settings.photons = photons;
  request.estimatesSharing = true;
  last_ = renderer_->Render(request);
  TakeSharing();
  spent_ += CostOf(last_).maps + CostOf(last_).samples;
  model_.photonNoise = PilotOf(last_, photons).photonNoise;
  OwnMaps(photons);
  if (last_.certificate) TakeBias(photons);
}

CountedCost PilotSeries::CostOf(const PilotPicture& picture) const {
  return unit_ == Unit::CountedCost ? picture.cost : picture.cpuSeconds;
}

void PilotSeries::TakeCosts(const PilotPicture& picture) {
  const CountedCost cost = CostOf(picture);
  const double pixels = renderer_->Pixels() / picture.pixels;
  costOfSample_ = cost.samples / picture.pilot.samples;
  model_.sample = costOfSample_ * pixels;
  model_.hasPhotons = picture.hasBias;
  gatherRays_ = picture.gatherRays / picture.pilot.samples * pixels;
  spent_ += cost.maps + cost.samples;
  next_ = 2 * cost.samples;
  secondsPerPrice_ = picture.seconds / (cost.maps + cost.samples);
}

void PilotSeries::TakeBias(double photons) {
  const Certificate& certificate = *last_.certificate;
  model_.bias = photons * BlockBias::Root(certificate.bias.squared);
  model_.biasUpper = photons * BlockBias::Root(certificate.bias.upper);
  const double corrections = double(certificate.corrections);
  if (!(corrections > 0)) return;
  const double extra = std::max(CostOf(last_).samples - costOfSample_ * last_.pilot.samples, 0.);
  certificateCost_ = {corrections * certificate.bias.smallest,
                      extra / corrections * kCorrectionRay};
}

}  // namespace exphoton::cli
