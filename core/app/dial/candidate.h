// SPDX-License-Identifier: BSD-2-Clause
// Explorer finds out, with pilots, at what price an integrator reaches an accuracy. A rough pilot
// gives a first price. Settle then renders a pilot of full size where the integrator may be the
// cheapest one, and Refine spends up to a tenth of the price on larger pilots.
#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "core/app/dial/pilots/pilot_series.h"
#include "core/app/quote/missing_light.h"

namespace exphoton::cli {

inline constexpr double kNoPrice = std::numeric_limits<double>::infinity();

struct Candidate {
  std::string integrator;
  std::string reason;       // why it has no price; "": it has one
  double lackingShare = 0;  // of the light that exphotonmap finds, what this one lacks; 0: unknown
  // Prices are in units of CountedCost, and photons in factors of the scene's.
  Price price = {};
  DialSettings settings = {};
  PilotMean mean = {};        // of the last pilot
  bool isRough = false;       // the price and the mean are from a rough pilot
  double leastPrice = 0;      // bound of the price if a rough pilot was cut off
  double secondsPerCost = 0;  // CPU time of the pilots, for messages only
  double correctedShare = 0;  // of the gather rays; 0: no certificate
  double biasShare = 0;       // of the squared error, what the certificate should resolve
  double photonShare = 0;     // of the price, what photons still cost
  double priceOfSample = 0;   // one per pixel
  double photonSamples = 0;   // what one set of photons costs, in samples per pixel
  double causticShare = 0;    // of the price, what caustic maps still cost
  bool hasScatter = false;    // the noise of the pilots is uncertain
  std::vector<MeasuredLight> parts = {};  // of the light of the last pilot
  std::vector<OmittedEffect> omitted = {};
  bool hasSoughtOmissions = false;  // before its pilot with all photons

  // Returns the expected price; kNoPrice if there is a reason.
  double KnownPrice() const { return reason.empty() ? price.seconds : kNoPrice; }
  // Returns whether better pilots may show that the other one is cheaper, or that it is not.
  bool IsRivalOf(const Candidate& other) const;
};

// Returns whether guidedpath may be cheaper than all of these. It is if path is not among them, or
// has no price.
bool MayGuidingWin(const std::vector<Candidate>& others);

struct Wish {
  double error = 0;           // root of relMSE
  bool keepsPhotons = false;  // the number of photons must be the scene's
  bool isTimed = false;       // a guess must not ask for more photons
  bool mayMissLight = false;  // also an integrator that never finds some light has a price
  // Returns the effects that a candidate may leave out, and changes its price. Null: none.
  std::function<std::vector<OmittedEffect>(Candidate*)> findOmissions{};
  std::vector<GivenUp> givenUp{};  // pictures of the same scene
};

class Explorer {
 public:
  // gatherRays: as in DialSettings.
  Explorer(PilotRenderer* pilots, const std::string& integrator, int gatherRays, const Wish& wish);

  // `most` is the lowest price of all candidates. A candidate with a higher price need not be
  // explored further. A rough pilot is cut off where photons alone are expected to cost more.
  void Begin(double most = kNoPrice);
  // Replaces a rough price where it may become the lowest one.
  void Settle(double most);
  // Renders a pilot of full size to know the light, whatever it costs, also if there is no price.
  void SettleLight();
  // Renders the rough pilot with more samples to know its light better, at most once.
  void LookAgain();
  bool HasLookedAgain() const { return hasLookedAgain_; }
  // Leaves out effects of photon maps that may be the cheapest ones, before all photons are shot.
  // Returns whether they were sought.
  bool FindOmissions(double most);
  // A candidate with rivals gets more pilots.
  void Refine(double most, bool hasRivals);
  // The results so far.
  const Candidate& Result() const { return candidate_; }
  // The same with the price that a pilot of full size is likely to show after a rough one.
  Candidate LikelyResult() const;

 private:
  // The cheapest split of the squared error between noise and the interval of the bias.
  struct Split {
    Price price;
    double biasShare = 0;
  };

  bool RenderRough(double most);
  void CheckLight();
  void TakeLight();
  template <class Step>
  void Guarded(const Step& step);
  double Wanted() const { return wish_.error * wish_.error; }
  std::optional<Split> CheapestSplit() const;
  void TakePrice();
  PriceModel Model() const;
  double Affordable(double most) const;
  bool IsTooDear(double most) const;
  double MostGain() const;
  // Returns a copy whose model divides the noise of the pilots by this factor.
  Explorer WithGain(double gain) const;
  void EstimateBias(double most);

  PilotRenderer* pilots_;
  PilotSeries series_;
  Wish wish_;
  bool isRough_ = false, hasLookedAgain_ = false;
  double roughPaths_ = 0;    // limit of the photon paths of the rough pilot
  double gain_ = 1;          // divides the noise of the model
  double leastSamples_ = 0;  // that a picture which was given up needs
  Candidate candidate_;
};

}  // namespace exphoton::cli
