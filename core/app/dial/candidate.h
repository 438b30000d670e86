// SPDX-License-Identifier: BSD-2-Clause
// Explorer finds out, with pilots, at what price an integrator reaches an accuracy. Small pilots
// give a first price: of integrators with photons, one pilot with a tenth of the photons gives a
// rough one. Settle then renders a pilot with all photons where the integrator may be the cheapest
// one, and Refine spends up to a tenth of the price on larger pilots.
#pragma once

#include <string>
#include <vector>

#include "core/app/dial/pilot.h"
#include "core/app/quote/missing_light.h"

namespace exphoton::cli {

struct Candidate {
  std::string integrator;
  std::string reason;  // why it has no price; "": it has one
  // Prices are in units of CountedCost, and photons in factors of the scene's.
  Price price;
  DialSettings settings;
  PilotMean mean;             // of the last pilot
  double secondsPerCost = 0;  // CPU time of the pilots, for messages only
  double correctedShare = 0;  // of the gather rays; 0: no certificate
  double biasShare = 0;       // of the squared error, what the certificate should resolve
  double photonShare = 0;     // of the price, what the photons of one group cost
  double photonSamples = 0;   // the same, in samples per pixel
  bool hasScatter = false;    // the noise of the pilots is uncertain
};

struct Wish {
  double error = 0;           // root of relMSE
  bool keepsPhotons = false;  // the number of photons must be the scene's
};

// What certificates cost. The interval of the bias (relMSE) is inversely proportional to the number
// of corrections: smallest bias * corrections = constant.
struct CertificateCost {
  double constant = 8;     // typical of the scenes in scenes/
  double correction = 28;  // price of one

  double Corrections(double wanted) const { return constant / wanted; }
};

class Explorer {
 public:
  // gatherRays: as in DialSettings.
  Explorer(PilotRenderer* pilots, const std::string& integrator, int gatherRays, const Wish& wish);

  // `most` is the lowest price of all candidates. A candidate with a higher price need not be
  // explored further.
  void Begin();
  // Replaces a rough price where it may become the lowest one.
  void Settle(double most);
  void Refine(double most);
  // The results so far.
  const Candidate& Result() const { return candidate_; }

 private:
  // The cheapest split of the squared error between noise and the interval of the bias.
  struct Split {
    Price price;
    double biasShare = 0;
  };

  template <class Step>
  void Guarded(const Step& step);
  double Wanted() const { return wish_.error * wish_.error; }
  std::optional<Split> CheapestSplit() const;
  void TakePrice();
  void RenderRoughPilot();
  double Affordable(double most) const;
  bool IsTooDear(double most) const;
  double RoughBest() const;
  void RenderPilot();
  void TakeCosts(const PilotPicture& picture);
  void Take(const PilotPicture& picture);
  void TakeMaps(const PilotPicture& picture);
  void EstimateBias(double most);
  void TakeBias(const PilotPicture& picture);

  PilotRenderer* pilots_;
  Wish wish_;
  PilotRequest request_;
  std::vector<Pilot> series_;
  PriceModel model_;
  CertificateCost certificate_;
  bool hasBias_ = false, isRough_ = false;
  double spent_ = 0, next_ = 0;  // prices of the pilots so far, and of the next one
  double costOfSamples_ = 0;     // of one sample per pixel of a pilot
  double gatherRays_ = 0;        // for one sample per pixel of the picture
  Candidate candidate_;
};

}  // namespace exphoton::cli
