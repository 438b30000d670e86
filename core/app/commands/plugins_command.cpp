// SPDX-License-Identifier: BSD-2-Clause
// RunPlugins prints the plugins by kind or the parameters of named plugins, and writes the
// reference pages.
#include "core/app/commands/plugins_command.h"

#include "core/app/options/errors.h"
#include "core/app/options/option_parser.h"
#include "core/app/output/output_files.h"
#include "core/app/study/study_scene.h"
#include "core/base/log.h"
#include "core/parser/language_page.h"
#include "core/plugins/catalogue.h"

namespace exphoton::cli {
namespace {

// Overwrites an existing page only if its first line, which names the generator, matches.
void WriteReference(const std::string& folder, PluginRegistry& registry) {
  const auto pages = AllReferencePages(registry);
  for (const auto& [file, page] : pages) {
    const std::string older = ReadTextFile(folder + "/" + file);
    if (older.empty() || older.substr(0, older.find('\n')) == page.substr(0, page.find('\n')))
      continue;
    throw Error(ExitStatus::File, "cannot write \"" + folder + "/" + file +
                                      "\": it is not a page that this command has written");
  }
  for (const auto& [file, page] : pages) WriteTextFile(folder + "/" + file, page);
}

}  // namespace

int RunPlugins(const std::vector<std::string>& arguments) {
  return Guarded([&] {
    OptionParser app("Lists the plugins that scenes can name, or the parameters of some.",
                     "exphoton plugins");
    std::vector<std::string> names, folders;
    std::string referenceFolder;
    app.Add("names", names, "plugins whose parameters to list");
    app.Add("--plugin-dir", folders, "look for plugins in this folder first").OnePerUse();
    app.Add("--write-reference", referenceFolder,
            "write the pages of docs/reference to this folder");
    app.Parse(arguments);
    Log log(Log::Level::Quiet);
    PluginRegistry registry(PluginRegistry::DefaultFolders(folders), &log);
    if (!referenceFolder.empty()) {
      return WriteReference(referenceFolder, registry);
    }
    std::string text;
    if (names.empty()) text = ListPlugins(registry);
    for (const std::string& name : names)
      text += (text.empty() ? "" : "\n") + DescribePlugin(registry, name);
    PrintOut(text);
  });
}

}  // namespace exphoton::cli
