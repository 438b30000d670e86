// SPDX-License-Identifier: BSD-2-Clause
#include "core/app/quote/quote_command.h"

#include <cstdio>
#include <set>

#include "core/app/options/arguments.h"
#include "core/app/options/errors.h"
#include "core/app/options/option_parser.h"
#include "core/app/options/values.h"
#include "core/app/output/output_files.h"
#include "core/app/process/interrupt_watch.h"
#include "core/app/process/signals.h"
#include "core/app/quote/quote_text.h"
#include "core/app/study/study_scene.h"
#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/base/terminal.h"

namespace exphoton::cli {
namespace {

struct QuoteOptions {
  std::string scene, resolution;
  std::vector<std::string> integrators, sets, pluginFolders;
  std::vector<double> accuracies;
  double seconds = 5;
  std::uint64_t seed = 0;
  int threads = 0;
  bool allowsScenePlugins = false, isQuiet = false, isVerbose = false;
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
  app.Add("scene", options.scene, "the scene").Required();
  app.Add("--integrators", integrators, "the integrators to compare").TypeName("LIST");
  app.Add("--accuracies", accuracies, "errors in per cent (default 10,5,2,1%)").TypeName("LIST");
  app.Add("--pilot-time", pilotTime, "about how long all pilots may take (default 5s)")
      .TypeName("TIME");
  app.Add("--resolution", options.resolution, "of the picture").TypeName("WIDTHxHEIGHT");
  app.Add("--set", options.sets, "as in exphoton render").OnePerUse();
  app.Add("--seed", options.seed, "seed of the pilots");
  app.Add("--nthreads,--ncores", options.threads, "threads of each pilot; 0: all cores")
      .Between(0, 4096);
  app.Add("--plugin-dir", options.pluginFolders, "look for plugins in this folder first")
      .OnePerUse();
  AddScenePluginsOption(app, &options.allowsScenePlugins);
  app.AddFlag("--quiet", options.isQuiet, "no progress");
  app.AddFlag("--verbose", options.isVerbose, "show the result of each pilot");
  app.Parse(arguments);
  options.accuracies = ParseAccuracies(accuracies);
  options.seconds = ParseDuration("--pilot-time", pilotTime);
  options.integrators = study::SplitList(integrators);
  if (options.integrators.empty()) FailUsage("--integrators names no integrator");
  return options;
}

// Returns the options of the quoted renders, without these of --set.
std::vector<std::string> SceneOptionsOf(const QuoteOptions& options,
                                        const std::set<std::string>& foreignSets) {
  std::vector<std::string> words;
  const auto add = [&](const char* option, const std::string& value) {
    words.insert(words.end(), {option, value});
  };
  for (const std::string& set : options.sets)
    if (!foreignSets.contains(set)) add("--set", set);
  for (const std::string& folder : options.pluginFolders) add("--plugin-dir", folder);
  if (options.allowsScenePlugins) words.push_back("--allow-scene-plugins");
  if (options.threads > 0) add("--nthreads", std::to_string(options.threads));
  if (!options.resolution.empty()) add("--resolution", options.resolution);
  return words;
}

// The pilots have all options of --set, and know which integrators are compared.
RenderCommand PilotCommand(const QuoteOptions& options) {
  std::vector<std::string> words{options.scene, "--seed", std::to_string(options.seed)};
  const std::vector<std::string> common = SceneOptionsOf(options, {});
  words.insert(words.end(), common.begin(), common.end());
  RenderCommand command = ParseRenderCommand(words, RenderMode::Render);
  command.load.comparedIntegrators = options.integrators;
  return command;
}

// Returns the options of the renders of each integrator. Throws Error for an unknown integrator,
// or a parameter that none has.
QuoteScene SceneOf(const QuoteOptions& options) {
  StudyOptions study;
  study.pluginFolders = options.pluginFolders;
  study.sets = options.sets;
  for (const std::string& name : options.integrators) study.plan.bases.push_back({name, name, {}});
  auto foreign = FindForeignSets(study, PlanSettings(study));
  QuoteScene scene{.path = options.scene};
  for (const std::string& name : options.integrators)
    scene.options[name] = SceneOptionsOf(options, foreign[name]);
  return scene;
}

// Prints the warnings of a pilot, for example that a depth limit cuts much light.
void PrintWarnings(const std::vector<std::string>& messages) {
  for (const std::string& message : messages)
    if (message.find(": warning: ") != std::string::npos)
      std::fputs(Colored(message, "warning").c_str(), stderr);
}

void MakeQuote(const std::vector<std::string>& arguments) {
  const QuoteOptions options = ParseQuoteOptions(arguments);
  const RenderCommand command = PilotCommand(options);
  const InterruptWatch watch;
  FileSource::Streams streams;
  Log log(options.isVerbose ? Log::Level::Verbose : Log::Level::Normal);
  PilotRenderer renderer(command, options.scene, {"quote", &streams, &log, false, true});
  QuoteScene scene = SceneOf(options);
  scene.sampler = &renderer.SceneSampler();
  const double cpuSeconds = options.seconds * ThreadPool(options.threads).Count();
  std::vector<Quote> quotes;
  for (const std::string& name : options.integrators) {
    if (!options.isQuiet) std::fprintf(stderr, "exphoton: pilots of %s\n", name.c_str());
    quotes.push_back(RunPilots(&renderer, name, cpuSeconds / double(options.integrators.size())));
    PrintWarnings(quotes.back().messages);
  }
  PrintOut(scene.path + ", " + std::to_string(renderer.Width()) + " x " +
           std::to_string(renderer.Height()) + " pixels\n" +
           QuoteText(scene, quotes, options.accuracies));
}

}  // namespace

int RunQuote(const std::vector<std::string>& arguments) {
  bool wasInterrupted = false;
  const int status = Guarded([&] {
    try {
      MakeQuote(arguments);
    } catch (const LoadingStopped&) {
      wasInterrupted = true;
    }
  });
  return wasInterrupted ? 128 + SignalNumber() : status;
}

}  // namespace exphoton::cli
