// SPDX-License-Identifier: BSD-2-Clause
// StateIdentity: settings have the names of their options, so that messages can name them.
#include "core/app/identity/state_identity.h"

#include <array>
#include <charconv>
#include <map>
#include <optional>

#include "core/app/output/picture.h"
#include "core/base/error.h"

namespace exphoton::cli {
namespace {

// As few digits as give the same number.
std::string Text(double value) {
  char text[32];
  return std::string(text, std::to_chars(text, text + sizeof text, value).ptr);
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
  const auto add = [this](const char* name, const std::string& value) {
    settings_.push_back({name, value});
  };
  add("the size",
      std::to_string(setup.film.xResolution) + "x" + std::to_string(setup.film.yResolution));
  add("the part in pixels", Text(setup.crop));
  add("--integrator", setup.integratorName);
  add("--sampler", setup.samplerName);
  add("--filter", setup.filterName);
  add("--camera", setup.cameraName);
  add("--accelerator", setup.acceleratorName);
  add("--spp", load.samplesPerPixel ? std::to_string(*load.samplesPerPixel) : "");
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
  ByteArchive archive;
  StateIdentity(*this).Transfer(&archive);
  writer->Add("identity", archive.Take());
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
