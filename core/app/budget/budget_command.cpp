// SPDX-License-Identifier: BSD-2-Clause
#include "core/app/budget/budget_command.h"

#include <optional>

#include "core/app/budget/budget_text.h"
#include "core/app/options/errors.h"
#include "core/app/options/option_parser.h"
#include "core/app/options/values.h"
#include "core/app/output/output_files.h"
#include "core/app/process/interrupt_watch.h"
#include "core/app/process/signals.h"

namespace exphoton::cli {
namespace {

// The options of the scene are those of `exphoton render`.
struct RawBudgetOptions {
  std::string scene, resolution, integrator, effects;
  std::vector<std::string> sets, pluginFolders;
  std::int64_t samples = 0, footprint = 0;
  std::uint64_t seed = 0;
  int threads = 0;
  bool allowsScenePlugins = false, isQuiet = false;
};

void AddBudgetScene(OptionParser& app, RawBudgetOptions* raw) {
  app.Add("scene", raw->scene, "the scene").Required();
  app.Add("--integrator", raw->integrator, "photonmap or exphotonmap").TypeName("NAME");
  app.Add("--spp", raw->samples, "samples a pixel").Between(std::int64_t(1), std::int64_t(1) << 20);
  app.Add("--resolution", raw->resolution, "of the picture; at most about 3000 pixels are rendered")
      .TypeName("WIDTHxHEIGHT");
  app.Add("--effects", raw->effects, "as in exphoton render").TypeName("LIST");
  app.Add("--set", raw->sets, "as in exphoton render").OnePerUse();
  app.Add("--footprint-spp", raw->footprint, "as in exphoton render")
      .Between(std::int64_t(1), std::int64_t(1) << 30);
  app.Add("--seed", raw->seed, "first seed");
  app.Add("--nthreads,--ncores", raw->threads, "threads; 0: all cores").Between(0, 4096);
  app.Add("--plugin-dir", raw->pluginFolders, "look for plugins in this folder first").OnePerUse();
  AddScenePluginsOption(app, &raw->allowsScenePlugins);
  app.AddFlag("--quiet", raw->isQuiet, "no progress");
}

std::vector<std::string> RenderWords(const RawBudgetOptions& raw) {
  std::vector<std::string> words{raw.scene, "--seed", std::to_string(raw.seed)};
  const auto add = [&](const char* option, const std::string& value) {
    if (!value.empty()) words.insert(words.end(), {option, value});
  };
  const auto count = [](std::int64_t value) { return value > 0 ? std::to_string(value) : ""; };
  add("--integrator", raw.integrator);
  add("--spp", count(raw.samples));
  add("--resolution", raw.resolution);
  add("--effects", raw.effects);
  add("--footprint-spp", count(raw.footprint));
  add("--nthreads", count(raw.threads));
  for (const std::string& set : raw.sets) add("--set", set);
  for (const std::string& folder : raw.pluginFolders) add("--plugin-dir", folder);
  if (raw.allowsScenePlugins) words.push_back("--allow-scene-plugins");
  return words;
}

void MakeBudgetText(const std::vector<std::string>& arguments) {
  RawBudgetOptions raw;
  BudgetOptions options;
  OptionParser app(
      "Splits the error of a scene's picture by cause. Small renders with several seeds move one "
      "setting after the other towards its limit. The error is relMSE: the noise parts are "
      "variances, and the bias parts are shares of the squared bias.",
      "exphoton budget");
  AddBudgetScene(app, &raw);
  app.Add("--seeds", options.seeds, "renders of each setting (default 8)").Between(3, 1000);
  app.Add("--block", options.blockWidth, "width of the blocks of biases, in pixels; 0: chosen")
      .Between(0, 1024);
  app.Add("--reference-spp", options.referenceSamples,
          "compare the sum with renders against guidedpath with this number of samples a pixel; "
          "without it, with a certificate")
      .Between(std::int64_t(1), std::int64_t(1) << 24);
  app.Parse(arguments);
  options.showsProgress = !raw.isQuiet;
  const RenderCommand command = ParseRenderCommand(RenderWords(raw), RenderMode::Render);
  const InterruptWatch watch;
  FileSource::Streams streams;
  Log log(raw.isQuiet ? Log::Level::Quiet : Log::Level::Normal);
  options.log = &log;
  PrintOut(BudgetText(raw.scene, MeasureBudget(command, options, &streams), options));
}

}  // namespace

int RunBudget(const std::vector<std::string>& arguments) {
  bool wasInterrupted = false;
  const int status = Guarded([&] {
    try {
      MakeBudgetText(arguments);
    } catch (const LoadingStopped&) {
      wasInterrupted = true;
    }
  });
  return wasInterrupted ? 128 + SignalNumber() : status;
}

}  // namespace exphoton::cli
