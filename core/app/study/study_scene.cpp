// SPDX-License-Identifier: BSD-2-Clause
// ExamineScene loads a scene in this process only to inspect it. Hashes are FNV-1a, which
// distinguishes files but is not cryptographic.
#include "core/app/study/study_scene.h"

#include <sys/utsname.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <thread>

#include "core/app/options/arguments.h"
#include "core/app/options/limits.h"
#include "core/app/options/options.h"
#include "core/app/options/values.h"
#include "core/app/output/run_record.h"
#include "core/app/process/child_process.h"
#include "core/app/process/interrupt_watch.h"
#include "core/app/process/signals.h"
#include "core/base/log.h"
#include "core/files/input_file.h"
#include "core/params/suggestions.h"
#include "core/parser/frame_name.h"
#include "core/parser/overrides.h"
#include "core/parser/render_setup.h"
#include "core/plugins/registry.h"
#include "core/transport/integrator.h"

namespace exphoton::cli {
namespace {

namespace fs = std::filesystem;

class Hash {
 public:
  void Add(const std::string& text) {
    for (const char c : text) Add(static_cast<unsigned char>(c));
    Add(0);
  }
  std::string Text() const { return HashText(value_); }

 private:
  void Add(unsigned byte) { value_ = (value_ ^ byte) * 0x100000001b3ull; }
  std::uint64_t value_ = 0xcbf29ce484222325ull;
};

LoadOptions SceneOptions(const StudyOptions& options) {
  LoadOptions load;
  load.pluginFolders = PluginRegistry::DefaultFolders(options.pluginFolders);
  load.allowsScenePlugins = options.allowsScenePlugins;
  load.limits = ParseLimits(options.limits).scene;
  load.stop = &StopFlag();
  for (const std::string& set : options.sets) {
    const ParameterOverride value = ParseOverride(set);
    if (value.directive != "SurfaceIntegrator") load.parameters.push_back(value);
  }
  if (!options.cropWindow.empty()) load.cropWindow = ParseCropWindow(options.cropWindow);
  return load;
}

std::string ProcessorName() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    const std::size_t colon = line.find(": ");
    if (line.starts_with("model name") && colon != std::string::npos) return line.substr(colon + 2);
  }
  return "unknown processor";
}

// The word of a setting for the number of progressive passes.
constexpr const char* kPasses = "passes";

constexpr std::string_view kWithCertificates[] = {"exphotonmap", "photonmap"};

// Returns the start of a --set of a parameter of the surface integrator.
std::string SetOf(const std::string& parameter) { return "SurfaceIntegrator." + parameter + "="; }

// Returns the scene's parameters without which --certify has nothing to estimate.
std::vector<std::string> SetsOfScene(const ParamSet& integrator) {
  std::vector<std::string> sets;
  for (const char* name : {"finalgather", "show"}) {
    const ParsedParam* const given = integrator.Find(name);
    if (given && !given->strings.empty()) sets.push_back(SetOf(name) + given->strings[0]);
  }
  return sets;
}

// Returns the last value of a parameter in these words, or `otherwise`.
std::string LastSet(const std::vector<std::string>& words, const std::string& parameter,
                    const std::string& otherwise) {
  std::string value = otherwise;
  for (const std::string& word : words)
    if (word.starts_with(SetOf(parameter))) value = word.substr(SetOf(parameter).size());
  return value;
}

bool KeepsPhotons(PluginRegistry& registry, const std::string& integrator, Log& log) {
  BindContext bind;
  bind.log = &log;
  return registry
      .Create<PluginKind::Integrator>(integrator, ParamSet(), bind, IntegratorContext{log})
      ->KeepsPhotons();
}

bool KeepsPhotons(const StudyOptions& options, const std::string& integrator) {
  Log log(Log::Level::Quiet, Log::Sink::Memory);
  PluginRegistry registry(PluginRegistry::DefaultFolders(options.pluginFolders), &log);
  return KeepsPhotons(registry, integrator, log);
}

// Looks up parameters in the declarations of the plugins. Integrators that can render progressive
// passes have their number as a parameter too.
class PluginParameterLookup final : public study::ParameterLookup {
 public:
  explicit PluginParameterLookup(const StudyOptions& options)
      : log_(Log::Level::Quiet),
        registry_(PluginRegistry::DefaultFolders(options.pluginFolders), &log_) {}

  void Check(const std::string& integrator) {
    registry_.Find(PluginKind::Integrator, integrator, SourceLocation());
  }
  bool Has(const std::string& integrator, const std::string& parameter) const override {
    if (parameter == kPasses) return KeepsPhotons(registry_, integrator, log_);
    const std::vector<std::string> names = Names(integrator);
    return std::find(names.begin(), names.end(), parameter) != names.end();
  }
  std::vector<std::string> Names(const std::string& integrator) const override {
    const PluginFactory& factory =
        registry_.Find(PluginKind::Integrator, integrator, SourceLocation());
    std::vector<std::string> names;
    for (const ParamDecl& decl : factory.parameters->Declarations()) names.push_back(decl.name);
    return names;
  }

