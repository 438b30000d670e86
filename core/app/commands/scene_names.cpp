// SPDX-License-Identifier: BSD-2-Clause
#include "core/app/commands/scene_names.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <utility>

#include "core/app/output/state_keeper.h"
#include "core/base/error.h"
#include "core/params/suggestions.h"

namespace exphoton::cli {
namespace {

// Suggests a command for a word without a folder and an ending, else a scene in the same folder.
std::string HintForMissing(const std::string& name) {
  const std::filesystem::path path(name);
  const bool isWord = !path.has_parent_path() && !path.has_extension();
  if (isWord) return DidYouMean(name, CommandNames());
  std::vector<std::string> scenes;
  std::error_code error;
  const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : ".";
  for (std::filesystem::directory_iterator it(folder, error), end; !error && it != end;
       it.increment(error))
    if (it->path().extension() == ".pbrt") scenes.push_back(it->path().filename().string());
  std::sort(scenes.begin(), scenes.end());
  return DidYouMean(path.filename().string(), scenes);
}

}  // namespace

void CheckScenesExist(const RenderCommand& command) {
  for (const std::string& scene : command.scenes) {
    if (scene == "-") continue;
    std::error_code error;
    const auto status = std::filesystem::status(scene, error);
    std::string why, hint;
    if (!std::filesystem::exists(status)) {
      why =
          error && error != std::errc::no_such_file_or_directory ? error.message() : "no such file";
      hint = HintForMissing(scene);
    } else if (std::filesystem::is_directory(status)) {
      why = "is a directory";
      hint = "name a scene file in it";
    } else if (access(scene.c_str(), R_OK) != 0) {
      why = std::strerror(errno);
    }
    if (why.empty()) continue;
    throw Error(ExitStatus::File, "cannot read the scene \"" + scene + "\": " + why, {}, hint);
  }
}

void CheckSceneCount(const RenderCommand& command, std::size_t index, std::size_t scenes) {
  if (scenes < 2) return;
  for (const auto& [isGiven, what] :
       {std::pair(!command.outfile.empty(), "--outfile names one picture"),
        std::pair(!command.stateFile.empty(), "--state names one file"),
        std::pair(command.shard.has_value(), "--shard renders one picture")})
    if (isGiven)
      throw Error(ExitStatus::CommandLine, std::string(what) + ", but \"" + command.scenes[index] +
                                               "\" holds " + std::to_string(scenes) + " scenes");
}

std::string ResumeText(const RenderCommand& command, const std::string& scene,
                       const StateKeeper& state) {
  const std::string& first = command.scenes.front();
  const bool isFirst = scene == (first == "-" ? "<stdin>" : first);
  return "the same command with " + command.resumeOptions +
         (isFirst ? "" : ", without the scenes before \"" + scene + "\",") + " continues from \"" +
         state.Path() + '"' +
         (state.IsOfEarlierAttempt() ? ", the state before the picture began again" : "");
}

}  // namespace exphoton::cli
