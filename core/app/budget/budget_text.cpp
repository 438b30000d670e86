// SPDX-License-Identifier: BSD-2-Clause
#include "core/app/budget/budget_text.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/app/analysis/numbers.h"
#include "core/base/format.h"
#include "core/base/terminal.h"
#include "core/imaging/metrics/noise_test.h"

namespace exphoton::cli {
namespace {

constexpr int kColumns = 100;       // of a line
constexpr int kHalvingColumn = 51;  // where the last column begins
constexpr const char* kSumName = "sum of the parts";

// Returns the quantile of Student's distribution for a two-sided interval of 95 %.
double StudentQuantile95(int degrees) {
  double low = 0, high = 1e3;
  for (int step = 0; step < 60; ++step) {
    const double middle = (low + high) / 2;
    (StudentTail(middle, degrees) > .05 ? low : high) = middle;
  }
  return high;
}

struct Halving {
  double seconds = 0;
  const char* how = "";
};

// Bias is inversely proportional to the number of photons.
double ForMorePhotons(const ErrorPart& part, double mapSeconds) {
  const double factor = HalvingFactor(part);
  return factor > 0 ? mapSeconds * (1 / factor - 1) : 0;
}

Halving HalvingOf(const ErrorPart& part, const BudgetCosts& costs) {
  switch (part.cause) {
    case ErrorCause::CameraSampling:
      return {costs.camera, "twice the samples with half the gather rays each"};
    case ErrorCause::GatherDirections:
      return {costs.rays, "twice the gather rays"};
    case ErrorCause::PhotonNoise:
      return {costs.maps, "twice the photons at the same radii"};
    case ErrorCause::Blur:
      return {ForMorePhotons(part, costs.maps), "more photons"};
    case ErrorCause::CausticKernel:
      return {ForMorePhotons(part, costs.causticMap), "more caustic photons"};
    case ErrorCause::Sharing:
      return {costs.sharing, "all of it: no sharing, and more samples for the same noise"};
    case ErrorCause::DepthLimits:
      return {costs.depth, "all of it: a larger maxdepth"};
    case ErrorCause::SkippedEffects:
      return {costs.effects, "all of it: --effects all"};
  }
  return {};
}

// Returns the decimals that show this number of digits.
int DecimalsOf(double number, int digits) {
  if (!(number > 0) || !std::isfinite(number)) return 0;
  return std::clamp(digits - 1 - int(std::floor(std::log10(number))), 1, 12);
}

// Writes a number with these decimals. What rounds to 0 has no sign.
std::string Fixed(double number, int decimals) {
  const std::string text = Format("%.*f", decimals, number);
  const bool isZero = text.find_first_not_of("-0.") == std::string::npos;
  return isZero && text.front() == '-' ? text.substr(1) : text;
}

// Writes numbers with the decimals that show three digits of the sum and two of the half-width, but
// at most two decimals more than the sum.
class Numbers {
 public:
  Numbers(double sum, int seeds)
      : decimals_(std::max(DecimalsOf(sum, 3), 1)),
        quantile_(StudentQuantile95(std::max(seeds - 1, 1))) {}

  BudgetRow Row(const std::string& name, const study::Measured& measured) const {
    const double halfWidth = HalfWidth(measured);
    const int decimals = std::clamp(DecimalsOf(halfWidth, 2), decimals_, decimals_ + 2);
    return {name, Fixed(measured.value, decimals), Fixed(halfWidth, decimals), "", ""};
  }
  double HalfWidth(const study::Measured& measured) const { return quantile_ * measured.error; }

