// SPDX-License-Identifier: BSD-2-Clause
// SlurmScripts writes the two scripts of an array of jobs. task.sh is one task. merge.sh ends the
// work, or submits the tasks that are missing and itself behind them.
#pragma once

#include <string>
#include <vector>

#include "core/base/log.h"

namespace exphoton::cli {

// ArrayJob describes work that is divided into tasks. Texts for the shell are quoted already.
struct ArrayJob {
  std::string folder;   // of the scripts and logs; absolute
  std::string task;     // for the shell: runs the task with the index $SLURM_ARRAY_TASK_ID
  std::string missing;  // for the shell: sets the variable `missing` to the list of tasks to do
  std::string finish;   // for the shell: the command that follows when nothing is missing
  std::string noun;     // "shards"
  std::vector<std::string> sbatch;  // options of sbatch
  int rounds = 3;                   // how often tasks are submitted before the work gives up
};

class SlurmScripts {
 public:
  explicit SlurmScripts(ArrayJob job) : job_(std::move(job)) {}

  // Throws Error(File) if files that are not such scripts are in the way.
  void Write() const;
  // Runs merge.sh. Throws Error(Resource) if that fails.
  void Submit() const;
  // Says what was written, and how to submit it.
  void Announce(Log& log) const;

  std::string TaskPath() const { return job_.folder + "/task.sh"; }
  std::string MergePath() const { return job_.folder + "/merge.sh"; }
  std::string Logs() const { return job_.folder + "/logs"; }

 private:
  std::string Head(const std::string& purpose) const;
  std::string Task() const;
  std::string Merge() const;

  ArrayJob job_;
};

// The options of commands that make such scripts.
struct ArrayOptions {
  std::string engine = "slurm";
  std::vector<std::string> sbatch;
  int rounds = 3;
  bool submits = false;
};
class OptionParser;
void AddArrayOptions(OptionParser& app, ArrayOptions* options);
// Throws Error(CommandLine).
void CheckArrayOptions(const ArrayOptions& options);

std::string ShellWord(const std::string& text);     // quoted where necessary
std::string AbsolutePath(const std::string& path);  // normalised
std::string ProgramPath();                          // of this process

}  // namespace exphoton::cli
