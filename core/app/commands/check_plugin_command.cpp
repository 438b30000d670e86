// SPDX-License-Identifier: BSD-2-Clause
// RunCheckPlugin loads a scene of a few words that uses the plugin, so that parameters are written
// and checked as in any scene.
#include "core/app/commands/check_plugin_command.h"

#include <algorithm>
#include <array>

#include "core/app/checks/light_checks.h"
#include "core/app/checks/material_checks.h"
#include "core/app/checks/sampler_checks.h"
#include "core/app/options/errors.h"
#include "core/app/options/option_parser.h"
#include "core/app/options/values.h"
#include "core/app/output/output_files.h"
#include "core/base/format.h"
#include "core/base/log.h"
#include "core/params/suggestions.h"
#include "core/parser/render_setup.h"
#include "core/plugins/registry.h"

namespace exphoton::cli {
namespace {

constexpr std::array kCheckedKinds{PluginKind::Material, PluginKind::Light, PluginKind::AreaLight,
                                   PluginKind::Sampler};

// Other kinds of plugins are not checked.
PluginKind KindOf(const PluginRegistry& registry, const std::string& name) {
  std::vector<std::string> all;
  for (const PluginKind kind : kCheckedKinds) {
    const std::vector<std::string> names = registry.Available(kind);
    if (std::find(names.begin(), names.end(), name) != names.end()) return kind;
    all.insert(all.end(), names.begin(), names.end());
  }
  for (int i = 0; i < kPluginKindCount; ++i) {
    const std::vector<std::string> names = registry.Available(PluginKind(i));
    if (std::find(names.begin(), names.end(), name) != names.end())
      FailUsage("\"" + name + "\" is a " + PluginKindName(PluginKind(i)) +
                "; only materials, lights and samplers are checked");
  }
  FailUsage("there is no material, light or sampler \"" + name + "\"", DidYouMean(name, all));
}

// The words before the plugin's name and after its parameters.
struct SceneFrame {
  std::string before, after;
};

SceneFrame SceneFrameOf(PluginKind kind) {
  const std::string named =
      "MakeNamedMaterial \"matte\" \"string type\" \"matte\"\n"
      "MakeNamedMaterial \"mirror\" \"string type\" \"mirror\"\n";
  const std::string lamp = "WorldBegin\nLightSource \"point\"\n";
  switch (kind) {
    case PluginKind::Material:
      return {lamp + named + "Material ", "\nShape \"sphere\"\nWorldEnd\n"};
    case PluginKind::Light:
      return {"WorldBegin\nLightSource ", "\nShape \"sphere\"\nWorldEnd\n"};
    case PluginKind::AreaLight:
      return {"WorldBegin\nAreaLightSource ", "\nShape \"sphere\"\nWorldEnd\n"};
    default:
      return {"Sampler ", "\n" + lamp + "Shape \"sphere\"\nWorldEnd\n"};
  }
}

Checks RunChecks(const RenderSetup& setup, PluginKind kind, std::uint64_t seed) {
  if (kind == PluginKind::Sampler) return CheckSampler(*setup.sampler, seed);
  if (kind == PluginKind::Material) return CheckMaterial(*setup.scene->Materials().at(0), seed);
  if (setup.scene->Lights().empty())
    throw Error(ExitStatus::Scene, "with these parameters there is no light to check");
  return CheckLight(*setup.scene, seed);
}

std::string TextOf(const Checks& checks) {
  std::string text;
  for (const Check& check : checks.list)
    text += Format("%-6s  %-18s %10.4g %s %-8.4g %s\n", check.IsPassed() ? "ok" : "FAILED",
                   check.name.c_str(), check.figure, check.isAtLeast ? ">=" : "<=", check.limit,
                   check.meaning.c_str());
  for (const std::string& note : checks.notes) text += "note    " + note + "\n";
  return text;
}

struct CheckArguments {
  std::string name;
  std::vector<std::string> parameters, folders;
  std::uint64_t seed = 1;
};

// Returns whether all checks pass.
bool CheckPlugin(const CheckArguments& arguments) {
  Log log;
  LoadOptions options;
  options.pluginFolders = PluginRegistry::DefaultFolders(arguments.folders);
  options.dialect = Dialect::V1;
  const PluginRegistry registry(options.pluginFolders, &log);
  const PluginKind kind = KindOf(registry, arguments.name);
  const SceneFrame frame = SceneFrameOf(kind);
  std::string words = "\"" + arguments.name + "\"";
  for (const std::string& parameter : arguments.parameters) words += " " + parameter;
  MemorySource source({{"the parameters", frame.before + words + frame.after}});
  const auto setups = LoadScenes(source, "the parameters", options, log);
  const Checks checks = RunChecks(*setups.at(0), kind, arguments.seed);
  PrintOut(TextOf(checks));
  const auto failed = std::count_if(checks.list.begin(), checks.list.end(),
                                    [](const Check& check) { return !check.IsPassed(); });
  PrintOut(Format("%s %s: ", PluginKindName(kind), words.c_str()) +
           (failed == 0 ? Format("all %zu checks passed\n", checks.list.size())
                        : Format("%td of %zu checks failed\n", failed, checks.list.size())));
  return failed == 0;
}

}  // namespace

int RunCheckPlugin(const std::vector<std::string>& arguments) {
  bool isPassed = true;
  const int status = Guarded([&] {
    OptionParser app(
        "Checks a material, a light or a sampler: energy, samples against densities, reciprocity, "
        "power. One line a check, with the figure and its limit; the exit status is 1 if one "
        "fails.",
        "exphoton check-plugin");
    CheckArguments values;
    app.Add("name", values.name, "the plugin, as scenes name it").Required();
    app.Add("parameters", values.parameters,
            "its parameters, as in a scene: '\"float roughness\" .05'; materials that name others "
            "have \"matte\" and \"mirror\"");
    app.Add("--plugin-dir", values.folders, "look for plugins in this folder first").OnePerUse();
    app.Add("--seed", values.seed, "of the random numbers").DefaultText("1");
    app.Parse(arguments);
    isPassed = CheckPlugin(values);
  });
  return status ? status : isPassed ? 0 : 1;
}

}  // namespace exphoton::cli
