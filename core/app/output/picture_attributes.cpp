// SPDX-License-Identifier: BSD-2-Clause
// PictureAttributes makes the attributes of an EXR picture. The names follow pbrt-v4 and the
// OpenEXR standard.
#include <cmath>
#include <cstdlib>
#include <ctime>

#include "core/app/options/options.h"
#include "core/app/output/run_record.h"
#include "core/imaging/film/cryptomatte.h"

namespace exphoton::cli {
namespace {

// The meaning of the values of R, G and B. Spectrum has the primaries of Rec. 709 and the white
// point D65. The luminance takes values as W/(m^2 sr), with the luminous efficacy of white light
// that Radiance uses, in lm/W.
void AddColorMeaning(std::map<std::string, ImageAttribute>* attributes) {
  (*attributes)["chromaticities"] =
      std::vector<float>{.64f, .33f, .3f, .6f, .15f, .06f, .3127f, .329f};
  (*attributes)["whiteLuminance"] = 179.f;
}

void AddTimes(const RunRecord& run, std::map<std::string, ImageAttribute>* attributes) {
  const std::time_t now = std::time(nullptr);
  std::tm local{};
  localtime_r(&now, &local);
  char date[32];
  std::strftime(date, sizeof date, "%Y:%m:%d %H:%M:%S", &local);
  (*attributes)["capDate"] = std::string(date);
  (*attributes)["utcOffset"] = float(-local.tm_gmtoff);  // seconds to add to get UTC
  if (const char* user = std::getenv("USER")) (*attributes)["owner"] = std::string(user);
  (*attributes)["commandLine"] = run.commandLine;
  for (const Statistics::Phase& phase : run.statistics.Phases()) {
    (*attributes)["time/" + phase.name] = float(phase.wallSeconds);
    (*attributes)["cpuTime/" + phase.name] = float(phase.cpuSeconds);
  }
  (*attributes)["renderTimeSeconds"] = float(run.renderSeconds);
  (*attributes)["threads"] = run.threads;
  if (run.timeLimit) (*attributes)["timeLimit"] = float(*run.timeLimit);
}

// Errors are roots of parts of relMSE.
void AddCertificate(const Certificate& certificate,
                    std::map<std::string, ImageAttribute>* attributes) {
  const auto add = [attributes](const char* name, double squared) {
    (*attributes)[name] = float(BlockBias::Root(squared));
  };
  if (!certificate.SaysNothing()) {
    add("certificate/error", certificate.Error());
    add("certificate/bias", certificate.Bias());
  }
  add("certificate/noise", certificate.noise);
  add("certificate/biasLower", certificate.LowerBias());
  add("certificate/biasUpper", certificate.UpperBias());
  add("certificate/smallestBias", certificate.bias.smallest);
  (*attributes)["certificate/blockWidth"] = certificate.bias.blockWidth;
  (*attributes)["certificate/corrections"] = float(certificate.corrections);
  std::string text;
  for (const std::string& detail : DetailTexts(certificate))
    text += (text.empty() ? "" : ". ") + detail;
  (*attributes)["certificate/text"] = text;
}

void AddOmissions(const std::vector<OmittedEffect>& omitted,
                  std::map<std::string, ImageAttribute>* attributes) {
  std::string text;
  for (const OmittedEffect& effect : omitted) text += (text.empty() ? "" : "; ") + TextOf(effect);
  (*attributes)["accuracy/omitted"] = text;
  (*attributes)["accuracy/omittedBound"] = float(BoundOf(omitted));
}

}  // namespace

std::map<std::string, ImageAttribute> PictureAttributes(const RunRecord& run, bool isReproducible) {
  const SceneRecord& scene = run.scene;
  std::map<std::string, ImageAttribute> attributes;
  attributes["software"] = VersionText();
  attributes["scene"] = scene.name;
  attributes["sceneHash"] = HashText(scene.hash);
  attributes["integrator"] = scene.integrator;
  attributes["effects"] = scene.EffectNames();
  attributes["seed"] = std::to_string(run.seed);
  attributes["samplesPerPixel"] = int(run.samplesPerPixel);
  if (run.footprintSamples > 0) attributes["footprintSamplesPerPixel"] = int(run.footprintSamples);
  attributes["passes"] = run.passes;
  attributes["stoppedBy"] = run.stoppedBy;
  if (run.noise) attributes["noise"] = float(*run.noise);  // estimated noise part of relMSE
  if (run.sharingBias) {  // estimated squared bias of shared gathers, as a part of relMSE
    attributes["sharingBias"] = float(run.sharingBias->squared);
    attributes["sharingBiasError"] = float(run.sharingBias->standardError);
  }
  if (run.certificate) AddCertificate(*run.certificate, &attributes);
  if (run.targetError) attributes["targetError"] = float(*run.targetError);
  if (run.accuracy) attributes["accuracy/wanted"] = float(*run.accuracy);
  if (run.accuracy) attributes["accuracy/chosen"] = run.choice;
  if (!run.omitted.empty()) AddOmissions(run.omitted, &attributes);
  if (!run.unseen.empty()) attributes["accuracy/notCovered"] = run.unseen.front();
  if (run.upperError) attributes["accuracy/upperError"] = float(std::sqrt(*run.upperError));
  attributes["comments"] = std::string(run.isComplete ? "" : "incomplete: interrupted; ") +
                           "sampler " + scene.sampler + ", filter " + scene.filter + ", camera " +
                           scene.camera;
  AddColorMeaning(&attributes);
  attributes["expTime"] = scene.exposureTime;
  attributes["worldToCamera"] = scene.worldToCamera;
  attributes["worldToNDC"] = scene.worldToNdc;
  if (!isReproducible) AddTimes(run, &attributes);
  return attributes;
}

void FinishExr(const RunRecord& run, bool isReproducible, Image* image) {
  image->attributes = PictureAttributes(run, isReproducible);
  const SceneNames& names = run.scene.names;
  FinishCryptomatte(
      "CryptoObject", [&](std::uint32_t number) { return names.Object(number); },
      names.ObjectCount(), image);
  FinishCryptomatte(
      "CryptoMaterial", [&](std::uint32_t number) { return names.Material(number); },
      names.MaterialCount(), image);
}

}  // namespace exphoton::cli
