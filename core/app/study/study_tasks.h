// SPDX-License-Identifier: BSD-2-Clause
// A study can be divided into tasks for a scheduler. Each task renders its share into a folder of
// its own, DIR.tasks/I. The study then takes their renders over (--from) and goes on as if it had
// made them itself. Task 0 makes the reference.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/app/analysis/plan.h"

namespace exphoton::cli {

struct StudyOptions;
struct SceneFacts;
struct ProgramFacts;
class StudyFolder;

struct StudyTask {
  int index = 0, count = 1;  // 0 <= index <= count

  // Returns the task of the render at this place of the plan.
  static int Of(std::size_t place, int count) { return int(place % std::size_t(count)) + 1; }
};

// "3/16". Throws Error(CommandLine).
StudyTask ParseStudyTask(const std::string& text);

// Checks the options of tasks against each other. Throws Error(CommandLine).
void CheckTasks(const StudyOptions& options);

// Writes the scripts of an array, and submits them if the options say so.
void WriteStudyScripts(const StudyOptions& options, std::size_t settings);

// Renders the share of options.task.
void RunStudyTask(const StudyOptions& options, const SceneFacts& scene, const ProgramFacts& program,
                  const std::vector<study::Setting>& settings, StudyFolder& folder);

// Returns the tasks that have to run, "1,5,6" and a line end, or "" if there are none.
std::string MissingTasksText(const StudyOptions& options, const SceneFacts& scene,
                             const ProgramFacts& program,
                             const std::vector<study::Setting>& settings);

// Returns the folders of tasks in a folder, in the order of their numbers; none if `folder` is "".
std::vector<std::string> TaskFolders(const std::string& folder);

// Throws Error if the folder cannot be read or has no folder of a task.
void CheckTaskFolders(const std::string& folder);

// Copies the reference that task 0 made, unless the study has one.
void TakeReferenceOfTask(const std::string& tasks, StudyFolder& folder);

std::string NodeName();  // of this machine

}  // namespace exphoton::cli
