// SPDX-License-Identifier: BSD-2-Clause
// ParseRenderCommand declares and evaluates the options of `exphoton render`.
#include "core/app/options/options.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "core/app/options/accuracy_option.h"
#include "core/app/options/limits.h"
#include "core/app/options/option_parser.h"
#include "core/app/options/values.h"
#include "core/app/output/output_names.h"
#include "core/base/format.h"
#include "core/parser/effect_choice.h"
#include "core/plugins/registry.h"

namespace exphoton::cli {
namespace {

constexpr int kMaxThreads = 4096;
constexpr std::int64_t kMaxSamplesPerPixel = 1 << 30;
constexpr int kMaxPasses = 100000;

constexpr const char* kCommands =
    "Commands (each has --help):\n"
    "  exphoton [render] SCENE ...        render pictures\n"
    "  exphoton explain SCENE             print what would be computed and why\n"
    "  exphoton plugins [NAME ...]        list plugins, or the parameters of one\n"
    "  exphoton check-plugin NAME         check a material, a light or a sampler\n"
    "  exphoton info PICTURE ...          print size, channels and attributes\n"
    "  exphoton convert FROM TO           convert between EXR and PNG\n"
    "  exphoton import SCENE -o NEW       convert a scene of pbrt version 3 or 4\n"
    "  exphoton denoise PICTURE           filter noise of a picture of two halves\n"
    "  exphoton compare REFERENCE NEW     test whether pictures differ\n"
    "  exphoton merge PARTS -o PICTURE    make a picture from parts (--shard)\n"
    "  exphoton cluster SCENE --shards N  write scripts that render with Slurm\n"
    "  exphoton photons SCENE -o FILE     shoot photons into a file (--photons)\n"
    "  exphoton quote SCENE               predict what accuracies cost\n"
    "  exphoton budget SCENE              split the error of a picture by cause\n"
    "  exphoton study SCENE --out DIR     compare integrators and settings\n"
    "  exphoton report DIR                make a study's page again\n"
    "\n"
    "Examples:\n"
    "  exphoton room.pbrt --quick -o room.png\n"
    "  exphoton room.pbrt --spp 64 --resolution 1920x1080 -o room.exr\n"
    "  exphoton room.pbrt --time-limit 5m --preview room.png --exposure auto\n"
    "  exphoton room.pbrt --frames 1-240 -o room%03d.exr\n"
    "  exphoton room.pbrt --integrator path --set SurfaceIntegrator.maxdepth=20\n";

// RawOptions holds option values that TakeRaw converts and checks after parsing.
struct RawOptions {
  std::string cropWindow, pixelBounds, pixel, dialect = "auto";
  std::vector<std::string> sets, pluginFolders;
  std::string shard, frames, resolution, aovs, timeLimit, limits, writeEvery, display;
  std::string accuracy;
  std::optional<double> frameTime, progressiveAlpha, certifiedShare;
  std::int64_t samplesPerPixel = 0;
  bool isQuiet = false, isVerbose = false, asHalf = false, asFloat = false, hidesProgress = false;
  bool checks = false, explains = false;
};

void AddPictureOptions(OptionParser& app, RenderCommand& command, RawOptions& raw) {
  app.Add("scenes", command.scenes, "scene files; \"-\" or a pipe: standard input");
  app.Group("Picture");
  app.Add("-o,--outfile", command.outfile,
          "the picture's file instead of the scene's: NAME.exr or NAME.png")
      .TypeName("FILE");
  app.Add("--preview", command.previewFile, "also write the picture as PNG").TypeName("FILE.png");
  AddPngOptions(app, &command.png);
  app.Add("--aov", raw.aovs, "also write these AOVs: " + AllAovNames()).TypeName("LIST");
  app.AddFlag("--half", raw.asHalf, "16-bit channels (default)");
  app.AddFlag("--float", raw.asFloat, "32-bit channels");
  app.AddFlag("--reproducible", command.isReproducible,
              "leave times, dates, threads and command line out of the picture's file");
  app.Group("Part and size");
  app.Add("--resolution", raw.resolution, "size of the picture in pixels").TypeName("WxH");
  app.Add("--cropwindow", raw.cropWindow, "a part of the picture, in fractions of it")
      .TypeName("x0,x1,y0,y1");
  app.Add("--pixelbounds", raw.pixelBounds, "a part in pixels, the upper ones excluded")
      .TypeName("x0,x1,y0,y1");
  app.Add("--pixel", raw.pixel, "one pixel").TypeName("x,y");
  app.AddFlag("--quick", command.load.isQuick,
              "a quarter of the resolution, 1 sample a pixel, a tenth of the photons");
}

void AddAmountOptions(OptionParser& app, RenderCommand& command, RawOptions& raw) {
  app.Group("How much to render");
  app.Add("--spp", raw.samplesPerPixel, "samples a pixel")
      .Between(std::int64_t(1), kMaxSamplesPerPixel)
      .TypeName("N");
  app.Add("--time-limit", raw.timeLimit, "render whole passes for this time: 90, 90s, 2m, 1h")
      .TypeName("TIME");
  app.Add("--target-error", command.targetError,
          "render whole passes until the noise part of relMSE is estimated below this")
      .TypeName("X");
  app.Add("--accuracy", raw.accuracy,
          "choose the settings and render until the error with its bias is below this, for example "
          "2%")
      .TypeName("P");
  app.AddFlag("--keep", command.keepsSettings,
              "with --accuracy: keep the integrator and the photons of the scene");
  app.Add("--max-passes", command.maxPasses,
          "with --target-error, --accuracy or --progressive: at most N whole passes, each with the "
          "samples a pixel of --spp, or with those that --accuracy chooses")
      .Between(1, kMaxPasses)
      .TypeName("N");
  app.AddFlag("--progressive", command.isProgressive,
              "with --time-limit, --target-error or --max-passes: each pass shoots its own photons "
              "and has smaller radii, so that the bias falls with the noise");
  app.Add("--progressive-alpha", raw.progressiveAlpha,
          "how slowly radii shrink: above 0, and 1 keeps them (default 2/3)")
      .TypeName("X");
  app.AddFlag("--two-halves", command.asTwoHalves,
              "render two independent halves, print their difference, write both into the file");
  app.AddFlag("--certify", command.certifies,
              "estimate the error with its bias and print it (photonmap, exphotonmap); without a "
              "stopping rule, the picture is rendered as two halves");
  app.Add("--certify-share", raw.certifiedShare,
          "share of the gather rays that --certify corrects (default 1/128)")
      .TypeName("X");
  app.Add("--seed", command.seed, "seed of the random numbers").TypeName("N");
  app.Add("--footprint-spp", command.footprintSamples,
          "filter textures and bumps as with N samples a pixel, regardless of --spp; for renders "
          "that are compared")
      .Between(std::int64_t(1), kMaxSamplesPerPixel)
      .TypeName("N");
}

void AddResumeOptions(OptionParser& app, RenderCommand& command, RawOptions& raw) {
  app.Group("Long renders");
  app.AddFlag("--resume", command.resumes,
              "continue a stopped render from its state, PICTURE.state; without one, begin");
  app.Add("--state", command.stateFile, "the file of the state, instead of PICTURE.state")
      .TypeName("FILE");
  app.Add("--write-every", raw.writeEvery,
          "write the picture so far and the state at this interval: 30s, 2m, 1h")
      .TypeName("TIME");
  app.Add("--display", raw.display, "show the picture in the viewer tev while it is rendered")
      .TypeName("HOST:PORT");
}

void AddFrameOptions(OptionParser& app, RawOptions& raw) {
  app.Group("Animation");
  app.Add("--frames", raw.frames,
          "render these frames; %d in names of files stands for a frame's number (%04d: with "
          "leading zeros)")
      .TypeName("A-B");
  app.Add("--frame-time", raw.frameTime,
          "time from one frame to the next (default 1; 0 if the scene's name has %d): frame n "
          "is exposed (n - 1) times this later than the scene says")
      .TypeName("T");
}

void AddShardOptions(OptionParser& app, RenderCommand& command, RawOptions& raw) {
  app.Group("Beyond one machine");
  app.Add("--shard", raw.shard,
          "render share I of N into the folder -o, as part-I-of-N.state; exphoton merge makes the "
          "picture")
      .TypeName("I/N");
  app.Add("--photons", command.photonFile,
          "use the photons in this file, which exphoton photons made, instead of shooting them")
      .TypeName("FILE");
}

void AddSceneOptions(OptionParser& app, RenderCommand& command, RawOptions& raw) {
  app.Group("Instead of what the scene says");
  for (const auto& [name, target, what] :
       {std::tuple{"--integrator", &command.load.integrator, "surface integrator"},
        {"--sampler", &command.load.sampler, "sampler, with as many samples a pixel"},
        {"--filter", &command.load.filter, "pixel filter, with its own widths"},
        {"--camera", &command.load.camera, "camera"},
        {"--accelerator", &command.load.accelerator, "acceleration structure"}})
    app.Add(name, *target, what).TypeName("NAME");
  app.Add("--set", raw.sets, "set a parameter, for example SurfaceIntegrator.maxdist=1.5")
      .TypeName("Directive.parameter=value")
      .OnePerUse();
  app.Add("--effects", command.load.effects,
          "what to compute: auto, all, or a list such as caustics=off,lens=on")
      .TypeName("LIST");
  app.Add("--dialect", raw.dialect,
          "version of the scene language (default auto: by its directives)")
      .OneOf({"auto", "v1", "v2"});
  app.AddFlag("--strict", command.load.isStrict,
              "unknown parameters and samples that are not finite are errors");
}

void AddRunOptions(OptionParser& app, RenderCommand& command, RawOptions& raw) {
  app.Group("Running");
  app.Add("--nthreads,--ncores", command.threadCount, "threads; 0: as many as cores")
      .Between(0, kMaxThreads)
      .TypeName("N");
  app.Add("--plugin-dir", raw.pluginFolders, "look for plugins in this folder first")
      .TypeName("DIR")
      .OnePerUse();
  AddScenePluginsOption(app, &command.load.allowsScenePlugins);
  AddLimitsOption(app, &raw.limits);
  app.Group("Messages");
  app.AddFlag("--check", raw.checks, "read the scene, report errors, render nothing");
  app.AddFlag("--explain", raw.explains, "print what would be computed and why, render nothing");
  app.AddFlag("--measure", command.measuresEffects,
              "with explain: render small, and print what each effect changes and costs");
  app.AddFlag("--stats", command.printsStatistics, "print times, rays and counts at the end");
  app.Add("--stats-json", command.statsFile, "write them to this file (-: print them)")
      .TypeName("FILE");
  app.AddFlag("--quiet", raw.isQuiet, "errors and warnings only");
  app.AddFlag("--verbose", raw.isVerbose, "print more messages");
  app.AddFlag("--no-progress", raw.hidesProgress, "no progress bar");
}

void Exclude(bool first, bool second, const char* text) {
  if (first && second) FailUsage(text);
}

// A PNG has neither layers nor 32-bit channels, and an EXR no tone curve.
void CheckPng(const RawOptions& raw, const RenderCommand& command) {
  const bool isPng = IsPngName(OutputNames(command).NameFromUser().value_or(""));
  Exclude(isPng, !raw.aovs.empty(), "a PNG has no layers for --aov: use -o NAME.exr");
  Exclude(isPng, command.asTwoHalves, "a PNG has no layers for --two-halves: use -o NAME.exr");
  Exclude(isPng, raw.asFloat || raw.asHalf, "--half and --float are for EXR: a PNG has 8 bits");
  CheckPngOptions(command.png);
  if (command.png.IsGiven() && !isPng && command.previewFile.empty())
    FailUsage("--exposure and --tone-curve are for PNG: an EXR stays linear",
              "-o NAME.png or --preview NAME.png writes one");
}

void CheckProgressive(const RawOptions& raw, const RenderCommand& command) {
  Exclude(raw.progressiveAlpha.has_value(), !command.isProgressive,
          "--progressive-alpha needs --progressive");
  if (!command.isProgressive) return;
  if (!(command.progressiveAlpha > 0 && command.progressiveAlpha <= 1))
    FailUsage("--progressive-alpha takes a number above 0 and at most 1");
  if (!command.timeLimit && !command.targetError && command.maxPasses == 0)
    FailUsage("--progressive needs --time-limit, --target-error or --max-passes",
              "--progressive --max-passes 100 renders 100 passes");
  Exclude(command.certifies, true,
          "--progressive and --certify exclude each other: a certificate compares passes with "
          "equal radii");
  Exclude(!raw.shard.empty(), true, "--progressive and --shard exclude each other");
}

void CheckPasses(const RawOptions& raw, const RenderCommand& command) {
  CheckProgressive(raw, command);
  Exclude(command.asTwoHalves, command.HasStoppingRule(),
          "--two-halves and --time-limit or --target-error exclude each other");
  Exclude(
      !command.photonFile.empty(), command.HasStoppingRule() || command.RendersTwoHalves(),
      "--photons excludes --time-limit, --target-error, --accuracy, --two-halves and --certify: "
      "their passes may shoot other photons");
}

// How many passes a time limit allows differs between machines, and a part belongs to no picture
// of its own.
void TakeShard(const RawOptions& raw, RenderCommand* command) {
  Exclude(command->maxPasses > 0,
          !command->targetError && !command->accuracy && !command->isProgressive,
          "--max-passes needs --target-error, --accuracy or --progressive");
  Exclude(command->maxPasses > 0, bool(command->timeLimit),
          "--max-passes and --time-limit exclude each other");
  if (raw.shard.empty()) return;
  command->shard = ParseShard(raw.shard);
  if (command->timeLimit)
    FailUsage("--shard and --time-limit exclude each other: machines differ in speed",
              "--target-error X --max-passes N stops all shards after the same passes");
  if ((command->targetError || command->accuracy) && command->maxPasses == 0)
    FailUsage(
        std::string("--shard with ") + (command->accuracy ? "--accuracy" : "--target-error") +
            " needs --max-passes N",
        "each shard renders all N passes, and exphoton merge drops those that are not needed");
  Exclude(command->resumes || command->writeEvery || !command->stateFile.empty(), true,
          "--shard excludes --resume, --state and --write-every: a part is rendered as a whole");
  Exclude(command->display.has_value(), true, "--shard and --display exclude each other");
  Exclude(!command->previewFile.empty(), true,
          "--shard and --preview exclude each other: exphoton merge makes the picture");
  if (command->outfile.empty())
    FailUsage("--shard needs -o FOLDER, the folder of the parts", "for example -o parts/");
  if (command->scenes.size() > 1) FailUsage("--shard renders one scene, but several are named");
  if (IsPngName(command->outfile) || IsExrName(command->outfile))
    FailUsage("with --shard, -o names the folder of the parts and not a picture",
              "for example -o parts/");
}

void TakeFrames(const RawOptions& raw, RenderCommand* command) {
  Exclude(raw.frameTime.has_value() && raw.frames.empty(), true, "--frame-time needs --frames");
  if (raw.frames.empty()) return;
  command->frames = ParseFrames(raw.frames);
  command->frames->apart = raw.frameTime;
  if (raw.frameTime && !(std::abs(*raw.frameTime) <= 1e9))
    FailUsage("--frame-time takes a number from -1e9 to 1e9");
  CheckFrames(*command);
}

// Corrections are not saved in parts.
void CheckCertificate(const RawOptions& raw, const RenderCommand& command) {
  Exclude(raw.certifiedShare.has_value(), !command.certifies, "--certify-share needs --certify");
  if (!command.certifies) return;
  if (!(command.certifiedShare > 0 && command.certifiedShare <= 16))
    FailUsage("--certify-share takes a number above 0 and at most 16");
  Exclude(!raw.shard.empty(), true, "--certify and --shard exclude each other");
}

// Without scenes, standard input is read.
void TakeScenes(RenderCommand* command) {
  if (command->scenes.empty()) {
    if (isatty(STDIN_FILENO))
      FailUsage("no scene is named", "name scene files, or \"-\" to type a scene");
    command->scenes.push_back("-");
  }
  if (std::count(command->scenes.begin(), command->scenes.end(), "-") > 1)
    FailUsage("standard input (-) is named twice");
  if (!command->outfile.empty() && command->scenes.size() > 1)
    FailUsage("--outfile names one picture, but there are several scenes");
  if (!command->stateFile.empty() && command->scenes.size() > 1)
    FailUsage("--state names one file, but there are several scenes");
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
  if (!raw.resolution.empty()) AddResolution(raw.resolution, &load.parameters);
  CheckPng(raw, *command);
  if (raw.samplesPerPixel > 0) load.samplesPerPixel = raw.samplesPerPixel;
  if (raw.dialect != "auto") load.dialect = raw.dialect == "v2" ? Dialect::V2 : Dialect::V1;
  load.pluginFolders = PluginRegistry::DefaultFolders(raw.pluginFolders);
  if (!raw.timeLimit.empty()) command->timeLimit = ParseDuration("--time-limit", raw.timeLimit);
  if (!raw.writeEvery.empty()) command->writeEvery = ParseDuration("--write-every", raw.writeEvery);
  if (!raw.display.empty()) command->display = ParseViewerAddress(raw.display);
  if (command->targetError && !(*command->targetError > 0 && *command->targetError < 1e9))
    FailUsage(Format("--target-error takes a number above 0 and below 1e9, not %g",
                     *command->targetError));
  command->progressiveAlpha = raw.progressiveAlpha.value_or(command->progressiveAlpha);
  command->certifiedShare = raw.certifiedShare.value_or(command->certifiedShare);
  TakeAccuracy(raw.accuracy, command);
  CheckPasses(raw, *command);
  CheckCertificate(raw, *command);
  TakeShard(raw, command);
  command->limits = ParseLimits(raw.limits);
  load.limits = command->limits.scene;
  if (!raw.aovs.empty()) command->aovs = ParseAovList(raw.aovs);
  command->asHalf = !raw.asFloat;
  command->showsProgress = !raw.hidesProgress && !raw.isQuiet;
  if (raw.isQuiet) command->logLevel = Log::Level::Quiet;
  if (raw.isVerbose) command->logLevel = Log::Level::Verbose;
  if (raw.checks) command->mode = RenderMode::Check;
  if (raw.explains) command->mode = RenderMode::Explain;
  Exclude(command->measuresEffects, command->mode != RenderMode::Explain,
          "--measure needs exphoton explain");
  TakeScenes(command);
  TakeFrames(raw, command);
  Log quiet(Log::Level::Quiet, Log::Sink::Memory);
  ChooseEffects(RequiredFeatures(), load.effects, quiet);  // throws if the value is invalid
}

}  // namespace

RenderCommand ParseRenderCommand(const std::vector<std::string>& arguments, RenderMode mode) {
  RenderCommand command;
  command.mode = mode;
  RawOptions raw;
  OptionParser app("Renders scenes in the language of pbrt, versions 1 and 2.",
                   mode == RenderMode::Explain ? "exphoton explain" : "exphoton [render]");
  app.Header(kCommands);
  app.Footer(
      "Exit status: 0 complete, 1 command line, 2 scene, 3 files, 4 resources, 5 internal, 128 + n "
      "on signal n.");
  AddPictureOptions(app, command, raw);
  AddAmountOptions(app, command, raw);
  AddResumeOptions(app, command, raw);
  AddFrameOptions(app, raw);
  AddShardOptions(app, command, raw);
  AddSceneOptions(app, command, raw);
  AddRunOptions(app, command, raw);
  app.AddVersion(VersionText());
  app.Parse(arguments);
  TakeRaw(raw, &command);
  return command;
}

std::vector<std::string> CommandNames() {
  return {"render", "explain", "plugins", "check-plugin", "info",    "convert",
          "import", "denoise", "compare", "merge",        "cluster", "photons",
          "quote",  "budget",  "study",   "report",       "help"};
}

const char* ShortUsage() { return kCommands; }

std::string VersionText() { return "exphoton " EXPHOTON_VERSION; }

}  // namespace exphoton::cli
