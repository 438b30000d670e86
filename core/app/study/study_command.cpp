// SPDX-License-Identifier: BSD-2-Clause
// RunStudy runs a whole study: reference, renders, measurements and result files.
#include "core/app/study/study_command.h"

#include <filesystem>
#include <tuple>

#include "core/app/analysis/headline/lower_bound.h"
#include "core/app/analysis/summary.h"
#include "core/app/budget/study_budgets.h"
#include "core/app/options/errors.h"
#include "core/app/options/limits.h"
#include "core/app/options/option_parser.h"
#include "core/app/options/values.h"
#include "core/app/output/output_files.h"
#include "core/app/output/run_files.h"
#include "core/app/process/signals.h"
#include "core/app/report/report.h"
#include "core/app/study/study_forecast.h"
#include "core/app/study/study_predictions.h"
#include "core/app/study/study_runner.h"
#include "core/app/study/study_tasks.h"
#include "core/base/error.h"
#include "core/imaging/metrics/metrics.h"

namespace exphoton::cli {
namespace {

namespace fs = std::filesystem;

// Returns "skylight-room" for .../skylight-room/exphotonmap.pbrt: variants of a scene share a
// folder.
std::string TitleOf(const StudyOptions& options) {
  if (!options.title.empty()) return options.title;
  const fs::path scene = fs::absolute(options.scene);
  for (const study::Setting& base : options.plan.bases)
    if (scene.stem() == base.integrator) return scene.parent_path().filename().string();
  return scene.stem().string();
}

study::Results Describe(const StudyOptions& options, const SceneFacts& scene,
                        const ProgramFacts& program) {
  study::Results results;
  results.program = program.version;
  results.fingerprint = program.fingerprint;
  results.processor = program.processor;
  results.system = program.system;
  results.cores = program.cores;
  results.title = TitleOf(options);
  results.scene = options.scene;
  results.sceneHash = scene.hash;
  results.command = options.commandLine;
  results.photonFile = options.photonFile;
  results.clock = options.clock;
  results.seeds = options.seeds;
  results.targets = options.targets;
  for (const std::string& crop : options.crops) {
    const std::vector<Real> c = ParseCropWindow(crop);
    results.crops.push_back({double(c[0]), double(c[1]), double(c[2]), double(c[3])});
  }
  return results;
}

// Returns the setting whose maps are shown: the one of exphotonmap, or else of any integrator, that
// reaches the headline's error in the shortest time. Without such a setting it is the most accurate
// one. Maps of a faster setting would show the noise of the clock.
const study::Setting* SettingForMaps(const study::Results& results,
                                     const study::Analysis& analysis) {
  const study::SettingResult* chosen = nullptr;
  const auto isMapped = [&](const study::SettingResult& s) {
    return results.settings[s.setting].integrator == "exphotonmap";
  };
  const auto rank = [&](const study::SettingResult& s) {
    const double error = s.cost.error.value;
    const bool isReached = analysis.target && error <= *analysis.target;
    return std::tuple(!isMapped(s), !isReached, isReached ? s.cost.seconds.value : error);
  };
  for (const study::SettingResult& s : analysis.settings)
    if (s.cost.error.IsKnown() && (!chosen || rank(s) < rank(*chosen))) chosen = &s;
  if (chosen) return &results.settings[chosen->setting];
  return results.settings.empty() ? nullptr : &results.settings.front();
}

// Renders AOVs of time and photon density.
std::vector<study::MapRecord> MakeMaps(const StudyOptions& options, const study::Results& results,
                                       const study::Analysis& analysis, StudyRunner& runner) {
  if (!options.makesMaps) return {};
  const study::Setting* chosen = SettingForMaps(results, analysis);
  if (!chosen) return {};
  study::Setting setting = *chosen;
  std::erase_if(setting.parameters, [](const auto& p) { return p.first == "time"; });
  // Only some integrators, with some parameters, provide AOVs of photons.
  study::RunRow row;
  for (const char* aovs : {"time,photonDensity,radianceDistance", "time,photonDensity", "time"}) {
    try {
      row = runner.RunOne(setting, 1, {"--aov", aovs});
      break;
    } catch (const Error& error) {
      if (error.Status() != ExitStatus::CommandLine) throw;
    }
  }
  const std::string of = " (" + setting.label + ", " + setting.Text() + ")";
  return {{row.image, "time.ms", "Cost of each pixel" + of, "ms"},
          {row.image, "photonDensity.Y", "Photon density" + of, "photons per unit of area"},
          {row.image, "radianceDistance.Y",
           "Distance from gather hits to the radiance photon used" + of, "units of length"}};
}

// Makes the renders whose settings depend on the times and errors of the others.
void RenderMore(const StudyOptions& options, StudyRunner& runner, study::Results* results) {
  const study::Analysis analysis = study::Analyse(options.folder, *results);
  results->lowerBounds = MeasureLowerBounds(options, *results, analysis, runner);
  results->maps = MakeMaps(options, *results, analysis, runner);
}

// Returns the headline and its details for a terminal. The page explains the lower bound in a
// section.
std::string SummaryText(const study::Analysis& analysis) {
  std::string details = analysis.details;
  if (!analysis.lowerBounds.empty())
    details += (details.empty() ? "" : " ") + analysis.lowerBounds + " The lower bound is " +
               study::kLowerBoundMeaning + ".";
  return analysis.headline + "\n" + (details.empty() ? "" : details + "\n");
}

// Measures the pictures and writes all result files.
void WriteResults(StudyFolder& folder, study::Results* results) {
  const std::string& path = folder.Path();
  study::MeasureRuns(path, results);
  const study::Analysis analysis = study::Analyse(path, *results);
  WriteTextFile(folder.Claim("results.json"), study::ToJson(*results));
  WriteTextFile(folder.Claim("results.csv"), study::ToCsv(*results));
  WriteTextFile(folder.Claim("summary.csv"), study::SummaryCsv(*results, analysis));
  WriteTextFile(folder.Claim("report.html"), study::MakeReport(path, *results, analysis));
  PrintOut(SummaryText(analysis) + path + "/report.html\n");
}

// Checks the reference before hours of rendering: it needs the size of the renders, and R, G and B.
void CheckReference(const StudyOptions& options, const SceneFacts& scene,
                    const study::ReferenceRecord& reference) {
  for (const std::string& name : {reference.a, reference.b}) {
    if (name.empty()) continue;
    const std::string path = fs::path(name).is_absolute() ? name : options.folder + "/" + name;
    const Image image = ReadImage(path);
    FindColors(image, path);
    if (image.Width() == scene.width && image.Height() == scene.height) continue;
    throw ImageError(path + " has " + std::to_string(image.Width()) + " x " +
                     std::to_string(image.Height()) + " pixels, the study's pictures " +
                     std::to_string(scene.width) + " x " + std::to_string(scene.height));
  }
}

std::string PlanText(const StudyOptions& options, const std::vector<study::Setting>& settings) {
  std::string text;
  for (const study::Setting& setting : settings)
    text += setting.label + ": " + CommandText(RunArguments(options, setting, 1)) + "\n";
  return text;
}

// Checks before hours of rendering that the result files overwrite neither inputs nor foreign
// files.
void ClaimResults(const StudyOptions& options, const SceneFacts& scene, StudyFolder& folder) {
  RunFiles files;
  for (const std::string& input : options.inputFiles) files.AddInput(input, "the study");
  for (const std::string& input : scene.inputFiles) files.AddInput(input, "the scene");
  for (const char* name : kStudyResults)
    files.AddOutput(name, {folder.Path() + "/" + name, "a result of the study",
                           "--out FOLDER names another folder"});
  Log log(options.isQuiet ? Log::Level::Quiet : Log::Level::Normal);
  files.Check(log);
  for (const char* name : kStudyResults) folder.Claim(name);
}

void Study(const std::vector<std::string>& arguments, const std::string& commandLine) {
  StudyOptions options = ParseStudyOptions(arguments);
  options.commandLine = commandLine;
  const Limits limits = ParseLimits(options.limits);
  LimitMemory(limits);
  const SceneFacts scene = ExamineScene(options.scene, options);
  const ProgramFacts program = ExamineProgram(options);
  study::Results results = Describe(options, scene, program);
  results.settings = PlanSettings(options);
  options.foreignSets = FindForeignSets(options, results.settings);
  options.sceneSets = scene.sets;
  RequireCertificates(options, results.settings);
  if (!options.photonFile.empty())
    options.photonIntegrators = FindPhotonIntegrators(options, results.settings);
  CheckSettings(options, results.settings);
  if (options.onlyPlans) {
    PrintOut(PlanText(options, results.settings));
    return PrintOut(ForecastText(options, scene, results.settings));
  }
  if (options.missingOf > 0)
    return PrintOut(MissingTasksText(options, scene, program, results.settings));
  if (options.taskCount > 0) return WriteStudyScripts(options, results.settings.size());
  if (!options.tasksFolder.empty()) CheckTaskFolders(options.tasksFolder);
  StudyFolder folder(options.folder);
  if (options.task) return RunStudyTask(options, scene, program, results.settings, folder);
  ClaimResults(options, scene, folder);
  if (!options.tasksFolder.empty()) TakeReferenceOfTask(options.tasksFolder, folder);
  MakeFolder(options.folder + "/images");
  StudyRunner runner(options, folder, scene, program);
  results.reference = PrepareReference(options, runner);
  CheckReference(options, scene, results.reference);
  if (options.predicts) results.predictions = Predict(options, results.settings);
  if (options.makesBudgets) results.budgets = MeasureBudgets(options, results.settings);
  results.runs = runner.RunAll(results.settings);
  RenderMore(options, runner, &results);
  WriteResults(folder, &results);
}

}  // namespace

int RunStudy(const std::vector<std::string>& arguments, const std::string& commandLine) {
  bool wasInterrupted = false;
  const int status = Guarded([&] {
    try {
      Study(arguments, commandLine);
    } catch (const StudyInterrupted&) {
      wasInterrupted = true;
      std::fputs("exphoton: interrupted; the same command goes on where this stopped\n", stderr);
    }
  });
  return wasInterrupted ? 128 + SignalNumber() : status;
}

int RunReport(const std::vector<std::string>& arguments) {
  return Guarded([&] {
    OptionParser app("Makes the page of a study again from its data, without rendering.",
                     "exphoton report");
    std::string folder, clock;
    app.Add("folder", folder, "the folder of a study").Required();
    app.Add("--clock", clock, "clock for all times: cpu or wall").OneOf({"cpu", "wall"});
    app.Parse(arguments);
    const std::string text = ReadTextFile(folder + "/results.json");
    if (text.empty())
      throw Error(ExitStatus::File, "\"" + folder + "\" has no results.json of a finished study");
    study::Results results;
    try {
      results = study::FromJson(text);
    } catch (const std::runtime_error& error) {
      throw Error(
          ExitStatus::File, "cannot use the study in \"" + folder + "\": " + error.what(), {},
          "exphoton study with the options of this study writes the file again, and repeats "
          "no finished render");
    }
    if (!clock.empty()) results.clock = clock;
    StudyFolder own(folder);
    WriteResults(own, &results);
  });
}

}  // namespace exphoton::cli
