// SPDX-License-Identifier: BSD-2-Clause
// Dispatch by the first argument; without a command's name it is a scene to render.
#include "core/cli/app.h"

#include "core/cli/compare_command.h"
#include "core/cli/errors.h"
#include "core/cli/image_commands.h"
#include "core/cli/options.h"
#include "core/cli/plugins_command.h"
#include "core/cli/render_command.h"
#include "core/cli/signals.h"

namespace exphoton::cli {
namespace {

// Words as a shell would need them, so that the line can be pasted.
std::string CommandLineText(const std::vector<std::string>& arguments) {
  constexpr const char* kHarmless =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=./,:@%";
  std::string text;
  for (const std::string& argument : arguments) {
    if (!text.empty()) text += ' ';
    if (!argument.empty() && argument.find_first_not_of(kHarmless) == std::string::npos) {
      text += argument;
      continue;
    }
    text += '\'';
    for (const char c : argument) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
    text += '\'';
  }
  return text;
}

int RunScenes(const std::vector<std::string>& program, const std::vector<std::string>& arguments,
              RenderMode mode) {
  int result = 0;
  const int status = Guarded([&] {
    RenderCommand command = ParseRenderCommand(arguments, mode);
    command.commandLine = CommandLineText(program);
    result = RunRender(command);
  });
  return status ? status : result;
}

}  // namespace

int RunProgram(const std::vector<std::string>& arguments) {
  WatchSignals();
  const std::string command = arguments.size() > 1 ? arguments[1] : "";
  const std::vector<std::string> rest(
      arguments.begin() + std::min<std::ptrdiff_t>(2, std::ptrdiff_t(arguments.size())),
      arguments.end());
  if (command == "render") return RunScenes(arguments, rest, RenderMode::Render);
  if (command == "explain") return RunScenes(arguments, rest, RenderMode::Explain);
  if (command == "plugins") return RunPlugins(rest);
  if (command == "info") return RunInfo(rest);
  if (command == "convert") return RunConvert(rest);
  if (command == "compare") return RunCompare(rest);
  const std::vector<std::string> all(
      arguments.begin() + std::min<std::ptrdiff_t>(1, std::ptrdiff_t(arguments.size())),
      arguments.end());
  return RunScenes(arguments, all, RenderMode::Render);
}

}  // namespace exphoton::cli
