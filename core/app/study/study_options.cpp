// SPDX-License-Identifier: BSD-2-Clause
// ParseStudyOptions declares the options and converts study files to arguments.
#include "core/app/study/study_options.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "core/app/options/arguments.h"
#include "core/app/options/limits.h"
#include "core/app/options/option_parser.h"
#include "core/app/options/values.h"
#include "core/base/error.h"
#include "core/files/file_identity.h"
#include "core/files/input_file.h"
#include "core/params/suggestions.h"
#include "core/parser/frame_name.h"
#include "core/parser/syntax/tokenizer.h"

namespace exphoton::cli {
namespace {

namespace fs = std::filesystem;

struct RawStudyOptions {
  std::string integrators, budgets, referenceTime, resolution, targets, task;
  std::vector<std::string> settings, varied;
  bool hidesMaps = false;
};

bool IsStudyFile(const std::string& path) { return fs::path(path).extension() == ".study"; }

// Returns whether the value of this study-file option is a path.
bool NamesAFile(const std::string& option) {
  return option == "scene" || option == "reference" || option == "reference-scene" ||
         option == "photons";
}

// Returns the prefix of messages about a line of a study file.
std::string PlaceIn(const std::string& path, int line) {
  return path + ":" + std::to_string(line) + ": ";
}

// Refuses options that only the user may give, because study files can come from untrusted sources.
// The jobs of --tasks read the study file, too, so it cannot say which part of the study to run.
void CheckAllowedInStudyFile(const std::string& name, const std::string& value,
                             const std::string& place) {
  constexpr std::string_view kRefused[] = {
      "plugin-dir", "allow-scene-plugins", "limits", "submit", "sbatch", "tasks", "task", "from"};
  if (std::ranges::find(kRefused, name) == std::end(kRefused)) return;
  throw Error(ExitStatus::File, place + "\"" + name + "\" can only be given on the command line",
              SourceLocation(),
              "to choose it yourself: exphoton study ... --" + name +
                  (value.empty() ? "" : " " + CommandLineText({value})));
}

// A study file may only name a folder inside the working folder or inside its own folder.
void CheckFolder(const std::string& folder, const std::string& file, const std::string& place) {
  if (LiesIn(folder, ".") || LiesIn(folder, FolderOf(file))) return;
  throw Error(ExitStatus::File,
              place + "the folder \"" + folder +
                  "\" lies neither in the working folder nor in the study file's",
              SourceLocation(),
              "to choose it yourself: exphoton study " + CommandLineText({file, "--out", folder}));
}

std::vector<std::string> ReadStudyFile(const OptionParser& app, const std::string& path) {
  try {
    RequireRegularFile(path);
  } catch (const InputFileError& error) {
    throw Error(ExitStatus::File, "cannot read the study file \"" + path + "\": " + error.what());
  }
  std::ifstream file(path);
  std::vector<std::string> arguments;
  int number = 0;
  for (std::string line; std::getline(file, line);) {
    ++number;
    const std::size_t first = line.find_first_not_of(" \t\r");
    if (first == std::string::npos || line[first] == '#') continue;
    const std::size_t last = line.find_last_not_of(" \t\r");
    line = line.substr(first, last - first + 1);
    const std::size_t space = line.find_first_of(" \t");
    const std::string name = line.substr(0, space), place = PlaceIn(path, number);
    std::string value;
    if (space != std::string::npos) value = line.substr(line.find_first_not_of(" \t", space));
    if (name[0] == '-')
      throw Error(ExitStatus::CommandLine, place + "options in a study file have no dashes");
    if (!app.Has("--" + name))
      throw Error(ExitStatus::CommandLine, place + "there is no option \"" + Printable(name) + '"',
                  SourceLocation(), DidYouMean(name, app.Names()));
    CheckAllowedInStudyFile(name, value, place);
    if (name == "out") CheckFolder(value, path, place);
    if (NamesAFile(name) && fs::path(value).is_relative())
      value = (fs::path(path).parent_path() / value).lexically_normal().string();
    arguments.push_back(value.empty() ? "--" + name : "--" + name + "=" + value);
  }
  return arguments;
}

std::string OptionName(const std::string& argument) {
  return argument.substr(0, argument.find('='));
}

// Returns the options in study files that this option of the command line replaces: itself if it
// can be repeated, and options that it excludes. The last one of other options counts anyway, and
// --set counts for each parameter by itself.
std::vector<std::string> ReplacedBy(const std::string& option) {
  if (option == "--reference") return {"--reference", "--make-reference", "--reference-time"};
  if (option == "--make-reference") return {"--reference", "--make-reference"};
  if (option == "--setting" || option == "--vary" || option == "--crop") return {option};
  return {};
}

// Drops the arguments of study files that those of the command line replace.
void DropReplaced(const std::vector<std::string>& commandLine, std::vector<std::string>* ofFiles) {
  for (const std::string& argument : commandLine)
    for (const std::string& name : ReplacedBy(OptionName(argument)))
      std::erase_if(*ofFiles, [&](const std::string& line) { return OptionName(line) == name; });
}

void AddWhat(OptionParser& app, StudyOptions& options, RawStudyOptions& raw) {
  app.Add("file", options.scene, "the scene, or a study file (NAME.study)")
      .TypeName("SCENE.pbrt|NAME.study");
  app.Add("--scene", options.scene, "the scene").TakeLast();
  app.Add("-o,--out", options.folder, "the folder for everything").TakeLast();
  app.Add("--title", options.title, "the scene's name on the page").TakeLast();
  app.Add("--integrators", raw.integrators, "for example exphotonmap,photonmap,path")
      .TakeLast()
      .TypeName("LIST");
  app.Add("--setting", raw.settings,
          "another setting to render: \"[LABEL: ]INTEGRATOR [name=value ...]\"")
      .OnePerUse();
  app.Add("--vary", raw.varied,
          "a parameter and its values, [INTEGRATOR:]name=v1,v2,...; \"spp\" too. Several "
          "are multiplied")
      .OnePerUse();
  app.Add("--budgets", raw.budgets, "seconds that renders may take: 1,4,16,64s")
      .TakeLast()
      .TypeName("LIST");
  app.Add("--seeds", options.seeds, "independent renders of each setting (default 4)")
      .Between(1, 1000)
      .TakeLast();
  app.Add("--targets", raw.targets, "errors of the price list (default .1,.03,.01,.003)")
      .TakeLast()
      .TypeName("LIST");
  app.Add("--clock", options.clock, "clock for all times: cpu (default) or wall")
      .OneOf({"cpu", "wall"})
      .TakeLast();
}

void AddReference(OptionParser& app, StudyOptions& options, RawStudyOptions& raw) {
  app.Add("--reference", options.references,
          "the reference picture; given twice: two independent halves of it")
      .OnePerUse();
  app.Add("--make-reference", options.makeReference,
          "render one, in two halves, with this: \"path maxdepth=100\"")
      .TakeLast();
  app.Add("--reference-time", raw.referenceTime, "render time of the reference (default 30m)")
      .TakeLast();
  app.Add("--reference-scene", options.referenceScene,
          "another scene file that has the same picture")
      .TakeLast();
}

void AddRender(OptionParser& app, StudyOptions& options, RawStudyOptions& raw) {
  app.Add("--resolution", raw.resolution, "of all pictures").TakeLast().TypeName("WIDTHxHEIGHT");
  app.Add("--set", options.sets, "for all renders, as in exphoton render").OnePerUse();
  app.Add("--cropwindow", options.cropWindow, "render a part only").TakeLast();
  app.Add("--footprint-spp", options.footprintSamples,
          "filter textures and bumps of all renders as with N samples a pixel (default 16)")
      .Between(std::int64_t(1), std::int64_t(1) << 30)
      .TakeLast();
  app.Add("--crop", options.crops, "a part to show larger on the page: x0,x1,y0,y1 from 0 to 1")
      .OnePerUse();
  app.Add("--nthreads,--ncores", options.threads, "threads of each render; 0: all cores")
      .Between(0, 4096)
      .TakeLast();
  app.Add("--plugin-dir", options.pluginFolders, "look for plugins in this folder first")
      .OnePerUse();
  app.Add("--photons", options.photonFile,
          "read photons from this file instead of shooting them; %d in its name is the seed")
      .TakeLast()
      .TypeName("FILE");
  AddScenePluginsOption(app, &options.allowsScenePlugins);
  AddLimitsOption(app, &options.limits);
  app.AddFlag("--no-maps", raw.hidesMaps, "no extra render for the maps of cost and photons");
  app.AddFlag("--predict", options.predicts,
              "quote each integrator first, and show the quotes beside the measurements");
  app.AddFlag("--error-budget", options.makesBudgets,
              "split the error of photonmap and exphotonmap by cause, as exphoton budget does");
  app.AddFlag("--certify", options.certifies,
              "render photonmap and exphotonmap with certificates of their errors, and show these "
              "beside the measured errors");
  app.AddFlag("--quiet", options.isQuiet, "no progress");
  app.AddFlag(
      "--plan", options.onlyPlans,
      "print what would be rendered and about how long it takes, estimated from small parts");
}

void AddArray(OptionParser& app, StudyOptions& options, RawStudyOptions& raw) {
  app.Group("On a cluster");
  app.Add("--tasks", options.taskCount,
          "write scripts that run the study as an array of N jobs, into the folder DIR.tasks")
      .Between(1, 100000)
      .TypeName("N");
  AddArrayOptions(app, &options.array);
  app.AddFlag("--share-nodes", options.sharesNodes,
              "jobs may share machines with other work; the page then says that times are not "
              "comparable");
  app.Add("--task", raw.task, "run the renders of one task into --out; 0/N: the reference")
      .TakeLast()
      .TypeName("I/N");
  app.AddFlag("--alone", options.isAlone, "with --task: no other work runs on this machine");
  app.Add("--from", options.tasksFolder,
          "take over the renders of tasks, whose folders are in this one")
      .TakeLast()
      .TypeName("DIR");
  app.Add("--missing", options.missingOf,
          "with --from: print which of N tasks have to run, and stop")
      .Between(1, 100000)
      .TypeName("N");
}

void TakeResolution(const std::string& text, StudyOptions* options) {
  if (text.empty()) return;
  std::vector<ParameterOverride> overrides;
  AddResolution(text, &overrides);
  for (const ParameterOverride& set : overrides)
    options->sets.push_back(set.directive + "." + set.parameter + "=" + set.value);
}

std::vector<double> ParseTargets(const std::string& text) {
  std::vector<double> targets;
  for (const std::string& part : study::SplitList(text)) {
    std::size_t used = 0;
    double value = 0;
    try {
      value = std::stod(part, &used);
    } catch (const std::exception&) {
      used = 0;
    }
    if (used != part.size() || !(value > 0))
      FailUsage("--targets takes errors, not \"" + text + "\"");
    targets.push_back(value);
  }
  std::sort(targets.rbegin(), targets.rend());
  return targets;
}

void TakePlan(const RawStudyOptions& raw, StudyOptions* options) {
  for (const std::string& name : study::SplitList(raw.integrators))
    options->plan.bases.push_back(study::ParseSetting(name));
  for (const std::string& text : raw.settings)
    options->plan.bases.push_back(study::ParseSetting(text));
  for (const std::string& text : raw.varied)
    options->plan.varied.push_back(study::ParseVariedParameter(text));
  if (!raw.budgets.empty()) options->plan.budgets = study::ParseBudgets(raw.budgets);
  if (!raw.referenceTime.empty())
    options->referenceSeconds = ParseDuration("--reference-time", raw.referenceTime);
  if (!raw.referenceTime.empty() && options->makeReference.empty())
    FailUsage("--reference-time needs --make-reference", "--make-reference \"path maxdepth=100\"");
  if (!options->makeReference.empty()) study::ParseSetting(options->makeReference);
  if (options->plan.bases.empty())
    for (const char* name : {"exphotonmap", "photonmap", "path"})
      options->plan.bases.push_back(study::ParseSetting(name));
}

void CheckPhotonFile(const StudyOptions& options) {
  if (options.photonFile.empty()) return;
  if (options.seeds > 1 && !HasFrameNumber(options.photonFile))
    FailUsage("--photons needs a file for each seed, or equal photons would hide their noise",
              "--photons 'room%d.expm' reads room1.expm for seed 1; or give --seeds 1");
  if (!options.plan.budgets.empty())
    FailUsage("--photons excludes --budgets: each pass of such a render has photons of its own");
}

// Quotes are about whole pictures with photons of their own, in CPU time and with their bias.
void CheckPredict(const StudyOptions& options) {
  if (!options.predicts) return;
  if (options.references.empty() && options.makeReference.empty())
    FailUsage("--predict needs a reference, because the quotes include the bias",
              "--reference PICTURE, or --make-reference guidedpath");
  if (options.clock != "cpu") FailUsage("--predict needs --clock cpu: quotes are CPU times");
  if (!options.cropWindow.empty()) FailUsage("--predict excludes --cropwindow");
  if (!options.photonFile.empty()) FailUsage("--predict excludes --photons");
  if (options.taskCount > 0 || options.task || !options.tasksFolder.empty())
    FailUsage(
        "--predict excludes --tasks, --task and --from: pilots and renders must run on one "
        "machine");
}

// Budgets shoot their own photons, and their times are those of one machine.
void CheckBudgets(const StudyOptions& options) {
  if (!options.makesBudgets) return;
  if (!options.photonFile.empty()) FailUsage("--error-budget excludes --photons");
  if (options.taskCount > 0 || options.task || !options.tasksFolder.empty())
    FailUsage("--error-budget excludes --tasks, --task and --from");
}

// A certificate compares two sets of photons, and costs time that quotes do not include.
void CheckCertify(const StudyOptions& options) {
  if (!options.certifies) return;
  if (!options.photonFile.empty()) FailUsage("--certify excludes --photons");
  if (options.predicts)
    FailUsage("--certify excludes --predict: quotes are for renders without certificates");
}

void Check(const StudyOptions& options) {
  if (options.scene.empty()) FailUsage("exphoton study needs a scene or a study file");
  if (options.folder.empty() && !options.onlyPlans && options.missingOf == 0)
    FailUsage("exphoton study needs --out FOLDER");
  ParseLimits(options.limits);
  CheckPhotonFile(options);
  CheckPredict(options);
  CheckBudgets(options);
  CheckCertify(options);
  if (options.references.size() > 2) FailUsage("--reference: one picture, or two halves of it");
  if (!options.references.empty() && !options.makeReference.empty())
    FailUsage("--reference and --make-reference exclude each other");
  for (const std::string& set : options.sets) ParseOverride(set);
  for (const std::string& crop : options.crops) ParseCropWindow(crop, "--crop");
  if (!options.cropWindow.empty()) ParseCropWindow(options.cropWindow);
}

// A study reads its input files more than once, so none of them can be a pipe.
void TakeInputFiles(StudyOptions* options) {
  std::vector<std::string> files{options->scene};
  files.insert(files.end(), options->references.begin(), options->references.end());
  if (!options->referenceScene.empty()) files.push_back(options->referenceScene);
  for (int seed = 1; !options->photonFile.empty() && seed <= options->seeds; ++seed)
    files.push_back(FrameName(options->photonFile, seed));
  for (const std::string& file : files) {
    try {
      RequireRegularFile(file);
    } catch (const InputFileError& error) {
      throw Error(ExitStatus::File, "cannot read \"" + file + "\": " + error.what());
    }
    options->inputFiles.push_back(file);
  }
}

}  // namespace

StudyOptions ParseStudyOptions(const std::vector<std::string>& given) {
  StudyOptions options;
  RawStudyOptions raw;
  OptionParser app(
      "Renders a scene with several integrators and settings, each with several seeds, and shows "
      "what accuracy costs in time: results.csv, results.json, images/ and report.html in one "
      "folder. Started again it goes on where it stopped.",
      "exphoton study");
  AddWhat(app, options, raw);
  AddReference(app, options, raw);
  AddRender(app, options, raw);
  AddArray(app, options, raw);
  // Options of study files come first, because the last one counts.
  std::vector<std::string> arguments, rest;
  for (const std::string& argument : given) {
    const bool isFile = IsStudyFile(argument) && argument[0] != '-';
    const std::vector<std::string> read =
        isFile ? ReadStudyFile(app, argument) : std::vector<std::string>();
    if (isFile) options.inputFiles.push_back(argument);
    arguments.insert(arguments.end(), read.begin(), read.end());
    if (!isFile) rest.push_back(argument);
  }
  DropReplaced(rest, &arguments);
  arguments.insert(arguments.end(), rest.begin(), rest.end());
  app.Parse(arguments);
  try {
    TakePlan(raw, &options);
  } catch (const std::invalid_argument& error) {
    FailUsage(error.what());
  }
  TakeResolution(raw.resolution, &options);
  if (!raw.targets.empty()) options.targets = ParseTargets(raw.targets);
  options.makesMaps = !raw.hidesMaps;
  options.arguments = given;
  if (!raw.task.empty()) options.task = ParseStudyTask(raw.task);
  Check(options);
  CheckTasks(options);
  TakeInputFiles(&options);
  return options;
}

}  // namespace exphoton::cli
