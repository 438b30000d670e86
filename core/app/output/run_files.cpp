// SPDX-License-Identifier: BSD-2-Clause
// RunFiles compares files by identity (device and inode, or folder and name), not by path text.
#include "core/app/output/run_files.h"

#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <optional>

#include "core/app/output/output_files.h"
#include "core/base/error.h"
#include "core/imaging/files/exr.h"
#include "core/plugins/library.h"

namespace exphoton::cli {
namespace {

namespace fs = std::filesystem;

std::string InQuotes(const std::string& text) { return '"' + text + '"'; }

[[noreturn]] void Refuse(const OutputFile& output, const std::string& why) {
  throw Error(ExitStatus::File,
              "cannot write " + InQuotes(output.path) + " (" + output.what + "): " + why,
              SourceLocation(), output.remedy);
}

bool Exists(const std::string& path) {
  struct stat status;
  return lstat(path.c_str(), &status) == 0;
}

// A name from a scene or study file may create a file, or replace a picture of this program, only
// in the working folder or the scene's folder.
void CheckSceneName(const OutputFile& output) {
  if (output.namedBy.empty()) return;
  const std::string target = FollowLinks(output.path);
  const std::string scene = "a scene file names it, ";
  const bool isNear =
      LiesIn(target, ".") || (output.namedBy != "-" && LiesIn(target, FolderOf(output.namedBy)));
  if (!isNear)
    Refuse(output, scene + "and it is neither in the working folder nor in the scene's folder");
  if (Exists(target) && !IsOwnPicture(target))
    Refuse(output, scene + "and the existing file is not a picture of this program");
}

}  // namespace

bool IsOwnPicture(const std::string& path) { return ExrSoftware(path).starts_with("exphoton "); }

RunFiles::RunFiles() {
  AddInput("/proc/self/exe", "");
  AddInput(CoreFile(), "");
}

void RunFiles::AddInput(const std::string& path, const std::string& reader) {
  const std::optional<FileIdentity> file = IdentifyFile(path);
  if (file) inputs_.try_emplace(*file, Input{path, reader});
}

void RunFiles::AddScene(const std::string& path, const std::set<std::string>& inputs) {
  const std::string reader = "the scene " + InQuotes(path);
  const std::optional<FileIdentity> file =
      path == "-" ? IdentifyOpenFile(STDIN_FILENO) : IdentifyFile(path);
  if (file) inputs_.try_emplace(*file, Input{path, reader});
  for (const std::string& input : inputs) AddInput(input, reader);
}

void RunFiles::AddScene(const RenderSetup& setup) {
  const std::string name = setup.sceneName == "<stdin>" ? "-" : setup.sceneName;
  AddScene(name, {setup.inputFiles.begin(), setup.inputFiles.end()});
}

void RunFiles::AddPluginFolders(const std::vector<std::string>& folders) {
  pluginFolders_.insert(pluginFolders_.end(), folders.begin(), folders.end());
}

void RunFiles::AddOutput(const std::string& key, OutputFile output) {
  outputs_[key] = std::move(output);
}

bool RunFiles::IsPlugin(const std::string& path) const {
  const std::string target = FollowLinks(path);
  if (!target.ends_with(".so") || !Exists(target)) return false;
  for (const std::string& folder : pluginFolders_)
    if (LiesIn(target, folder)) return true;
  return false;
}

void RunFiles::CheckInputs(const OutputFile& output) const {
  if (IsPlugin(output.path)) Refuse(output, "it is a plugin of this program");
  const std::optional<FileIdentity> file = IdentifyFile(output.path);
  const auto input = file ? inputs_.find(*file) : inputs_.end();
  if (input == inputs_.end()) return;
  const auto& [path, reader] = input->second;
  if (reader.empty()) Refuse(output, "it is this program");
  Refuse(output,
         reader + " reads this file" + (path == output.path ? "" : " as " + InQuotes(path)));
}

void RunFiles::CheckOthers() const {
  std::map<FileIdentity, OutputFile> seen;
  for (const int stream : {STDOUT_FILENO, STDERR_FILENO})
    if (const auto file = IdentifyOpenFile(stream))
      seen[*file] = {stream == STDOUT_FILENO ? "<stdout>" : "<stderr>", "the program's messages",
                     ""};
  for (const auto& [key, output] : outputs_) {
    const std::optional<FileIdentity> file = IdentifyFile(output.path);
    if (!file) continue;
    const auto [other, isNew] = seen.try_emplace(*file, output);
    if (isNew) continue;
    const OutputFile& first = other->second;
    Refuse(output, "this file is also the one for " + first.what +
                       (first.path == output.path ? "" : ", " + InQuotes(first.path)));
  }
}

void RunFiles::WarnOfHardLinks(const OutputFile& output, Log& log) {
  struct stat status;
  if (stat(output.path.c_str(), &status) != 0 || status.st_nlink < 2) return;
  if (!warned_.insert(output.path).second) return;
  log.Warning(InQuotes(output.path) + " has " + std::to_string(status.st_nlink) +
              " names (hard links): this one gets the new file, the others keep the old one");
}

void RunFiles::Check(Log& log) {
  for (const auto& [key, output] : outputs_) {
    CheckInputs(output);
    CheckSceneName(output);
  }
  CheckOthers();
  for (const auto& [key, output] : outputs_) {
    CheckWritable(output.path);
    WarnOfHardLinks(output, log);
  }
}

std::string RunFiles::PartialPicture(const std::string& path) const {
  const fs::path file(path);
  const bool isExr = file.extension() == ".exr";
  const std::string stem = isExr ? (file.parent_path() / file.stem()).string() : path;
  std::set<FileIdentity> others;
  for (const auto& [key, output] : outputs_)
    if (const auto other = IdentifyFile(output.path)) others.insert(*other);
  for (int i = 1;; ++i) {
    const std::string name = stem + ".partial" + (i > 1 ? "-" + std::to_string(i) : "") + ".exr";
    const std::optional<FileIdentity> identity = IdentifyFile(name);
    const bool isUsed = identity && (inputs_.contains(*identity) || others.contains(*identity));
    if (!isUsed && (!Exists(name) || IsOwnPicture(name))) return name;
  }
}

}  // namespace exphoton::cli
