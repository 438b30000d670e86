// SPDX-License-Identifier: BSD-2-Clause
// RunProgram dispatches by the first argument. Without a command name, the arguments are scenes to
// render.
#include "core/app/options/app.h"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

#include "core/app/budget/budget_command.h"
#include "core/app/commands/check_plugin_command.h"
#include "core/app/commands/compare_command.h"
#include "core/app/commands/image_commands.h"
#include "core/app/commands/plugins_command.h"
#include "core/app/commands/render_command.h"
#include "core/app/commands/render_frames.h"
#include "core/app/denoise/denoise_command.h"
#include "core/app/import/import_command.h"
#include "core/app/options/arguments.h"
#include "core/app/options/errors.h"
#include "core/app/options/options.h"
#include "core/app/options/values.h"
#include "core/app/photons/shoot_photons.h"
#include "core/app/process/signals.h"
#include "core/app/quote/quote_command.h"
#include "core/app/shards/cluster_command.h"
#include "core/app/shards/merge_command.h"
#include "core/app/study/study_command.h"
#include "core/base/error.h"
#include "core/params/suggestions.h"

namespace exphoton::cli {
namespace {

int RunScenes(const std::vector<std::string>& program, const std::vector<std::string>& arguments,
              RenderMode mode) {
  int result = 0;
  const int status = Guarded([&] {
    RenderCommand command = ParseRenderCommand(arguments, mode);
    command.commandLine = CommandLineText(program);
    result = command.frames ? RunFrames(command) : RunRender(command);
  });
  return status ? status : result;
}

// `names` follow the word "help". An option among them is ignored: it can only ask for help, too.
int RunHelp(const std::vector<std::string>& program, std::vector<std::string> names) {
  std::erase_if(names, [](const std::string& name) { return name.starts_with("-"); });
  if (names.empty() || names == std::vector<std::string>{"help"})
    return RunScenes(program, {"--help"}, RenderMode::Render);
  return Guarded([&] {
    if (names.size() > 1) FailUsage("help is for one command", "for example exphoton help merge");
    const std::vector<std::string> known = CommandNames();
    if (std::ranges::find(known, names[0]) == known.end()) {
      const std::string hint = DidYouMean(names[0], known);
      FailUsage("there is no command \"" + names[0] + '"',
                hint.empty() ? "exphoton --help lists the commands" : hint);
    }
    RunProgram({program[0], names[0], "--help"});
  });
}

// Returns whether standard input may hold a scene: it is a pipe, a socket or a file, and neither a
// terminal nor /dev/null.
bool HasPipedInput() {
  struct stat status {};
  return fstat(STDIN_FILENO, &status) == 0 && !S_ISCHR(status.st_mode);
}

}  // namespace

int RunProgram(const std::vector<std::string>& arguments) {
  WatchSignals();
  const std::string command = arguments.size() > 1 ? arguments[1] : "";
  const std::vector<std::string> rest(
      arguments.begin() + std::min<std::ptrdiff_t>(2, std::ptrdiff_t(arguments.size())),
      arguments.end());
  // Without arguments, a terminal would seem to hang: the program would wait for a typed scene.
  if (arguments.size() == 1 && !HasPipedInput()) {
    Guarded([] { FailUsage("no scene and no command is given", "exphoton --help explains both"); });
    std::fputs(ShortUsage(), stderr);
    return int(ExitStatus::CommandLine);
  }
  if (command == "help") return RunHelp(arguments, rest);
  if (command == "render") return RunScenes(arguments, rest, RenderMode::Render);
  if (command == "explain") return RunScenes(arguments, rest, RenderMode::Explain);
  if (command == "plugins") return RunPlugins(rest);
  if (command == "check-plugin") return RunCheckPlugin(rest);
  if (command == "info") return RunInfo(rest);
  if (command == "convert") return RunConvert(rest);
  if (command == "import") return RunImport(rest);
  if (command == "denoise") return RunDenoise(rest);
  if (command == "compare") return RunCompare(rest);
  if (command == "merge") return RunMerge(rest, CommandLineText(arguments));
  if (command == "cluster") return RunCluster(rest);
  if (command == "photons") return RunPhotons(rest);
  if (command == "quote") return RunQuote(rest);
  if (command == "budget") return RunBudget(rest);
  if (command == "study") return RunStudy(rest, CommandLineText(arguments));
  if (command == "report") return RunReport(rest);
  const std::vector<std::string> all(
      arguments.begin() + std::min<std::ptrdiff_t>(1, std::ptrdiff_t(arguments.size())),
      arguments.end());
  return RunScenes(arguments, all, RenderMode::Render);
}

}  // namespace exphoton::cli
