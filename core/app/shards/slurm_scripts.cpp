// SPDX-License-Identifier: BSD-2-Clause
#include "core/app/shards/slurm_scripts.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "core/app/options/arguments.h"
#include "core/app/options/option_parser.h"
#include "core/app/options/values.h"
#include "core/app/output/output_files.h"
#include "core/base/error.h"

namespace exphoton::cli {
namespace {

constexpr const char* kSlurmMark = "# Written by exphoton.";

void CheckOwnScript(const std::string& path) {
  std::ifstream file(path);
  if (!file) return;
  std::string shell, mark;
  std::getline(file, shell);
  std::getline(file, mark);
  if (mark.starts_with(kSlurmMark)) return;
  throw Error(ExitStatus::File,
              "cannot write \"" + path + "\": the existing file is not a script of this program",
              {}, "--folder DIR names another folder");
}

}  // namespace

std::string ShellWord(const std::string& text) { return CommandLineText({text}); }

std::string AbsolutePath(const std::string& path) {
  return std::filesystem::absolute(path).lexically_normal().string();
}

std::string ProgramPath() { return std::filesystem::read_symlink("/proc/self/exe").string(); }

void AddArrayOptions(OptionParser& app, ArrayOptions* options) {
  app.Add("--engine", options->engine, "the scheduler (default slurm)").OneOf({"slurm"});
  app.Add("--rounds", options->rounds,
          "how often tasks are submitted before the merge gives up (default 3)")
      .Between(1, 1000);
  app.Add("--sbatch", options->sbatch, "an option for sbatch: --sbatch=--partition=short")
      .TypeName("OPTION")
      .OnePerUse();
  app.AddFlag("--submit", options->submits, "also submit the jobs");
}

void CheckArrayOptions(const ArrayOptions& options) {
  for (const std::string& option : options.sbatch)
    if (!option.starts_with("-") || option.find('\n') != std::string::npos)
      FailUsage("--sbatch takes an option of sbatch, not \"" + option + '"',
                "for example --sbatch=--partition=short");
}

std::string SlurmScripts::Head(const std::string& purpose) const {
  std::string logs;  // for sbatch, to which %% is a per cent sign
  for (const char c : Logs()) logs += c == '%' ? std::string("%%") : std::string(1, c);
  std::string text = "#!/bin/sh\n" + std::string(kSlurmMark) + " This script " + purpose + ".\n" +
                     "#SBATCH --job-name=exphoton\n#SBATCH --output=\"" + logs + "/%x-%j.txt\"\n";
  for (const std::string& option : job_.sbatch) text += "#SBATCH " + option + "\n";
  return text;
}

std::string SlurmScripts::Task() const {
  return Head("is one task of a job array") + job_.task + "\n";
}

// The dependency afterany also waits for tasks that fail. With afterok the merge would wait for
// ever: Slurm does not repeat a task whose process was killed.
std::string SlurmScripts::Merge() const {
  return Head("ends the work, or submits the " + job_.noun + " that are missing") +
         "set -eu\n"
         "round=${1:-0}\n" +
         job_.missing +
         "\nif [ -z \"$missing\" ]; then\n"
         "  " +
         job_.finish +
         "\n  exit 0\nfi\n"
         "if [ \"$round\" -ge " +
         std::to_string(job_.rounds) +
         " ]; then\n"
         "  echo \"" +
         job_.noun + " $missing are missing after $round rounds; see \"" + ShellWord(Logs()) +
         " >&2\n"
         "  exit 1\n"
         "fi\n"
         "job=$(sbatch --parsable --array=\"$missing\" " +
         ShellWord(TaskPath()) +
         ")\n"
         "job=${job%%;*}\n"
         "echo \"submitted " +
         job_.noun +
         " $missing as job $job\"\n"
         "sbatch --dependency=afterany:\"$job\" " +
         ShellWord(MergePath()) + " $((round + 1))\n";
}

void SlurmScripts::Write() const {
  CheckOwnScript(TaskPath());
  CheckOwnScript(MergePath());
  MakeFolder(job_.folder);
  MakeFolder(Logs());
  WriteTextFile(TaskPath(), Task());
  WriteTextFile(MergePath(), Merge());
}

void SlurmScripts::Submit() const {
  const int status = std::system(("sh " + ShellWord(MergePath())).c_str());
  if (status == 0) return;
  throw Error(ExitStatus::Resource,
              "the jobs could not be submitted: \"" + MergePath() + "\" failed", {},
              "sbatch must be in the PATH and reach the cluster");
}

void SlurmScripts::Announce(Log& log) const {
  log.Notice("wrote \"" + TaskPath() + "\" and \"" + MergePath() + "\"");
  log.Notice("sh " + ShellWord(MergePath()) + " submits the jobs");
}

}  // namespace exphoton::cli
