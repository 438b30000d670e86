// SPDX-License-Identifier: BSD-2-Clause
// Certificate: the interval of the bias, and the texts.
#include "core/render/certificate/certificate.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/format.h"
#include "core/render/certificate/relative_corrections.h"

namespace exphoton {
namespace {

constexpr double kLeastWanted = .01 * .01;  // relMSE

double Part(const std::optional<SharingBias>& sharing) {
  return sharing ? std::max(sharing->squared, 0.) : 0;
}

// Returns how far a bound lies from the estimate, for two independent estimates that are added.
double Distance(double distance, const std::optional<SharingBias>& sharing, double quantile) {
  return std::hypot(distance, sharing ? quantile * sharing->standardError : 0);
}

// Returns the upper end of the squared bias where no gather ray was corrected. The gathers that
// need corrections, because their rays meet surfaces, are then an unknown share q of all gathers.
// None of them was chosen, which has the probability exp(-expected q). Their light may be as wrong
// as the picture is bright.
double UnseenBias(double expected, double quantile) {
  if (!(expected > 0)) return 0;
  return -std::log(std::erfc(quantile / std::numbers::sqrt2) / 2) / expected;
}

// Returns the interval for levels of the true picture that are known from corrections, from the
// intervals for the levels of the picture and for these. Corrections that noise may explain do not
// change a level, so the true bias may lie as far again from the estimate.
BlockBias BetweenLevels(const BlockBias& ofPicture, const BlockBias& ofTruth) {
  BlockBias bias = ofTruth;
  const double change = ofTruth.squared - ofPicture.squared;
  bias.lower = std::max(std::min(ofPicture.lower, ofTruth.lower + std::min(change, 0.)), 0.);
  bias.upper = std::max(ofPicture.upper, ofTruth.upper + std::max(change, 0.));
  bias.smallest = std::max(ofPicture.smallest, ofTruth.smallest);
  return bias;
}

// Larger errors have no digits.
constexpr double kMostShown = 10;
// A bias of this size is as large as the picture.
constexpr double kSaysNothing = 1;

std::string Percent(double squared) {
  const double error = BlockBias::Root(squared), percent = 100 * error;
  if (!(error <= kMostShown)) return Format("over %.0f %%", 100 * kMostShown);
  return Format(percent < .995 ? "%.2f %%" : percent < 99.5 ? "%.1f %%" : "%.0f %%", percent);
}

std::string Digits(double squared) {
  std::string text = Percent(squared);
  return text.substr(0, text.find(" %"));
}

}  // namespace

double Certificate::Bias() const { return std::max(bias.squared, 0.) + Part(sharing); }

double Certificate::LowerBias() const {
  const double distance = std::max(bias.squared, 0.) - bias.lower;
  return std::max(Bias() - Distance(distance, sharing, quantile), 0.);
}

double Certificate::UpperBias() const {
  return Bias() + Distance(bias.upper - std::max(bias.squared, 0.), sharing, quantile);
}

CertificateGoal CertificateGoal::ForNoise(double noise) {
  return {.smallest = std::max(noise / 4, kLeastWanted)};
}

std::optional<Certificate> Certify(const Corrections& corrections, std::span<const double> levels,
                                   double noise, const CertificateGoal& goal) {
  if (corrections.Groups().size() < 2) return std::nullopt;
  const RelativeCorrections relative(corrections);
  const BlockBias ofPicture = relative.To(levels, goal.quantile).EstimateFor(goal.smallest);
  const int width = ofPicture.blockWidth;
  const std::vector<double> trueLevels = relative.TrueLevels(levels, std::size_t(width));
  Certificate certificate;
  certificate.noise = noise;
  certificate.bias =
      BetweenLevels(ofPicture, relative.To(trueLevels, goal.quantile).Estimate(width));
  certificate.corrections = corrections.Count();
  const double unseen =
      certificate.corrections > 0 ? 0 : UnseenBias(corrections.ExpectedCount(), goal.quantile);
  certificate.bias.upper += unseen, certificate.bias.smallest += unseen;
  certificate.quantile = goal.quantile;
  return certificate;
}

bool Certificate::SaysNothing() const {
  return !(LowerBias() > 0) && !(UpperBias() < kSaysNothing);
}

std::string ErrorText(const Certificate& certificate) {
  if (certificate.SaysNothing())
    return "error unknown: noise " + Percent(certificate.noise) +
           ", and the bias may be as large as the picture";
  return "error " + Percent(certificate.Error()) + " = noise " + Percent(certificate.noise) +
         ", bias " + Percent(certificate.Bias()) + " (" + Digits(certificate.LowerBias()) + " to " +
         Percent(certificate.UpperBias()) + ")";
}

// The advice where the interval says nothing.
constexpr const char* kAdvice =
    "these corrections say nothing about the bias; more samples, a larger picture or a larger "
    "--certify-share do";

std::vector<std::string> DetailTexts(const Certificate& certificate) {
  const BlockBias& bias = certificate.bias;
  std::vector<std::string> texts{
      Format("bias of %d block%s of %d x %d pixels, from %s", bias.blocks,
             bias.blocks == 1 ? "" : "s", bias.width, bias.height,
             Counted(certificate.corrections, "corrected gather ray").c_str()),
      certificate.SaysNothing()
          ? kAdvice
          : "the interval (95 %) cannot certify a bias below " + Percent(bias.smallest)};
  if (certificate.sharing)
    texts.push_back("the bias includes " + Percent(certificate.sharing->squared) +
                    " by shared gathers");
  std::string notCovered = "not covered: how the bias varies inside a block";
  for (const std::string& text : certificate.notCovered) notCovered += "; " + text;
  texts.push_back(notCovered);
  return texts;
}

}  // namespace exphoton
