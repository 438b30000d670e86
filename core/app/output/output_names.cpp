// SPDX-License-Identifier: BSD-2-Clause
// OutputNames prefers names from the command line to names from scene files.
#include "core/app/output/output_names.h"

#include <filesystem>

#include "core/app/options/arguments.h"
#include "core/app/output/png_output.h"
#include "core/app/shards/part_record.h"
#include "core/base/error.h"

namespace exphoton::cli {

std::optional<std::string> OutputNames::NameFromUser() const {
  if (!command_.outfile.empty()) return command_.outfile;
  std::optional<std::string> name;
  for (const ParameterOverride& set : command_.load.parameters)
    if (set.directive == "Film" && set.parameter == "filename") name = set.value;
  return name;
}

void OutputNames::CheckEndings() const {
  if (command_.shard) return;
  const std::string picture = NameFromUser().value_or("out.exr");
  if (!IsPngName(picture) && !IsExrName(picture))
    throw Error(ExitStatus::CommandLine,
                "the picture \"" + picture + "\" ends neither in .exr nor in .png", {},
                "NAME.exr keeps all values, NAME.png is for viewing");
  const std::string& preview = command_.previewFile;
  if (!preview.empty() && !IsPngName(preview))
    throw Error(ExitStatus::CommandLine, "the preview \"" + preview + "\" does not end in .png");
}

std::string OutputNames::Picture(const std::string& name) const {
  return FollowLinks(NameFromUser().value_or(ExrName(name)));
}

std::string OutputNames::Part() const {
  const std::string name = PartName(*command_.shard);
  return (std::filesystem::path(command_.outfile) / name).string();
}

std::string OutputNames::State(const std::string& name) const {
  return command_.stateFile.empty() ? Picture(name) + ".state" : FollowLinks(command_.stateFile);
}

// Suggests a command with -o NAME: the original one if it renders one scene, else one for `scene`.
std::string OutputNames::LineWithOutput(const std::string& scene, const std::string& name) const {
  const bool isAlone = command_.scenes.size() == 1 && !command_.commandLine.empty();
  const std::string line = isAlone ? command_.commandLine : "exphoton " + CommandLineText({scene});
  const bool isFrame = command_.load.frame.has_value();
  return line + " -o " + CommandLineText({isFrame ? "frame%04d.exr" : name});
}

void OutputNames::AddTo(RunFiles& files, const Place& place, const std::string& name) const {
  const std::string& scene = command_.scenes[place.file];
  const std::string key = std::to_string(place.file) + ":" + std::to_string(place.picture);
  const std::string of = scene == "-" ? " of standard input" : " of \"" + scene + '"';
  if (command_.shard) {
    files.AddOutput("1 " + key, {Part(), "the part" + of, "-o FOLDER names another folder"});
    if (!command_.statsFile.empty() && command_.statsFile != "-")
      files.AddOutput("3", {command_.statsFile, "the statistics",
                            "--stats-json FILE names another file for them"});
    return;
  }
  OutputFile picture{NameFromUser().value_or(ExrName(name)), "the picture" + of,
                     "-o FILE names another file for the picture"};
  if (!NameFromUser()) {
    picture.namedBy = scene;
    picture.remedy = "to name the file yourself: " + LineWithOutput(scene, ExrName(name));
  }
  if (place.picture > 0)
    picture.remedy =
        NameFromUser() ? "without this name, each picture has the name of its Film"
                       : "each picture of a scene file needs a Film with a \"filename\" of its own";
  files.AddOutput("1 " + key, picture);
  if (!command_.previewFile.empty())
    files.AddOutput("2 " + key, {command_.previewFile, "the preview" + of,
                                 "--preview FILE.png names another file, for one picture"});
  if (command_.resumes || command_.writeEvery || !command_.stateFile.empty())
    files.AddOutput("4 " + key, {State(name), "the state" + of,
                                 "--state FILE names another file for the state"});
  if (!command_.statsFile.empty() && command_.statsFile != "-")
    files.AddOutput("3", {command_.statsFile, "the statistics",
                          "--stats-json FILE names another file for them"});
}

}  // namespace exphoton::cli
