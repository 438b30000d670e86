// SPDX-License-Identifier: BSD-2-Clause
// This file parses the --effects option.
#include "core/parser/effect_choice.h"

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

#include "core/base/error.h"
#include "core/base/log.h"
#include "core/params/suggestions.h"

namespace exphoton {
namespace {

std::vector<std::string> EffectNames() {
  std::vector<std::string> names;
  for (int i = 0; i < kFeatureCount; ++i) names.emplace_back(FeatureName(Feature(i)));
  return names;
}

[[noreturn]] void FailChoice(const std::string& text, const std::string& hint = {}) {
  std::string known;
  for (const std::string& name : EffectNames()) known += (known.empty() ? "" : ", ") + name;
  throw Error(ExitStatus::CommandLine,
              "--effects: " + text + "; it takes auto, all or a list such as caustics=off of " +
                  known + (hint.empty() ? "" : "; " + hint));
}

// Describes how the picture changes if an effect that the scene needs is switched off.
std::string Loss(Feature feature) {
  switch (feature) {
    case Feature::Filtering:
      return "leaves textures unfiltered";
    case Feature::Lens:
      return "shows the scene through a pinhole";
    case Feature::Motion:
      return "shows the moment at which the shutter opens";
    default:
      return "leaves out light that the scene needs";
  }
}

// `given` has the effects of the items before this one.
void ApplyOne(const std::string& item, std::set<Feature>* given, RequiredFeatures* plan, Log& log) {
  const std::size_t equals = item.find('=');
  const std::string name = item.substr(0, equals);
  const std::string value = equals == std::string::npos ? "" : item.substr(equals + 1);
  const std::vector<std::string> names = EffectNames();
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) FailChoice("unknown effect \"" + name + "\"", DidYouMean(name, names));
  if (value != "on" && value != "off") FailChoice("\"" + item + "\" must end in =on or =off");
  const auto feature = Feature(found - names.begin());
  if (!given->insert(feature).second) FailChoice("\"" + name + "\" is given more than once");
  if (value == "off" && plan->Needs(feature))
    log.Warning("--effects " + item + " " + Loss(feature));
  plan->Set(feature, value == "on", "by --effects");
}

}  // namespace

RequiredFeatures ChooseEffects(RequiredFeatures plan, const std::string& choice, Log& log) {
  if (choice == "auto") return plan;
  std::set<Feature> given;
  for (std::size_t at = 0; at <= choice.size();) {
    const std::size_t end = std::min(choice.find(',', at), choice.size());
    const std::string item = choice.substr(at, end - at);
    if (item == "all" && at == 0) {
      RequiredFeatures all;
      all.notes = std::move(plan.notes);
      plan = std::move(all);
    } else {
      ApplyOne(item, &given, &plan, log);
    }
    at = end + 1;
  }
  return plan;
}

}  // namespace exphoton
