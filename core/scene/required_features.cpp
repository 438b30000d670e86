// SPDX-License-Identifier: BSD-2-Clause
// RequiredFeatures and the rules that set it: a feature is off only if its contribution to this
// scene is provably zero.
#include "core/scene/required_features.h"

#include <algorithm>
#include <sstream>

#include "core/imaging/film/camera.h"
#include "core/scene/scene.h"

namespace exphoton {
namespace {

constexpr std::array<const char*, kFeatureCount> kFeatureNames{
    "caustics", "indirect",  "transmission", "specular", "glossy",
    "media",    "filtering", "lens",         "motion",   "environment",
};

// The reasons for features that the integrator leaves out.
constexpr std::array<const char*, kFeatureCount> kNotComputed{
    "this integrator does not compute caustics",
    "this integrator does not compute indirect light",
    "this integrator has no radiance photons",
    "this integrator does not follow mirrors and glass",
    "this integrator has no gather rays that read radiance photons",
    "this integrator ignores participating media",
    "this integrator evaluates no textures",
    "this integrator ignores the lens",
    "this integrator ignores motion",
    "this integrator does not show the sky",
};

constexpr Interval kAlways{-kInfinity, kInfinity};

// The properties of a scene that the rules depend on.
struct SceneTraits {
  LobeSet lobes;  // union over all surfaces
  bool needsDifferentials;
  int lights, shiningLights;
  bool mediaEmit = false;  // true if any medium emits or may emit

