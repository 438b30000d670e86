// SPDX-License-Identifier: BSD-2-Clause
#include "core/app/quote/quote_command.h"

#include <cstdio>

#include "core/app/options/arguments.h"
#include "core/app/options/errors.h"
#include "core/app/options/limits.h"
#include "core/app/options/option_parser.h"
#include "core/app/options/values.h"
#include "core/app/output/output_files.h"
#include "core/app/process/signals.h"
#include "core/app/quote/quote_text.h"
#include "core/app/study/study_scene.h"
#include "core/base/error.h"

namespace exphoton::cli {
namespace {

struct QuoteOptions {
  StudyOptions scene;  // the members that concern the scene
  std::string resolution;
  std::vector<ParameterOverride> resolutionSets;
  std::vector<double> accuracies;
  double seconds = 5;
  std::uint64_t seed = 0;
  bool isQuiet = false;
};

std::vector<double> ParseAccuracies(const std::string& text) {
  if (text.find('%') == std::string::npos)
    FailUsage("--accuracies takes percentages, not \"" + text + '"', "for example 10,5,2,1%");
  std::vector<double> accuracies;
  for (const std::string& part : study::SplitList(text))
    accuracies.push_back(ParsePercentage("--accuracies", part.ends_with('%') ? part : part + '%'));
  if (accuracies.empty()) FailUsage("--accuracies names no accuracy");
  return accuracies;
}

QuoteOptions ParseQuoteOptions(const std::vector<std::string>& arguments) {
  QuoteOptions options;
  std::string integrators = "exphotonmap,photonmap,guidedpath,path", accuracies = "10,5,2,1%",
              pilotTime = "5s";
  OptionParser app(
      "Predicts the CPU time in which integrators reach an accuracy in a scene. Small renders of "
      "the scene (pilots) measure cost, noise and bias. The error is the root of relMSE, with "
      "bias.",
      "exphoton quote");
  app.Add("scene", options.scene.scene, "the scene").Required();
  app.Add("--integrators", integrators, "the integrators to compare").TypeName("LIST");
  app.Add("--accuracies", accuracies, "errors in per cent (default 10,5,2,1%)").TypeName("LIST");
  app.Add("--pilot-time", pilotTime, "about how long all pilots may take (default 5s)")
      .TypeName("TIME");
  app.Add("--resolution", options.resolution, "of the picture").TypeName("WIDTHxHEIGHT");
  app.Add("--set", options.scene.sets, "as in exphoton render").OnePerUse();
  app.Add("--seed", options.seed, "seed of the pilots");
  app.Add("--nthreads,--ncores", options.scene.threads, "threads of each pilot; 0: all cores")
      .Between(0, 4096);
  app.Add("--plugin-dir", options.scene.pluginFolders, "look for plugins in this folder first")
      .OnePerUse();
  AddScenePluginsOption(app, &options.scene.allowsScenePlugins);
  app.AddFlag("--quiet", options.isQuiet, "no progress");
  app.Parse(arguments);
  options.accuracies = ParseAccuracies(accuracies);
  options.seconds = ParseDuration("--pilot-time", pilotTime);
  for (const std::string& name : study::SplitList(integrators))
    options.scene.plan.bases.push_back(study::ParseSetting(name));
  if (!options.resolution.empty()) AddResolution(options.resolution, &options.resolutionSets);
  for (const std::string& set : options.scene.sets) ParseOverride(set);
  return options;
}

void MakeQuote(const std::vector<std::string>& arguments) {
  const QuoteOptions options = ParseQuoteOptions(arguments);
  StudyOptions sized = options.scene;
  for (const ParameterOverride& set : options.resolutionSets)
    sized.sets.push_back(set.directive + "." + set.parameter + "=" + set.value);
  const SceneFacts facts = ExamineScene(options.scene.scene, sized);
  const std::vector<study::Setting> settings = PlanSettings(options.scene);
  QuoteScene scene = MakeQuoteScene(options.scene, facts);
  scene.resolution = options.resolution;
  QuoteScene seeded = scene;
  seeded.options.insert(seeded.options.end(), {"--seed", std::to_string(options.seed)});
  std::vector<Quote> quotes;
  for (const study::Setting& setting : settings) {
    if (!options.isQuiet)
      std::fprintf(stderr, "exphoton: pilots of %s\n", setting.integrator.c_str());
    const bool hasBias = KeepsPhotons(options.scene, setting.integrator);
    quotes.push_back(
        RunPilots(seeded, setting.integrator, hasBias, options.seconds / double(settings.size())));
  }
  PrintOut(options.scene.scene + ", " + std::to_string(facts.width) + " x " +
           std::to_string(facts.height) + " pixels\n" +
           QuoteText(scene, quotes, options.accuracies));
}

}  // namespace

int RunQuote(const std::vector<std::string>& arguments) {
  bool wasInterrupted = false;
  const int status = Guarded([&] {
    try {
      MakeQuote(arguments);
    } catch (const QuoteInterrupted&) {
      wasInterrupted = true;
    }
  });
  return wasInterrupted ? 128 + SignalNumber() : status;
}

}  // namespace exphoton::cli
