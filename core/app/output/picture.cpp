// SPDX-License-Identifier: BSD-2-Clause
// RenderPicture renders into films, and MakeImage converts films to an image.
#include "core/app/output/picture.h"

#include <algorithm>

#include "core/base/error.h"
#include "core/base/format.h"
#include "core/render/passes/render_halves.h"

namespace exphoton::cli {
namespace {

constexpr const char* kHalfNames[2] = {"half1", "half2"};

// The picture may begin again unless the time or the passes are limited.
StoppingRule::Accuracy RuleOf(double error, const RenderCommand& command) {
  const DialChoice& dial = *command.dial;
  StoppingRule::Accuracy accuracy;
  accuracy.error = error;
  accuracy.firstSamples = dial.firstSamples;
  accuracy.biasShare = dial.biasShare;
  accuracy.photonSamples = dial.photonSamples;
  accuracy.omitted = BoundOf(dial.omitted);
  accuracy.mayStopSharing = !command.keepsSettings;
  accuracy.expectedSamples = dial.expectedSamples;
  accuracy.earlierLooks = dial.earlierLooks;
  accuracy.sharesApart = command.maxPasses > 0;
  if (command.timeLimit || command.maxPasses > 0) return accuracy;
  accuracy.stopsForLikelyBias = dial.mayRaisePhotons;
  accuracy.rivalSamples = dial.rivalSamples;
  return accuracy;
}

PassesResult RenderFixed(const RenderJob& job, const RenderOptions& options) {
  PassesResult result;
  result.render = Render(job, options);
  result.passes = 1;
  result.samplesPerPixel = job.sampler.SamplesPerPixel();
  if (!result.render.isComplete) result.reason = StopReason::Signal;
  return result;
}

// Uses the variance between passes instead of the sample variance. Each pass has its own photon
// maps, so the variance between passes includes the noise of the photons.
void ReplaceVariance(const std::vector<float>& variances, const Film& film, bool premultiplyAlpha,
                     Image* image) {
  const int channel = image->FindChannel("variance.R");
  if (channel < 0 || variances.empty()) return;
  const PixelBounds& crop = film.Crop();
  std::size_t at = 0;
  for (int y = 0; y < crop.Height(); ++y) {
    for (int x = 0; x < crop.Width(); ++x) {
      const double alpha = film.MeanOf({crop.x0 + x, crop.y0 + y})[3];
      const double scale = premultiplyAlpha ? std::clamp(alpha, 0., 1.) : 1;
      for (int c = 0; c < 3; ++c)
        image->At(x, y, channel + c) = float(double(variances[at++]) * scale * scale);
    }
  }
}

void AppendHalf(const char* name, const Film& half, bool premultiplyAlpha, Image* image) {
  const Image picture = half.ToImage(premultiplyAlpha);
  std::vector<std::string> names;
  std::vector<float> values;
  for (int c = 0; c < 3; ++c)
    names.push_back(std::string(name) + "." + picture.channels[std::size_t(c)]);
  for (std::size_t i = 0; i < picture.pixels.size(); ++i)
    if (i % 4 != 3) values.push_back(picture.pixels[i]);
  AppendChannels(names, values, image);
}

}  // namespace

PictureFilms::PictureFilms(const RenderCommand& command, const RenderSetup& setup)
    : PictureFilms(setup.film.Full(), setup.crop, command.aovs, command.RendersTwoHalves()) {
  writesHalves = command.asTwoHalves;
  if (command.certifies)
    corrections = std::make_unique<Corrections>(setup.crop, command.certifiedShare);
}

PictureFilms::PictureFilms(const PixelBounds& full, const PixelBounds& crop, AovSet wanted,
                           bool asTwoHalves)
    : film(full, crop) {
  if (!wanted.IsEmpty()) aovs = std::make_unique<AovFilm>(crop, wanted);
  if (!asTwoHalves) return;
  for (auto& half : halves) half = std::make_unique<Film>(full, crop);
}

PassesResult RenderPicture(const RenderCommand& command, const RenderJob& job,
                           const RenderOptions& options,
                           std::chrono::steady_clock::time_point start, PictureFilms* films) {
  if (command.RendersTwoHalves())
    return RenderTwoHalves(job, options, films->halves[0].get(), films->halves[1].get());
  if (!command.HasStoppingRule()) return RenderFixed(job, options);
  StoppingRule rule;
  rule.targetError = command.targetError;
  rule.timeLimit = command.timeLimit;
  rule.start = start;
  if (command.load.samplesPerPixel) rule.maxSamples = *command.load.samplesPerPixel;
  if (command.dial) rule.maxSamples = command.dial->mostSamples;
  if (command.maxPasses > 0 || command.isProgressive) {
    rule.passSamples = job.sampler.SamplesPerPixel();
    rule.maxSamples =
        command.maxPasses > 0 ? rule.passSamples * command.maxPasses : StoppingRule::kMaxSamples;
  }
  if (command.isProgressive) rule.progressiveAlpha = command.progressiveAlpha;
  if (command.accuracy) rule.accuracy = RuleOf(*command.accuracy, command);
  return RenderInPasses(job, options, rule);
}

std::vector<std::string> NotCovered(const RenderSetup& setup, std::int64_t footprintSamples) {
  std::vector<std::string> phrases;
  if (const auto limits = setup.integrator->Certification(*setup.scene))
    phrases = limits->notCovered;
  if (setup.scene->Features().Needs(Feature::Filtering))
    phrases.push_back("the blur of textures and bumps, which are filtered for " +
                      Counted(footprintSamples, "sample") + " a pixel (--footprint-spp)");
  return phrases;
}

std::optional<Certificate> CertificateOf(const PictureFilms& films, const PassesResult& result,
                                         std::vector<std::string> notCovered) {
  if (!films.corrections || !result.noise) return std::nullopt;
  std::optional<Certificate> certificate = Certify(*films.corrections, result.levels, *result.noise,
                                                   CertificateGoal::ForNoise(*result.noise));
  if (!certificate) return certificate;
  certificate->sharing = result.render.sharingBias;
  certificate->notCovered = std::move(notCovered);
  return certificate;
}

std::vector<std::string> UnseenLight(const RenderCommand& command, const RenderSetup& setup) {
  std::vector<std::string> lights;
  if (command.accuracy) lights = setup.integrator->UnseenLight(*setup.scene);
  if (command.dial && command.dial->lackingShare > 0)
    lights.push_back(Format("about %.0f %% of the light that exphotonmap finds",
                            100 * command.dial->lackingShare));
  return lights;
}

void WarnOfUnseenLight(const std::vector<std::string>& lights, const std::string& integrator,
                       Log& log) {
  for (const std::string& light : lights)
    log.Warning("the error does not contain " + light + ", because integrator \"" + integrator +
                    "\" does not find this light",
                {}, "--integrator exphotonmap finds this light");
}

void ReportCertificate(const std::optional<Certificate>& certificate, Log& log) {
  if (!certificate)
    return log.Notice(
        "no certificate, because fewer than two independent groups of passes are complete");
  log.Notice(ErrorText(*certificate));
  for (const std::string& text : DetailTexts(*certificate)) log.Notice(text);
}

void CheckIntegrator(const RenderCommand& command, const RenderSetup& setup) {
  if (command.isProgressive && !setup.integrator->KeepsPhotons())
    throw Error(ExitStatus::CommandLine,
                "--progressive: integrator \"" + setup.integratorName + "\" has no radii to shrink",
                {}, "--integrator exphotonmap and --integrator photonmap have");
  if (!command.certifies || setup.integrator->Certification(*setup.scene)) return;
  throw Error(ExitStatus::CommandLine, "--certify: integrator \"" + setup.integratorName +
                                           "\" with these parameters cannot estimate its bias; "
                                           "photonmap and exphotonmap can, without \"show\"");
}

PicturePasses PassesOf(const RenderCommand& command) {
  if (command.asTwoHalves) return {PicturePasses::Kind::TwoHalves, 2, 0};
  if (!command.targetError && !command.accuracy) return {};
  if (command.targetError)
    return {PicturePasses::Kind::TargetError, command.maxPasses, *command.targetError};
  const DialChoice& dial = *command.dial;
  return {PicturePasses::Kind::Accuracy,
          command.maxPasses,
          0,
          {*command.accuracy, dial.biasShare, BoundOf(dial.omitted),
           command.certifies ? command.certifiedShare : 0}};
}

Image MakeImage(const PictureFilms& films, const PassesResult& result, bool premultiplyAlpha) {
  Image image = films.film.ToImage(premultiplyAlpha);
  if (films.aovs) films.aovs->AppendTo(films.film, premultiplyAlpha, &image);
  ReplaceVariance(result.variances, films.film, premultiplyAlpha, &image);
  for (int i = 0; i < 2; ++i)
    if (films.writesHalves && films.halves[i])
      AppendHalf(kHalfNames[i], *films.halves[i], premultiplyAlpha, &image);
  return image;
}

Image MakeImage(const RenderCommand& command, const PictureSoFar& picture, bool premultiplyAlpha) {
  Image image = picture.film.ToImage(premultiplyAlpha);
  if (picture.aovs) picture.aovs->AppendTo(picture.film, premultiplyAlpha, &image);
  for (std::size_t i = 0; command.asTwoHalves && i < picture.halves.size(); ++i)
    AppendHalf(kHalfNames[i], picture.halves[i], premultiplyAlpha, &image);
  return image;
}

void CheckAovs(const RenderCommand& command, const RenderSetup& setup) {
  const AovSet known = kRendererAovs | setup.integrator->Aovs();
  const AovSet lacking = command.aovs.Without(known);
  if (lacking.IsEmpty()) return;
  throw Error(ExitStatus::CommandLine, "--aov: integrator \"" + setup.integratorName +
                                           "\" with these parameters has no AOV " +
                                           lacking.Names() + "; it has " + known.Names());
}

std::string AovNames(const RenderCommand& command) {
  std::string names = command.aovs.Names();
  if (command.asTwoHalves) names += (names.empty() ? "" : ", ") + std::string("half1, half2");
  return names;
}

}  // namespace exphoton::cli
