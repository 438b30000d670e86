// SPDX-License-Identifier: BSD-2-Clause
// PilotSeries makes a PriceModel of one integrator from pilots. Pilots with doubling numbers of
// samples share their photons. They show the noise of camera samples and of the photons. A last one
// estimates the bias. A rough pilot may come first.
#pragma once

#include <string>
#include <vector>

#include "core/app/dial/pilots/pilot.h"

namespace exphoton::cli {

// What certificates cost. The interval of the bias (relMSE) is inversely proportional to the number
// of corrections: smallest bias * corrections = constant.
struct CertificateCost {
  double constant = 8;     // typical of the scenes in scenes/
  double correction = 28;  // price of one

  double Corrections(double wanted) const { return constant / wanted; }
};

class PilotSeries {
 public:
  // The unit of prices. Counted ones do not depend on a clock (CountedCost).
  enum class Unit { CountedCost, CpuSeconds };

  // gatherRays: as in DialSettings.
  PilotSeries(PilotRenderer* pilots, const std::string& integrator, int gatherRays, Unit unit);

  // Returns light that the integrator never finds, without a pilot.
  std::vector<std::string> UnseenLight();
  // Renders a rough pilot. It shows what all photons cost, but its noise is too high. It does not
  // belong to the series. Returns false for path, which needs none.
  bool RenderRough();
  // Renders a rough pilot with more samples, to know the light better. Prices stay.
  void RenderRoughLight();
  // Sets the factor of the photons of later pilots, after a rough one.
  void UsePhotons(double photons);
  // Leaves effects out of later pilots.
  void LeaveOut(const std::vector<OmittedEffect>& effects) { request_.omitted = effects; }
  // Renders the next pilot, with twice the samples of the last one.
  void Render();
  // Renders a pilot with this factor of the photons, which estimates the bias.
  void RenderBias(double photons);

  const std::string& Integrator() const { return request_.integrator; }
  const PriceModel& Model() const { return model_; }
  const CertificateCost& OfCertificates() const { return certificateCost_; }
  std::size_t Count() const { return pilots_.size(); }  // rough ones do not count
  bool HasBias() const { return last_.hasBias; }
  const PilotPicture& Last() const { return last_; }
  const DialSettings& Settings() const { return settings_; }  // with the photons of the scene
  double CausticMaps() const { return causticMaps_; }  // price for one group, with few photons
  double GatherRays() const { return gatherRays_; }    // for one sample per pixel of the picture
  // Prices of the pilots so far, without the maps that the picture takes, and of the next one.
  double Spent() const { return spent_ - ownedMaps_; }
  double OwnedMaps() const { return ownedMaps_; }
  double Next() const { return next_; }
  double SecondsPerPrice() const { return secondsPerPrice_; }  // CPU time

 private:
  PilotRequest FirstRequest() const;
  CountedCost CostOf(const PilotPicture& picture) const;
  void TakeCosts(const PilotPicture& picture);
  MapPrices OneSetOf(const PilotPicture& picture) const;
  void TakeBias(double photons);
  void TakeSharing();
  void OwnMaps(double photons);
  static Pilot PilotOf(const PilotPicture& picture, double photons);

  PilotRenderer* renderer_;
  PilotRequest request_;  // of the next pilot
  Unit unit_;
  std::vector<Pilot> pilots_;
  PriceModel model_;
  CertificateCost certificateCost_;
  PilotPicture last_;
  DialSettings settings_;
  double causticMaps_ = 0;
  double ownedMaps_ = 0;  // what the maps of PriceModel::owned cost
  double spent_ = 0, next_ = 0, secondsPerPrice_ = 0, gatherRays_ = 0;
  double costOfSample_ = 0;  // of one sample per pixel of a pilot without an estimate of the bias
};

}  // namespace exphoton::cli
