// SPDX-License-Identifier: BSD-2-Clause
// The list of plugins by kind, and the parameters of those that are named.
#include "core/cli/plugins_command.h"

#include <CLI/CLI.hpp>
#include <algorithm>

#include "core/base/error.h"
#include "core/base/log.h"
#include "core/cli/errors.h"
#include "core/cli/options.h"
#include "core/cli/output_files.h"
#include "core/cli/values.h"
#include "core/params/suggestions.h"
#include "core/plugins/registry.h"

namespace exphoton::cli {
namespace {

std::string Padded(std::string text, std::size_t width) {
  if (text.size() < width) text.resize(width, ' ');
  return text;
}

std::string ParameterText(const ParamDecl& decl) {
  std::string text = "  " + Padded(decl.name, 22) + Padded(ParamTypeName(decl.type), 15);
  text += decl.isRequired            ? "required"
          : decl.defaultText.empty() ? "automatic"
                                     : "default " + decl.defaultText;
  std::string details = RangeText(decl);
  for (const std::string& choice : decl.choices) details += (details.empty() ? "" : " | ") + choice;
  if (!decl.unit.empty()) details += (details.empty() ? "in " : " ") + decl.unit;
  if (!details.empty()) text += "; " + details;
  return text + "\n      " + decl.doc + "\n";
}

class PluginLister {
 public:
  explicit PluginLister(const std::vector<std::string>& folders)
      : registry_(PluginRegistry::DefaultFolders(folders), &log_) {}

  std::string All() {
    std::string text;
    for (int k = 0; k < kPluginKindCount; ++k) {
      const auto kind = PluginKind(k);
      const std::vector<std::string> names = registry_.Available(kind);
      text += std::string(k ? "\n" : "") + PluginKindName(kind) + "\n";
      for (const std::string& name : names)
        text += "  " + Padded(name, 18) + registry_.Load(kind, name, {}).summary + "\n";
      if (names.empty()) text += "  none\n";
    }
    return text;
  }

  // Every plugin of that name, of whatever kind.
  std::string One(const std::string& name) {
    std::string text;
    std::vector<std::string> known;
    for (int k = 0; k < kPluginKindCount; ++k) {
      const auto kind = PluginKind(k);
      const std::vector<std::string> names = registry_.Available(kind);
      known.insert(known.end(), names.begin(), names.end());
      if (std::find(names.begin(), names.end(), name) == names.end()) continue;
      text += (text.empty() ? "" : "\n") + Describe(kind, name);
    }
    if (text.empty())
      FailUsage("there is no plugin \"" + name + "\"; exphoton plugins lists them",
                DidYouMean(name, known));
    return text;
  }

 private:
  std::string Describe(PluginKind kind, const std::string& name) {
    std::string text = std::string(PluginKindName(kind)) + " \"" + name +
                       "\": " + registry_.Load(kind, name, {}).summary + "\n";
    const auto& declared = registry_.Find(kind, name, {}).parameters->Declarations();
    for (const ParamDecl& decl : declared) text += ParameterText(decl);
    if (declared.empty()) text += "  no parameters\n";
    return text;
  }

  Log log_{Log::Level::Quiet};
  PluginRegistry registry_;
};

}  // namespace

int RunPlugins(const std::vector<std::string>& arguments) {
  return Guarded([&] {
    CLI::App app("Lists the plugins that scenes can name, or the parameters of some.",
                 "exphoton plugins");
    std::vector<std::string> names, folders;
    app.add_option("names", names, "plugins whose parameters to list");
    app.add_option("--plugin-dir", folders, "look for plugins in this folder first")
        ->allow_extra_args(false);
    try {
      app.parse(std::vector<std::string>(arguments.rbegin(), arguments.rend()));
    } catch (const CLI::CallForHelp&) {
      throw TextRequest{app.help()};
    } catch (const CLI::ParseError& error) {
      FailUsage(error.what(), "exphoton plugins --help lists the options");
    }
    PluginLister lister(folders);
    std::string text;
    if (names.empty()) text = lister.All();
    for (const std::string& name : names) text += (text.empty() ? "" : "\n") + lister.One(name);
    PrintOut(text);
  });
}

}  // namespace exphoton::cli
