// SPDX-License-Identifier: BSD-2-Clause
#include "core/app/study/study_tasks.h"

#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <filesystem>

#include "core/app/options/arguments.h"
#include "core/app/options/values.h"
#include "core/app/output/output_files.h"
#include "core/app/study/study_runner.h"
#include "core/base/error.h"

namespace exphoton::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* kReference = "reference";
constexpr const char* kReferenceState = "reference/state.txt";

std::string TasksFolder(const StudyOptions& options) {
  return AbsolutePath(options.folder) + ".tasks";
}

// Returns whether the folder's name is a number.
bool IsTaskFolder(const fs::directory_entry& entry) {
  const std::string name = entry.path().filename().string();
  return entry.is_directory() && !name.empty() &&
         name.find_first_not_of("0123456789") == std::string::npos;
}

bool HasReferenceTask(const StudyOptions& options) { return !options.makeReference.empty(); }

bool HasReference(const std::string& folder) {
  return fs::is_regular_file(folder + "/" + kReferenceState);
}

// Returns the study's own arguments, without those that make or place the array.
std::vector<std::string> TaskArguments(const std::vector<std::string>& given) {
  constexpr std::string_view kWithValue[] = {"--tasks",  "--engine", "--rounds",
                                             "--sbatch", "--out",    "-o"};
  constexpr std::string_view kFlags[] = {"--submit", "--share-nodes"};
  std::vector<std::string> kept;
  for (std::size_t i = 0; i < given.size(); ++i) {
    const std::string name = given[i].substr(0, given[i].find('='));
    if (std::ranges::find(kFlags, name) != std::end(kFlags)) continue;
    if (std::ranges::find(kWithValue, name) == std::end(kWithValue)) {
      kept.push_back(given[i]);
    } else if (name == given[i]) {
      ++i;  // the value is the next argument
    }
  }
  return kept;
}

ArrayJob StudyJob(const StudyOptions& options) {
  std::vector<std::string> words{ProgramPath(), "study"};
  const std::vector<std::string> own = TaskArguments(options.arguments);
  words.insert(words.end(), own.begin(), own.end());
  const std::string study = CommandLineText(words), count = std::to_string(options.taskCount);
  const std::string folder = ShellWord(TasksFolder(options));
  const std::string here = "cd " + ShellWord(fs::current_path().string());
  ArrayJob job;
  job.folder = TasksFolder(options);
  job.noun = "tasks";
  job.sbatch = options.array.sbatch;
  if (!options.sharesNodes) job.sbatch.push_back("--exclusive");
  job.rounds = options.array.rounds;
  job.task = here + "\nexec " + study + " \\\n  --task \"$SLURM_ARRAY_TASK_ID/" + count +
             "\" --out " + folder + "/\"$SLURM_ARRAY_TASK_ID\"" +
             (options.sharesNodes ? "" : " --alone");
  job.missing = here + "\nmissing=$(" + study + " --from " + folder + " --missing " + count + ")";
  job.finish = study + " --from " + folder + " --out " + ShellWord(AbsolutePath(options.folder));
  return job;
}

// Study files may hold these options, because they are read both with and without --tasks.
void CheckArrayWords(const StudyOptions& options) {
  if (options.taskCount > 0) return;
  for (const std::string& argument : options.arguments)
    for (const std::string name : {"--share-nodes", "--rounds", "--engine"})
      if (argument == name || argument.starts_with(name + '='))
        FailUsage(name + " needs --tasks N, the number of jobs");
}

}  // namespace

StudyTask ParseStudyTask(const std::string& text) {
  StudyTask task;
  const char* const end = text.data() + text.size();
  const auto index = std::from_chars(text.data(), end, task.index);
  const bool hasSlash = index.ec == std::errc() && index.ptr != end && *index.ptr == '/';
  const auto count = hasSlash ? std::from_chars(index.ptr + 1, end, task.count) : index;
  if (!hasSlash || count.ec != std::errc() || count.ptr != end || task.count < 1 ||
      task.index < 0 || task.index > task.count)
    FailUsage("--task takes I/N with I from 0 to N, not \"" + text + '"',
              "3/16 is the third of 16 tasks, 0/16 makes the reference");
  return task;
}

