// SPDX-License-Identifier: BSD-2-Clause
// StateIdentity: settings have the names of their options, so that messages can name them.
#include "core/app/identity/state_identity.h"

#include <array>
#include <charconv>
#include <map>
#include <optional>

#include "core/app/output/picture.h"
#include "core/base/error.h"
#include "core/base/format.h"

namespace exphoton::cli {
namespace {

constexpr const char* kPhotons = "the factor of photons for --accuracy";
constexpr const char* kGivenUp = "the picture that --accuracy gave up";
constexpr const char* kFirstSamples = "the samples of a group for --accuracy";

// As few digits as give the same number.
std::string Text(double value) {
  char text[32];
  return std::string(text, std::to_chars(text, text + sizeof text, value).ptr);
}

// Returns false if the text is no number.
template <class Number>
bool ReadNumber(const std::string& text, Number* value) {
  const char* const end = text.data() + text.size();
  const auto [at, error] = std::from_chars(text.data(), end, *value);
  return error == std::errc() && at == end;
}

std::string Text(const PixelBounds& bounds) {
  std::string text;
  for (const int edge : {bounds.x0, bounds.x1, bounds.y0, bounds.y1})
    text += (text.empty() ? "" : ",") + std::to_string(edge);
  return text;
}

}  // namespace

StateIdentity::StateIdentity(const RenderCommand& command, const RenderSetup& setup)
    : program_(VersionText()) {
  inputs_.push_back({setup.sceneName, setup.sceneHash});
  for (InputHash& input : HashesOfInputs(setup)) inputs_.push_back(std::move(input));

  const LoadOptions& load = command.load;
  const auto add = [this](const char* name, const std::string& value) { Add(name, value); };
  add("the size",
      std::to_string(setup.film.xResolution) + "x" + std::to_string(setup.film.yResolution));
  add("the part in pixels", Text(setup.crop));
  add("--integrator", setup.integratorName);
  add("--sampler", setup.samplerName);
  add("--filter", setup.filterName);
  add("--camera", setup.cameraName);
  add("--accelerator", setup.acceleratorName);
  const bool hasSamples = load.samplesPerPixel && !command.dial;
  add("--spp", hasSamples ? std::to_string(*load.samplesPerPixel) : "");
  add("--seed", std::to_string(command.seed));
  add("--footprint-spp", std::to_string(command.footprintSamples));
  add("the time of the frame", Text(load.timeOffset));
  add("--quick", load.isQuick ? "on" : "off");
  add("--effects", load.effects);
  add("--photons", command.photonFile.empty() ? "" : "on");
  add("--dialect", !load.dialect ? "auto" : *load.dialect == Dialect::V2 ? "v2" : "v1");
  add("--aov", AovNames(command));
  add("--two-halves", command.asTwoHalves ? "on" : "off");
  add("--certify", command.certifies ? "on" : "off");
  if (command.certifies) add("--certify-share", Text(command.certifiedShare));
  if (command.accuracy) AddAccuracy(command);
  add("--target-error", command.targetError ? Text(*command.targetError) : "");
  add("--max-passes", command.maxPasses > 0 ? std::to_string(command.maxPasses) : "");
  add("--progressive", command.isProgressive ? "on" : "off");
  add("--progressive-alpha", command.isProgressive ? Text(command.progressiveAlpha) : "");
  add("--time-limit", command.timeLimit ? "on" : "off");  // more time may be given
  std::map<std::string, std::string> sets;
  for (const ParameterOverride& set : load.parameters)
    if (set.directive != "Film" || set.parameter != "filename")
      sets["--set " + set.directive + "." + set.parameter] = set.value;
  for (const auto& [name, value] : sets) add(name.c_str(), value);
}

void StateIdentity::Add(const std::string& name, const std::string& value) {
  settings_.push_back({name, value});
}

void StateIdentity::AddAccuracy(const RenderCommand& command) {
  Add("--accuracy", Format("%.12g%%", 100 * *command.accuracy));
  Add("--keep", command.keepsSettings ? "on" : "off");
  if (!command.dial) return;
  const DialChoice& dial = *command.dial;
  std::string omitted;
  for (const OmittedEffect& effect : dial.omitted)
    omitted += (omitted.empty() ? "" : ", ") + effect.name + " " + Text(effect.bound);
  Add("the effects that --accuracy leaves out", omitted);
  Add("the price of photons for --accuracy", Text(dial.photonSamples));
  Add("the share of the bias for --accuracy", Text(dial.biasShare));
  for (const GivenUp& picture : command.givenUp)
    Add(kGivenUp, picture.integrator + " " + Text(picture.samples));
  Add(kPhotons, Text(dial.settings.photons));
  Add(kFirstSamples, std::to_string(dial.firstSamples));
}

std::optional<LaterChoice> StateIdentity::Choice() const {
  LaterChoice choice;
  int found = 0;
  for (const Setting& setting : settings_) {
    if (setting.name == kPhotons) found += ReadNumber(setting.value, &choice.photons);
    if (setting.name == kFirstSamples) found += ReadNumber(setting.value, &choice.firstSamples);
    if (setting.name != kGivenUp) continue;
    const std::size_t space = setting.value.find(' ');
    if (space == std::string::npos) return std::nullopt;
    GivenUp& picture = choice.givenUp.emplace_back();
    picture.integrator = setting.value.substr(0, space);
    if (!ReadNumber(setting.value.substr(space + 1), &picture.samples)) return std::nullopt;
  }
  return found == 2 ? std::optional(choice) : std::nullopt;
}

void StateIdentity::Transfer(ByteArchive* archive) {
  archive->Text(&program_);
  inputs_.resize(archive->Count(inputs_.size(), 16));
  for (InputHash& input : inputs_) {
    archive->Text(&input.name);
    archive->Values(&input.hash);
  }
  settings_.resize(archive->Count(settings_.size(), 16));
  for (Setting& setting : settings_) {
    archive->Text(&setting.name);
    archive->Text(&setting.value);
  }
}

void StateIdentity::Save(StateWriter* writer) const {
  writer->AddArchive("identity",
                     [this](ByteArchive* archive) { StateIdentity(*this).Transfer(archive); });
}

// `other` is the identity in the file.
std::string StateIdentity::Differences(const StateIdentity& other) const {
  if (other.program_ != program_) return "it is by " + other.program_ + ", this is " + program_;
  if (other.inputs_.empty()) return "it names no scene";
  const InputHash& scene = inputs_.front();
  const InputHash& otherScene = other.inputs_.front();
  if (otherScene.hash != scene.hash && otherScene.name != scene.name)
    return "it is of another scene: \"" + otherScene.name + "\" there, \"" + scene.name + "\" here";
  if (otherScene.hash != scene.hash) return "the scene \"" + scene.name + "\" has changed since";
  std::string texts;
  const auto add = [&texts](const std::string& text) {
    texts += (texts.empty() ? "" : "; ") + text;
  };
  if (other.inputs_.size() != inputs_.size()) add("the scene's files are not the same");
  for (std::size_t i = 1; i < std::min(inputs_.size(), other.inputs_.size()); ++i)
    if (inputs_[i].hash != other.inputs_[i].hash)
      add("the file \"" + inputs_[i].name + "\" has changed since");
  std::map<std::string, std::array<std::string, 2>> values;
  for (const Setting& setting : other.settings_) values[setting.name][0] = setting.value;
  for (const Setting& setting : settings_) values[setting.name][1] = setting.value;
  const auto shown = [](const std::string& value) {
    return value.empty() ? std::string("not given") : value;
  };
  for (const auto& [name, both] : values)
    if (both[0] != both[1])
      add(name + " is " + shown(both[0]) + " there, " + shown(both[1]) + " here");
  return texts;
}

StateIdentity StateIdentity::Of(const StateFile& file) {
  StateIdentity identity;
  file.Read("identity", [&identity](ByteArchive* archive) { identity.Transfer(archive); });
  return identity;
}

void StateIdentity::Check(const StateFile& file) const {
  const std::string differences = Differences(Of(file));
  if (differences.empty()) return;
  throw Error(ExitStatus::CommandLine,
              "cannot continue from \"" + file.Path() + "\": " + differences, {},
              "repeat the command of the stopped render with --resume, or leave --resume out to "
              "start from the beginning");
}

}  // namespace exphoton::cli
