// SPDX-License-Identifier: BSD-2-Clause
#include "core/app/study/finished_runs.h"

#include <filesystem>

#include "core/app/study/study_tasks.h"
#include "core/imaging/files/exr.h"

namespace exphoton::cli {

std::vector<StudyRun> RunsOfStudy(std::size_t settings, int seeds) {
  std::vector<StudyRun> runs;
  for (int seed = 1; seed <= seeds; ++seed)
    for (std::size_t i = 0; i < settings; ++i) runs.push_back({i, std::uint64_t(seed)});
  return runs;
}

std::string RunFileName(const study::Setting& setting, std::uint64_t seed) {
  return "images/" + study::RunName(setting, seed);
}

std::string FinishedRuns::Key(const std::vector<std::string>& arguments,
                              const std::string& processor) const {
  std::string text = program_.fingerprint + "|" + processor + "|" + scene_.hash;
  // Skip "render" and the scene's path; scene_.hash identifies the scene.
  for (std::size_t i = 2; i < arguments.size(); ++i) text += "|" + arguments[i];
  return HashOfText(text);
}

bool FinishedRuns::Find(const std::string& folder, const std::string& name,
                        const std::vector<std::string>& arguments, study::RunRow* row) const {
  const std::string base = folder + "/" + name;
  std::error_code error;
  if (!std::filesystem::exists(base + ".json", error) || error) return false;
  try {
    *row = study::RowFromJson(ReadTextFile(base + ".json"));
    const Image image = ReadExr(base + ".exr");
    // Tasks may run on other processors.
    const std::string& processor = row->IsOfTask() ? row->processor : program_.processor;
    return row->key == Key(arguments, processor) && image.Width() == scene_.width &&
           image.Height() == scene_.height;
  } catch (const std::exception&) {
    return false;  // damaged: render again
  }
}

std::string FinishedRuns::FindInTasks(const std::string& name,
                                      const std::vector<std::string>& arguments,
                                      study::RunRow* row) const {
  for (const std::string& folder : TaskFolders(options_.tasksFolder))
    if (Find(folder, name, arguments, row)) return folder;
  return "";
}

std::set<int> FinishedRuns::MissingTasks(const std::vector<study::Setting>& settings,
                                         int count) const {
  std::set<int> missing;
  const std::vector<StudyRun> runs = RunsOfStudy(settings.size(), options_.seeds);
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const study::Setting& setting = settings[runs[i].setting];
    const auto arguments = RunArguments(options_, setting, runs[i].seed);
    study::RunRow row;
    if (FindInTasks(RunFileName(setting, runs[i].seed), arguments, &row).empty())
      missing.insert(StudyTask::Of(i, count));
  }
  return missing;
}

}  // namespace exphoton::cli