void CheckTasks(const StudyOptions& options) {
  const int uses = int(options.taskCount > 0) + int(options.task.has_value()) +
                   int(!options.tasksFolder.empty());
  if (uses > 1) FailUsage("--tasks, --task and --from exclude each other");
  CheckArrayOptions(options.array);
  if (options.taskCount == 0 && (options.array.submits || !options.array.sbatch.empty()))
    FailUsage("--submit and --sbatch need --tasks N, the number of jobs");
  CheckArrayWords(options);
  if (options.isAlone && !options.task) FailUsage("--alone needs --task I/N");
  if (options.missingOf > 0 && options.tasksFolder.empty())
    FailUsage("--missing needs --from DIR, the folder of the tasks");
  if (options.task && options.task->index == 0 && !HasReferenceTask(options))
    FailUsage("task 0 makes the reference, but the study makes none",
              "--make-reference \"path maxdepth=100\" asks for one");
}

void WriteStudyScripts(const StudyOptions& options, std::size_t settings) {
  const std::size_t renders = settings * std::size_t(options.seeds);
  Log log(options.isQuiet ? Log::Level::Quiet : Log::Level::Normal);
  if (std::size_t(options.taskCount) > renders)
    log.Warning("the study has only " + std::to_string(renders) + " renders for " +
                std::to_string(options.taskCount) + " tasks");
  const SlurmScripts scripts(StudyJob(options));
  scripts.Write();
  if (options.array.submits) return scripts.Submit();
  scripts.Announce(log);
}

void RunStudyTask(const StudyOptions& options, const SceneFacts& scene, const ProgramFacts& program,
                  const std::vector<study::Setting>& settings, StudyFolder& folder) {
  StudyRunner runner(options, folder, scene, program);
  if (options.task->index == 0) {
    PrepareReference(options, runner);
    return;
  }
  MakeFolder(options.folder + "/images");
  runner.RunAll(settings);
}

std::string MissingTasksText(const StudyOptions& options, const SceneFacts& scene,
                             const ProgramFacts& program,
                             const std::vector<study::Setting>& settings) {
  std::set<int> missing =
      FinishedRuns(options, scene, program).MissingTasks(settings, options.missingOf);
  const auto hasReference = [](const std::string& folder) { return HasReference(folder); };
  if (HasReferenceTask(options) &&
      std::ranges::none_of(TaskFolders(options.tasksFolder), hasReference))
    missing.insert(0);
  std::string text;
  for (const int task : missing) text += (text.empty() ? "" : ",") + std::to_string(task);
  return text.empty() ? "" : text + "\n";
}

void CheckTaskFolders(const std::string& folder) {
  std::error_code error;
  const fs::directory_iterator readable(folder, error);
  if (error)
    throw Error(ExitStatus::File, "cannot read the folder \"" + folder + "\": " + error.message(),
                {}, "--from takes the folder in which tasks made their folders (study --tasks N)");
  if (TaskFolders(folder).empty())
    throw Error(ExitStatus::File, "the folder \"" + folder + "\" has no results of tasks", {},
                "study --task I/N makes them");
}

std::vector<std::string> TaskFolders(const std::string& folder) {
  std::vector<std::string> folders;
  if (folder.empty()) return folders;
  std::error_code error;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error))
    if (IsTaskFolder(*it)) folders.push_back(it->path().string());
  const auto number = [](const std::string& path) { return std::stol(fs::path(path).filename()); };
  std::ranges::sort(folders, {}, number);
  return folders;
}

void TakeReferenceOfTask(const std::string& tasks, StudyFolder& folder) {
  if (HasReference(folder.Path())) return;
  for (const std::string& task : TaskFolders(tasks)) {
    if (!HasReference(task)) continue;
    MakeFolder(folder.Path() + "/" + kReference);
    // The state is written last: without it the halves count for nothing.
    for (const auto& entry : fs::directory_iterator(task + "/" + kReference)) {
      const std::string name = std::string(kReference) + "/" + entry.path().filename().string();
      if (name != kReferenceState) folder.Take(task + "/" + name, name);
    }
    return folder.Take(task + "/" + kReferenceState, kReferenceState);
  }
}

std::string NodeName() {
  char name[256] = "";
  if (gethostname(name, sizeof name - 1) != 0 || !name[0]) return "unknown";
  return name;
}

}  // namespace exphoton::cli
