// SPDX-License-Identifier: BSD-2-Clause
#include "core/app/analysis/headline/lower_bound.h"

#include <algorithm>
#include <iterator>
#include <string_view>
#include <tuple>

#include "core/app/analysis/numbers.h"

namespace exphoton::study {
namespace {

constexpr const char* kPhotonIntegrators[] = {"exphotonmap", "photonmap"};

// Parameters on which the lower bound does not depend, or that it replaces. "time" and "passes" are
// words of studies. Parameters of the integrator may have its directive before them.
constexpr std::string_view kReplaced[] = {
    "spp",          "time",       "passes", "Sampler.pixelsamples", "finalgathersamples",
    "sharedgather", "edgesamples"};
constexpr std::string_view kDirective = "SurfaceIntegrator.";

bool IsReplaced(const Parameter& parameter) {
  std::string_view name = parameter.first;
  if (name.starts_with(kDirective)) name.remove_prefix(kDirective.size());
  return std::ranges::find(kReplaced, name) != std::end(kReplaced);
}

// Returns the contender's time in the headline or its details: to the headline's error, or to its
// own smallest error.
double SecondsOf(const Analysis& analysis, const Contender& contender) {
  const TimeToError time = analysis.target
                               ? contender.toTarget
                               : FindTimeToError(analysis.Points(contender.settings), 0);
  const bool isReached = time.kind != TimeToError::Kind::Never;
  return isReached ? time.seconds.value : time.best.seconds.value;
}

// Returns the contender of the integrator that reaches the headline's error in the shortest time.
// Without such an error, or if none reaches it, returns the one with the smallest error.
const Contender* ContenderOf(const Results& results, const Analysis& analysis,
                             const std::string& integrator) {
  const Contender* chosen = nullptr;
  const auto rank = [&](const Contender& contender) {
    const bool isReached = analysis.target && contender.toTarget.kind != TimeToError::Kind::Never;
    const auto best = FindTimeToError(analysis.Points(contender.settings), 0).best;
    return std::tuple(!isReached, isReached ? SecondsOf(analysis, contender) : best.error.value);
  };
  for (const Contender& contender : analysis.contenders) {
    const SettingResult& first = analysis.settings[contender.settings.front()];
    if (results.settings[first.setting].integrator != integrator ||
        ParetoFront(analysis.Points(contender.settings)).empty())
      continue;
    if (!chosen || rank(contender) < rank(*chosen)) chosen = &contender;
  }
  return chosen;
}

// Returns the last setting of the contender's front whose error is not below the headline's, or the
// first one if all are.
std::size_t SettingBeforeTarget(const Analysis& analysis, const Contender& contender) {
  const std::vector<CostPoint> points = analysis.Points(contender.settings);
  const std::vector<std::size_t> front = ParetoFront(points);
  std::size_t chosen = front.front();
  for (const std::size_t i : front)
    if (points[i].error.value >= analysis.target.value_or(0)) chosen = i;
  return contender.settings[chosen];
}

bool HasGatherRays(const Results& results, const SettingResult& setting) {
  return std::ranges::any_of(setting.runs, [&](std::size_t run) {
    return std::ranges::any_of(results.runs[run].rays, [](const auto& rays) {
      return rays.first == "gather" && rays.second > 0;
    });
  });
}

// Returns the contender that has the setting, an index of Results::settings, or null.
const Contender* ContenderWith(const Analysis& analysis, std::size_t setting) {
  const auto found = std::ranges::find_if(analysis.contenders, [&](const Contender& contender) {
    return std::ranges::any_of(
        contender.settings, [&](std::size_t i) { return analysis.settings[i].setting == setting; });
  });
  return found == analysis.contenders.end() ? nullptr : &*found;
}

}  // namespace

std::vector<std::size_t> SettingsForLowerBounds(const Results& results, const Analysis& analysis) {
  std::vector<std::size_t> settings;
  for (const char* integrator : kPhotonIntegrators) {
    const Contender* const contender = ContenderOf(results, analysis, integrator);
    if (!contender) continue;
    const SettingResult& chosen = analysis.settings[SettingBeforeTarget(analysis, *contender)];
    if (HasGatherRays(results, chosen)) settings.push_back(chosen.setting);
  }
  return settings;
}

Setting LowerBoundSetting(const Setting& setting) {
  Setting bound = setting;
  std::erase_if(bound.parameters, IsReplaced);
  bound.parameters.insert(
      bound.parameters.end(),
      {{"spp", "1"}, {"finalgathersamples", "1"}, {"sharedgather", "false"}, {"edgesamples", "1"}});
  return bound;
}

std::vector<Setting> ExpectedLowerBounds(const std::vector<Setting>& plan) {
  std::vector<Setting> bounds;
  for (const std::string integrator : kPhotonIntegrators) {
    const auto found = std::ranges::find_if(plan, [&](const Setting& setting) {
      const std::string* const gathers = setting.Find("finalgather");
      return setting.integrator == integrator && !setting.Find("show") &&
             !(gathers && *gathers == "false");
    });
    if (found != plan.end()) bounds.push_back(LowerBoundSetting(*found));
  }
  return bounds;
}

std::string LowerBoundText(const Results& results, const Analysis& analysis) {
  std::string text;
  for (const LowerBound& bound : results.lowerBounds) {
    const Contender* const contender = ContenderWith(analysis, bound.setting);
    const double least = bound.Seconds(results.clock);
    if (!contender || !(least > 0)) continue;
    const double seconds = SecondsOf(analysis, *contender);
    if (!(seconds > 0)) continue;
    const bool isFirst = text.empty();
    text += (isFirst ? "" : ", ") + contender->name + (isFirst ? " takes " : " ") +
            ShortNumber(seconds / least) + " times " + (isFirst ? "the lower bound" : "its own") +
            " of " + SecondsText(least);
  }
  // The details of a single contender give the time to its smallest error only.
  if (!text.empty() && analysis.target && analysis.contenders.size() == 1)
    text = std::string("To ") + (analysis.hasReference ? "relMSE " : "noise ") +
           ShortNumber(*analysis.target) + ", " + text;
  return text.empty() ? "" : text + ".";
}

}  // namespace exphoton::study