 private:
  int decimals_;
  double quantile_;
};

BudgetRow PartRow(const ErrorPart& part, const MeasuredBudget& measured, const Numbers& numbers) {
  BudgetRow row = numbers.Row(ErrorCauseName(part.cause), part.share);
  const double sum = measured.budget.sum.value;
  const double percent = sum > 0 ? std::round(100 * part.share.value / sum) : 0;
  row.share = Fixed(percent, 0) + " %";
  const Halving halving = HalvingOf(part, measured.costs);
  const bool isKnown = std::abs(part.share.value) > numbers.HalfWidth(part.share);
  if (!isKnown || (part.share.value < 0 && part.cause <= ErrorCause::PhotonNoise))
    row.halving = "not distinct from 0";
  else if (part.share.value < 0)
    row.halving = "reduces the other biases";
  else
    row.halving =
        "+" + study::SecondsText(halving.seconds > 1e-9 ? halving.seconds : 0) + ": " + halving.how;
  return row;
}

// Returns why a cause has no part.
const char* AbsenceOf(ErrorCause cause) {
  switch (cause) {
    case ErrorCause::GatherDirections:
      return "no gather rays";
    case ErrorCause::CausticKernel:
      return "no caustic photons";
    case ErrorCause::Sharing:
      return "gathers are not shared";
    case ErrorCause::DepthLimits:
      return "no path was cut";
    case ErrorCause::SkippedEffects:
      return "only effects that are provably nothing are skipped";
    default:
      return "";
  }
}

study::Measured Minus(const study::Measured& a, const study::Measured& b) {
  return {a.value - b.value, std::hypot(a.error, b.error)};
}

double Percentage(double relMse) { return 100 * std::sqrt(std::max(relMse, 0.)); }

std::string CellOf(const std::string& text, std::size_t width) {
  return std::string(text.size() < width ? width - text.size() : 0, ' ') + text;
}

}  // namespace

std::vector<BudgetRow> BudgetRows(const MeasuredBudget& measured, int seeds) {
  const ErrorBudget& budget = measured.budget;
  const Numbers numbers(budget.sum.value, seeds);
  std::vector<BudgetRow> rows;
  std::size_t at = 0;
  for (int cause = 0; cause < kErrorCauseCount; ++cause) {
    if (at < budget.parts.size() && budget.parts[at].cause == ErrorCause(cause))
      rows.push_back(PartRow(budget.parts[at++], measured, numbers));
    else
      rows.push_back(
          {ErrorCauseName(ErrorCause(cause)), "0", "", "", AbsenceOf(ErrorCause(cause))});
  }
  rows.push_back(numbers.Row(kSumName, budget.sum));
  rows.back().share = "100 %";
  rows.push_back(numbers.Row("measured", measured.measured.sum));
  rows.push_back(numbers.Row("difference", Minus(budget.sum, measured.measured.sum)));
  return rows;
}

std::string BudgetHeadline(const MeasuredBudget& budget) {
  const BudgetCosts& costs = budget.costs;
  return Format("error %.2g %% = noise %.2g %%, bias %.2g %%; ",
                Percentage(budget.budget.sum.value), Percentage(budget.budget.noise.value),
                Percentage(budget.budget.bias.value)) +
         study::SecondsText(costs.Total()) + " of CPU time, " +
         Format("%.2g times the lower bound of ", costs.Total() / costs.lowerBound) +
         study::SecondsText(costs.lowerBound);
}

std::vector<std::string> BudgetNotes(const MeasuredBudget& budget, const BudgetOptions& options) {
  std::vector<std::string> notes;
  notes.push_back("relMSE of one render; \u00b1 is half of a 95 % interval, from " +
                  std::to_string(options.seeds) + " seeds");
  const std::string blocks = std::to_string(budget.budget.blockWidth) + " x " +
                             std::to_string(budget.budget.blockWidth) + " pixels";
  notes.push_back("biases are those of means over blocks of " + blocks);
  if (budget.isByReference) {
    notes.push_back("measured with other seeds against guidedpath with " +
                    Counted(options.referenceSamples, "sample") + " a pixel");
    const study::Measured& inside = budget.measured.insideBlocks;
    if (budget.budget.blockWidth > 1)
      notes.push_back(
          Format("bias that varies inside the blocks, which is in no part: %.2g \u00b1 ",
                 inside.value) +
          Format("%.1g", StudentQuantile95(options.seeds - 1) * inside.error));
  } else {
    notes.push_back(
        "measured with other seeds by the certificate (--certify), which does not see depth limits "
        "and "
        "skipped effects");
  }
  notes.push_back(
      "the lower bound is the time of the photon maps, one camera sample and one gather ray a "
      "pixel");
  return notes;
}

std::string BudgetText(const std::string& scene, const MeasuredBudget& budget,
                       const BudgetOptions& options) {
  const std::string settings = Format("%d x %d pixels, ", budget.width, budget.height) +
                               Counted(budget.samples, "sample") + " a pixel, " +
                               budget.integrator + "\n";
  const bool fits = scene.size() + settings.size() < std::size_t(kColumns);
  std::string text = scene + (fits ? ", " : ",\n") + settings +
                     WrappedText(BudgetHeadline(budget), 0, kColumns) + "\n";
  text += "  cause                 relMSE          \u00b1   share  half of it for (CPU time)\n";
  for (const BudgetRow& row : BudgetRows(budget, options.seeds)) {
    if (row.name == kSumName) text += "\n";
    std::string line =
        "  " + row.name + std::string(18 - std::min<std::size_t>(row.name.size(), 18), ' ') +
        CellOf(row.value, 10) + CellOf(row.halfWidth, 11) + CellOf(row.share, 8) + "  ";
    if (!row.halving.empty())
      line += WrappedText(row.halving, kHalvingColumn, kColumns).substr(kHalvingColumn);
    line.erase(line.find_last_not_of(" \n") + 1);
    text += line + "\n";
  }
  text += "\n";
  for (const std::string& note : BudgetNotes(budget, options))
    text += WrappedText(note, 0, kColumns);
  return text;
}

}  // namespace exphoton::cli