 private:
  mutable Log log_;
  mutable PluginRegistry registry_;
};

}  // namespace

std::string ReadTextFile(const std::string& path) {
  try {
    RequireRegularFile(path);
  } catch (const InputFileError&) {
    return "";
  }
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

std::string HashOfText(const std::string& text) {
  Hash hash;
  hash.Add(text);
  return hash.Text();
}

SceneFacts ExamineScene(const std::string& path, const StudyOptions& options) {
  Log log(Log::Level::Quiet, Log::Sink::Memory);
  const InterruptWatch watch(ParseLimits(options.limits).seconds);
  FileSource source;
  const auto setups = LoadScenes(source, path, SceneOptions(options), log);
  if (setups.size() != 1)
    throw Error(ExitStatus::Scene, "\"" + path + "\" holds " + std::to_string(setups.size()) +
                                       " scenes; a study renders one");
  const RenderSetup& setup = *setups.front();
  Hash hash;
  hash.Add(HashText(setup.sceneHash));
  for (const std::string& file : setup.inputFiles) hash.Add(ReadTextFile(file));
  return {setup.crop.Width(), setup.crop.Height(), hash.Text(), setup.inputFiles,
          SetsOfScene(setup.integratorParameters)};
}

ProgramFacts ExamineProgram(const StudyOptions& options) {
  ProgramFacts facts;
  facts.version = VersionText();
  const fs::path program = OwnProgram();
  std::vector<fs::path> files{program};
  std::vector<fs::path> folders{program.parent_path().parent_path() / "lib"};
  for (const std::string& folder : PluginRegistry::DefaultFolders(options.pluginFolders))
    folders.push_back(folder);
  std::error_code ignored;
  for (const fs::path& folder : folders)
    for (const auto& entry : fs::recursive_directory_iterator(folder, ignored))
      if (entry.path().extension() == ".so") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  Hash hash;
  for (const fs::path& file : files) hash.Add(ReadTextFile(file));
  facts.fingerprint = hash.Text();
  facts.processor = ProcessorName();
  facts.cores = int(std::thread::hardware_concurrency());
  utsname system{};
  if (uname(&system) == 0) facts.system = std::string(system.sysname) + " " + system.release;
  return facts;
}

std::vector<study::Setting> PlanSettings(const StudyOptions& options) {
  PluginParameterLookup oracle(options);
  const auto check = [&](const study::Setting& setting) {
    oracle.Check(setting.integrator);
    for (const auto& [name, value] : setting.parameters) {
      if (name == "spp" || name == "time") continue;
      if (name.find('.') != std::string::npos) {
        CheckOverrides({ParseOverride(name + "=" + value)});
        continue;
      }
      if (oracle.Has(setting.integrator, name)) continue;
      const std::string hint = DidYouMean(name, oracle.Names(setting.integrator));
      FailUsage("integrator \"" + setting.integrator + "\" has no parameter \"" + name + "\"",
                hint.empty() ? "exphoton plugins " + setting.integrator + " lists them" : hint);
    }
  };
  try {
    std::vector<study::Setting> settings;
    for (const study::Setting& base : options.plan.bases) check(base);
    if (!options.makeReference.empty()) check(study::ParseSetting(options.makeReference));
    settings = study::ExpandPlan(options.plan, oracle);
    for (const study::Setting& setting : settings) check(setting);
    return settings;
  } catch (const std::invalid_argument& error) {
    FailUsage(error.what());
  }
}

std::map<std::string, std::set<std::string>> FindForeignSets(
    const StudyOptions& options, const std::vector<study::Setting>& settings) {
  const PluginParameterLookup lookup(options);
  std::set<std::string> integrators;
  for (const study::Setting& setting : settings) integrators.insert(setting.integrator);
  if (!options.makeReference.empty())
    integrators.insert(study::ParseSetting(options.makeReference).integrator);
  std::map<std::string, std::set<std::string>> foreign;
  for (const std::string& text : options.sets) {
    const ParameterOverride set = ParseOverride(text);
    if (set.directive != "SurfaceIntegrator") continue;
    std::set<std::string> without;
    std::vector<std::string> known;
    for (const std::string& integrator : integrators) {
      const std::vector<std::string> names = lookup.Names(integrator);
      known.insert(known.end(), names.begin(), names.end());
      if (std::ranges::find(names, set.parameter) == names.end()) without.insert(integrator);
    }
    if (without == integrators)
      FailUsage("--set: no integrator of the comparison has a parameter \"" + set.parameter + "\"",
                DidYouMean(set.parameter, known));
    for (const std::string& integrator : without) foreign[integrator].insert(text);
  }
  return foreign;
}

std::set<std::string> FindPhotonIntegrators(const StudyOptions& options,
                                            const std::vector<study::Setting>& settings) {
  std::set<std::string> names;
  for (const study::Setting& setting : settings)
    if (KeepsPhotons(options, setting.integrator)) names.insert(setting.integrator);
  if (names.empty())
    FailUsage("--photons: none of the study's integrators keeps photons",
              "exphotonmap and photonmap do");
  return names;
}

std::vector<std::string> RenderArguments(const StudyOptions& options, const std::string& scene,
                                         const study::Setting& setting, std::uint64_t seed) {
  std::vector<std::string> arguments{"render", scene, "--integrator", setting.integrator};
  const auto add = [&](const char* option, const std::string& value) {
    arguments.insert(arguments.end(), {option, value});
  };
  const auto foreign = options.foreignSets.find(setting.integrator);
  for (const std::string& set : options.sets)
    if (foreign == options.foreignSets.end() || !foreign->second.contains(set)) add("--set", set);
  for (const auto& [name, value] : setting.parameters) {
    if (name == "spp")
      add("--spp", value);
    else if (name == kPasses)
      arguments.insert(arguments.end(), {"--progressive", "--max-passes", value});
    else if (name == "time")
      add("--time-limit", value + "s");
    else if (name.find('.') != std::string::npos)
      add("--set", name + "=" + value);
    else
      add("--set", "SurfaceIntegrator." + name + "=" + value);
  }
  if (!options.cropWindow.empty()) add("--cropwindow", options.cropWindow);
  for (const std::string& folder : options.pluginFolders) add("--plugin-dir", folder);
  if (options.allowsScenePlugins) arguments.push_back("--allow-scene-plugins");
  add("--footprint-spp", std::to_string(options.footprintSamples));
  add("--nthreads", std::to_string(options.threads));
  add("--seed", std::to_string(seed));
  arguments.push_back("--float");
  arguments.push_back("--reproducible");
  return arguments;
}

bool HasCertificate(const StudyOptions& options, const study::Setting& setting) {
  if (!options.certifies || setting.Find(kPasses) ||
      std::ranges::find(kWithCertificates, setting.integrator) == std::end(kWithCertificates))
    return false;
  std::vector<std::string> words = options.sceneSets;
  const std::vector<std::string> own = RenderArguments(options, options.scene, setting, 1);
  words.insert(words.end(), own.begin(), own.end());
  return LastSet(words, "finalgather", "true") == "true" && LastSet(words, "show", "").empty();
}

void RequireCertificates(const StudyOptions& options, const std::vector<study::Setting>& settings) {
  const auto hasOne = [&](const study::Setting& s) { return HasCertificate(options, s); };
  if (options.certifies && std::ranges::none_of(settings, hasOne))
    FailUsage("--certify: no setting of the study has a certificate",
              "exphotonmap and photonmap with final gather have");
}

std::vector<std::string> RunArguments(const StudyOptions& options, const study::Setting& setting,
                                      std::uint64_t seed) {
  std::vector<std::string> arguments = RenderArguments(options, options.scene, setting, seed);
  // Progressive passes shoot their photons.
  if (options.photonIntegrators.contains(setting.integrator) && !setting.Find(kPasses))
    arguments.insert(arguments.end(), {"--photons", FrameName(options.photonFile, int(seed))});
  if (HasCertificate(options, setting)) arguments.push_back("--certify");
  return arguments;
}

void CheckSettings(const StudyOptions& options, const std::vector<study::Setting>& settings) {
  std::unique_ptr<RenderSetup> known;
  Log log(Log::Level::Quiet, Log::Sink::Memory);
  for (const study::Setting& setting : settings) {
    std::vector<std::string> words = RunArguments(options, setting, 1);
    words.erase(words.begin());  // the name of the command
    LoadOptions load = ParseRenderCommand(words, RenderMode::Render).load;
    load.stop = &StopFlag();
    load.known = known && known->scene && known->scene->IsWhole() ? known.get() : nullptr;
    FileSource source;
    std::unique_ptr<RenderSetup> setup =
        std::move(LoadScenes(source, options.scene, load, log).front());
    // Integrators refer to the scene, which the next setup takes.
    setup->integrator.reset();
    setup->volumeIntegrator.reset();
    known = std::move(setup);
  }
}

std::string CommandText(const std::vector<std::string>& arguments) {
  std::vector<std::string> words{"exphoton"};
  words.insert(words.end(), arguments.begin(), arguments.end());
  return CommandLineText(words);
}

}  // namespace exphoton::cli