  explicit SceneTraits(const Scene& scene)
      : lobes(scene.Primitives().PossibleLobes()),
        needsDifferentials(scene.Primitives().NeedsDifferentials()),
        lights(int(scene.Lights().size())),
        shiningLights(scene.NonBlackLightCount()) {
    for (const auto& medium : scene.Media()) mediaEmit = mediaEmit || medium->Emits();
  }
  bool Has(LobeSet mask) const { return Intersects(lobes, mask); }
};

std::string LightsNote(const SceneTraits& traits) {
  std::string note = "lights        " + std::to_string(traits.lights);
  const int black = traits.lights - traits.shiningLights;
  if (black > 0) note += " (" + std::to_string(black) + " black, skipped)";
  return note;
}

void PlanPhotons(const SceneTraits& traits, RequiredFeatures* plan) {
  const bool hasLights = traits.shiningLights > 0;
  const bool isLit = hasLights || traits.mediaEmit;
  const bool hasSpecular = traits.Has(LobeSet::Specular);
  const bool hasReceiver = traits.Has(LobeSet::NonSpecular);
  const std::string noReceiver =
      Any(traits.lobes) ? "every surface is specular" : "no surface scatters light";
  // Light from media over specular surfaces counts as indirect light, so media alone need no
  // caustics.
  plan->Set(Feature::Caustics, hasLights && hasSpecular && hasReceiver,
            !hasLights     ? "no light"
            : !hasSpecular ? "no specular surface"
            : !hasReceiver ? noReceiver
                           : "a specular surface and a receiver");
  plan->Set(Feature::Indirect, isLit && hasReceiver,
            !isLit         ? "no light"
            : !hasReceiver ? noReceiver
                           : "a surface that scatters light");
  const bool transmits = isLit && traits.Has(LobeSet::NonSpecularTransmission);
  plan->Set(Feature::Transmission, transmits,
            transmits ? "a translucent surface"
            : isLit   ? "no translucent surface"
                      : "no light");
  plan->Set(Feature::Specular, hasSpecular,
            hasSpecular ? "a specular surface" : "no specular surface");
  const bool hasGlossy = traits.Has(LobeSet::Glossy);
  plan->Set(Feature::Glossy, isLit && hasGlossy,
            !isLit       ? "no light"
            : !hasGlossy ? "no glossy surface"
                         : "a glossy surface that gather rays may meet");
}

// Media whose coefficients are provably 0 need neither ray marching nor transmittance.
void PlanMedia(const Scene& scene, RequiredFeatures* plan) {
  const bool hasMedia =
      std::ranges::any_of(scene.Media(), [](const auto& m) { return !m->IsProvablyEmpty(); });
  const bool hasNone = scene.Media().empty() && !scene.HadEmptyMedia();
  plan->Set(Feature::Media, hasMedia,
            hasMedia  ? "a participating medium"
            : hasNone ? "no participating medium"
                      : "no medium absorbs, scatters or emits light");
}

// Motion is needed if the camera or a shape moves while the shutter is open.
void PlanMotion(const Scene& scene, const Camera& camera, RequiredFeatures* plan) {
  const Interval shutter = camera.Shutter();
  const bool isCamera = camera.MovesWithin(shutter);
  const bool isShape = scene.Primitives().MovesWithin(shutter);
  const bool movesEver = camera.MovesWithin(kAlways) || scene.Primitives().MovesWithin(kAlways);
  const bool isOpen = shutter.min < shutter.max;
  plan->Set(Feature::Motion, isCamera || isShape,
            isCamera && isShape ? "the camera and a shape move"
            : isCamera          ? "the camera moves"
            : isShape           ? "a shape moves"
            : !isOpen           ? "shutter closed"
            : movesEver         ? "nothing moves while the shutter is open"
                                : "nothing moves");
}

}  // namespace

void NoteTimes(const Scene& scene, const Camera& camera, RequiredFeatures* plan) {
  if (!camera.MovesWithin(kAlways) && !scene.Primitives().MovesWithin(kAlways)) return;
  const Interval shutter = camera.Shutter();
  std::ostringstream note;
  note << "time          " << shutter.min;
  if (plan->Needs(Feature::Motion)) note << " to " << shutter.max;
  note << " (of camera rays and photons)";
  plan->notes.push_back(note.str());
}

const char* FeatureName(Feature feature) { return kFeatureNames[std::size_t(feature)]; }

RequiredFeatures::RequiredFeatures() {
  for (Row& row : rows_) row = {true, "asked for"};
}

void RequiredFeatures::Set(Feature feature, bool on, std::string reason) {
  rows_[std::size_t(feature)] = {on, std::move(reason)};
}

void RequiredFeatures::KeepComputed(FeatureSet computed) {
  for (int i = 0; i < kFeatureCount; ++i) {
    Row& row = rows_[std::size_t(i)];
    if (row.on && !computed.Has(Feature(i))) row = {false, kNotComputed[std::size_t(i)]};
  }
}

std::string RequiredFeatures::Describe() const {
  std::string text;
  for (int i = 0; i < kFeatureCount; ++i) {
    std::string line = kFeatureNames[std::size_t(i)];
    line.resize(std::max<std::size_t>(line.size() + 1, 14), ' ');
    const Row& row = rows_[std::size_t(i)];
    text += line + (row.on ? "on   " : "off  ") + row.reason + "\n";
  }
  for (const std::string& note : notes) text += note + "\n";
  return text;
}

RequiredFeatures FindRequiredFeatures(const Scene& scene, const Camera& camera) {
  const SceneTraits traits(scene);
  RequiredFeatures plan;
  PlanPhotons(traits, &plan);
  PlanMedia(scene, &plan);
  plan.Set(Feature::Filtering, traits.needsDifferentials,
           traits.needsDifferentials ? "a filtered texture or bump map"
                                     : "no filtered texture and no bump map");
  plan.Set(Feature::Lens, camera.HasLens(),
           camera.HasLens() ? "lens radius > 0" : "pinhole camera");
  PlanMotion(scene, camera, &plan);
  const bool hasSky = !scene.InfiniteLights().empty();
  plan.Set(Feature::Environment, hasSky, hasSky ? "an infinite light" : "no infinite light");
  plan.notes.push_back(LightsNote(traits));
  return plan;
}

}  // namespace exphoton
