// SPDX-License-Identifier: BSD-2-Clause
// The options of `exphoton render`, declared to CLI11.
#include "core/cli/options.h"

#include <CLI/CLI.hpp>
#include <algorithm>

#include "core/cli/arguments.h"
#include "core/cli/values.h"
#include "core/parser/effect_choice.h"
#include "core/plugins/registry.h"

namespace exphoton::cli {
namespace {

constexpr int kMaxThreads = 4096;
constexpr std::int64_t kMaxSamplesPerPixel = 1 << 30;

// What CLI11 stores as text and is read afterwards.
struct RawOptions {
  std::string cropWindow, pixelBounds, pixel, dialect = "v1";
  std::vector<std::string> sets, pluginFolders;
  std::string integrator, layers, timeLimit;
  std::int64_t samplesPerPixel = 0;
  bool isQuiet = false, isVerbose = false, asHalf = false, asFloat = false, hidesProgress = false;
  bool checks = false, explains = false;
};

void AddSceneOptions(CLI::App& app, RenderCommand& command, RawOptions& raw) {
  app.add_option("scenes", command.scenes, "scene files; none or \"-\": standard input")
      ->type_name("FILE");
  app.add_option("--integrator", raw.integrator,
                 "use this surface integrator instead of the scene's")
      ->type_name("NAME");
  app.add_option("--set", raw.sets, "set a parameter, for example SurfaceIntegrator.maxdist=1.5")
      ->type_name("Directive.parameter=value")
      ->allow_extra_args(false);
  app.add_option("--spp", raw.samplesPerPixel, "samples a pixel")
      ->check(CLI::Range(std::int64_t(1), kMaxSamplesPerPixel))
      ->type_name("N");
  app.add_option("--cropwindow", raw.cropWindow, "a part of the picture, in fractions of it")
      ->type_name("x0,x1,y0,y1");
  app.add_option("--pixelbounds", raw.pixelBounds, "a part in pixels, the upper ones excluded")
      ->type_name("x0,x1,y0,y1");
  app.add_option("--pixel", raw.pixel, "one pixel")->type_name("x,y");
  app.add_flag("--quick", command.load.isQuick,
               "a quarter of the resolution, 1 sample a pixel, a tenth of the photons");
  app.add_option("--effects", command.load.effects,
                 "what to compute: auto, all, or a list such as caustics=off,lens=on")
      ->type_name("LIST");
  app.add_option("--dialect", raw.dialect, "how LookAt is meant: v1 (default) or v2")
      ->check(CLI::IsMember({"v1", "v2"}))
      ->type_name("");
  app.add_flag("--strict", command.load.isStrict,
               "unknown parameters and samples that are not finite are errors");
  app.add_option("--plugin-dir", raw.pluginFolders, "look for plugins in this folder first")
      ->type_name("DIR")
      ->allow_extra_args(false);
}

void AddRunOptions(CLI::App& app, RenderCommand& command, RawOptions& raw) {
  app.add_option("-o,--outfile", command.outfile, "the picture's file instead of the scene's")
      ->type_name("FILE");
  app.add_option("--nthreads,--ncores", command.threadCount, "threads; 0: as many as cores")
      ->check(CLI::Range(0, kMaxThreads))
      ->type_name("N");
  app.add_option("--seed", command.seed, "another seed gives other noise")->type_name("N");
  app.add_flag("--half", raw.asHalf, "16-bit channels (default)");
  app.add_flag("--float", raw.asFloat, "32-bit channels");
  app.add_option("--time-limit", raw.timeLimit,
                 "render whole passes until so much time is over: 90, 90s, 2m, 1h")
      ->type_name("TIME");
  app.add_option("--target-error", command.targetError,
                 "render whole passes until the noise part of relMSE is estimated below this")
      ->type_name("X");
  app.add_flag("--two-halves", command.asTwoHalves,
               "render two independent halves, say how far apart they are, write both as layers");
  app.add_option("--aov", raw.layers, "also write these layers: " + AllLayerNames())
      ->type_name("LIST");
  app.add_option("--preview", command.previewFile, "also write the picture as PNG")
      ->type_name("FILE.png");
  app.add_flag("--reproducible", command.isReproducible,
               "leave times, dates, threads and command line out of the picture's file");
  app.add_flag("--check", raw.checks, "read the scene, report errors, render nothing");
  app.add_flag("--explain", raw.explains, "print what would be computed and why, render nothing");
  app.add_flag("--stats", command.printsStatistics, "print times, rays and counts at the end");
  app.add_option("--stats-json", command.statsFile, "write them to this file (-: print them)")
      ->type_name("FILE");
  app.add_flag("--quiet", raw.isQuiet, "errors and warnings only");
  app.add_flag("--verbose", raw.isVerbose, "say more");
  app.add_flag("--no-progress", raw.hidesProgress, "no progress bar");
}

void Exclude(bool first, bool second, const char* text) {
  if (first && second) FailUsage(text);
}

void TakeRaw(const RawOptions& raw, RenderCommand* command) {
  LoadOptions& load = command->load;
  Exclude(raw.asHalf, raw.asFloat, "--half and --float exclude each other");
  Exclude(raw.isQuiet, raw.isVerbose, "--quiet and --verbose exclude each other");
  Exclude(raw.checks, raw.explains, "--check and --explain exclude each other");
  const int regions =
      int(!raw.cropWindow.empty()) + int(!raw.pixelBounds.empty()) + int(!raw.pixel.empty());
  if (regions > 1) FailUsage("--cropwindow, --pixelbounds and --pixel exclude each other");
  if (!raw.cropWindow.empty()) load.cropWindow = ParseCropWindow(raw.cropWindow);
  if (!raw.pixelBounds.empty()) load.pixelBounds = ParsePixelBounds(raw.pixelBounds);
  if (!raw.pixel.empty()) load.pixelBounds = ParsePixel(raw.pixel);
  for (const std::string& text : raw.sets) load.parameters.push_back(ParseOverride(text));
  if (!raw.integrator.empty()) load.integrator = raw.integrator;
  if (raw.samplesPerPixel > 0) load.samplesPerPixel = raw.samplesPerPixel;
  load.dialect = raw.dialect == "v2" ? Dialect::V2 : Dialect::V1;
  load.pluginFolders = PluginRegistry::DefaultFolders(raw.pluginFolders);
  if (!raw.timeLimit.empty()) command->timeLimit = ParseDuration("--time-limit", raw.timeLimit);
  if (command->targetError && !(*command->targetError > 0 && *command->targetError < 1e9))
    FailUsage("--target-error takes a number above 0");
  Exclude(command->asTwoHalves, command->HasStoppingRule(),
          "--two-halves and --time-limit or --target-error exclude each other");
  if (!raw.layers.empty()) command->layers = ParseLayerList(raw.layers);
  command->asHalf = !raw.asFloat;
  command->showsProgress = !raw.hidesProgress && !raw.isQuiet;
  if (raw.isQuiet) command->logLevel = Log::Level::Quiet;
  if (raw.isVerbose) command->logLevel = Log::Level::Verbose;
  if (raw.checks) command->mode = RenderMode::Check;
  if (raw.explains) command->mode = RenderMode::Explain;
  if (command->scenes.empty()) command->scenes.push_back("-");
  if (std::count(command->scenes.begin(), command->scenes.end(), "-") > 1)
    FailUsage("standard input (-) is named twice");
  if (!command->outfile.empty() && command->scenes.size() > 1)
    FailUsage("--outfile names one picture, but there are several scenes");
  Log quiet(Log::Level::Quiet, Log::Sink::Memory);
  ChooseEffects(EffectPlan(), load.effects, quiet);  // throws where it cannot be read
}

}  // namespace

RenderCommand ParseRenderCommand(const std::vector<std::string>& arguments, RenderMode mode) {
  RenderCommand command;
  command.mode = mode;
  RawOptions raw;
  CLI::App app("Renders scenes in the language of pbrt, versions 1 and 2, to OpenEXR pictures.",
               "exphoton [render]");
  app.footer(
      "\nOther commands: exphoton study | report | compare | info | convert | plugins | explain,\neach with --help.\n"
      "Exit status: 0 complete, 1 command line, 2 scene, 3 files, 4 resources, 5 internal,\n"
      "128 + n on signal n.");
  AddSceneOptions(app, command, raw);
  AddRunOptions(app, command, raw);
  app.set_version_flag("--version", VersionText());
  ParseArguments(app, arguments);
  TakeRaw(raw, &command);
  return command;
}

std::string VersionText() { return "exphoton " EXPHOTON_VERSION; }

}  // namespace exphoton::cli
