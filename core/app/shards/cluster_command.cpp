// SPDX-License-Identifier: BSD-2-Clause
// RunCluster writes two shell scripts. shard.sh renders one task of a job array. merge.sh makes the
// picture, or submits the missing tasks and itself behind them.
#include "core/app/shards/cluster_command.h"

#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "core/app/options/arguments.h"
#include "core/app/options/errors.h"
#include "core/app/options/option_parser.h"
#include "core/app/options/options.h"
#include "core/app/options/values.h"
#include "core/app/output/output_files.h"
#include "core/base/error.h"
#include "core/base/log.h"

namespace exphoton::cli {
namespace {

constexpr const char* kSlurmMark = "# Written by exphoton cluster.";

struct ClusterOptions {
  std::string scene, outfile, folder, engine = "slurm";
  std::vector<std::string> sbatch, render;
  int shards = 0, rounds = 3;
  bool submits = false, isQuiet = false;
};

// Arguments after "--" are options of exphoton render.
ClusterOptions ParseClusterOptions(const std::vector<std::string>& arguments) {
  ClusterOptions options;
  const auto end = std::find(arguments.begin(), arguments.end(), "--");
  if (end != arguments.end()) options.render.assign(end + 1, arguments.end());
  OptionParser app("Writes scripts that render a scene in shards with a scheduler.",
                   "exphoton cluster");
  app.Add("scene", options.scene, "the scene").Required();
  app.Add("--shards", options.shards, "the number of shards").Required().Between(1, 100000);
  app.Add("-o,--outfile", options.outfile, "the picture").Required().TypeName("FILE");
  app.Add("--engine", options.engine, "the scheduler (default slurm)").OneOf({"slurm"});
  app.Add("--folder", options.folder, "the folder of scripts and parts (default FILE.parts)")
      .TypeName("DIR");
  app.Add("--rounds", options.rounds,
          "how often shards are submitted before the merge gives up (default 3)")
      .Between(1, 1000);
  app.Add("--sbatch", options.sbatch, "an option for sbatch: --sbatch=--partition=short")
      .TypeName("OPTION")
      .OnePerUse();
  app.AddFlag("--submit", options.submits, "also submit the jobs");
  app.AddFlag("--quiet", options.isQuiet, "errors and warnings only");
  app.Footer(
      "Options of exphoton render follow after --: exphoton cluster room.pbrt --shards 64 -o "
      "room.exr -- --spp 256");
  app.Parse({arguments.begin(), end});
  if (options.folder.empty()) options.folder = options.outfile + ".parts";
  for (const std::string& option : options.sbatch)
    if (!option.starts_with("-") || option.find('\n') != std::string::npos)
      FailUsage("--sbatch takes an option of sbatch, not \"" + option + '"',
                "for example --sbatch=--partition=short");
  return options;
}

std::string AbsolutePath(const std::string& path) {
  return std::filesystem::absolute(path).lexically_normal().string();
}

std::string Word(const std::string& text) { return CommandLineText({text}); }

class SlurmScripts {
 public:
  explicit SlurmScripts(const ClusterOptions& options)
      : options_(options),
        folder_(AbsolutePath(options.folder)),
        program_(std::filesystem::read_symlink("/proc/self/exe").string()) {}

  std::string ShardPath() const { return folder_ + "/shard.sh"; }
  std::string MergePath() const { return folder_ + "/merge.sh"; }
  std::string Parts() const { return folder_ + "/parts"; }
  std::string Logs() const { return folder_ + "/logs"; }

  std::string Shard() const {
    std::vector<std::string> words{program_, "render", AbsolutePath(options_.scene)};
    words.insert(words.end(), options_.render.begin(), options_.render.end());
    return Head("renders one shard, as a task of a job array") + "exec " + CommandLineText(words) +
           " \\\n  --shard \"$SLURM_ARRAY_TASK_ID/" + std::to_string(options_.shards) + "\" -o " +
           Word(Parts()) + " \\\n  --nthreads \"${SLURM_CPUS_ON_NODE:-0}\" --no-progress\n";
  }

  // The dependency afterany also waits for tasks that fail. With afterok the merge would wait for
  // ever: Slurm does not repeat a task whose process was killed.
  std::string Merge() const {
    const std::string count = std::to_string(options_.shards);
    return Head("makes the picture, or submits the shards that are missing") +
           "set -eu\n"
           "round=${1:-0}\n"
           "program=" +
           Word(program_) +
           "\n"
           "parts=" +
           Word(Parts()) +
           "\n"
           "missing=$(\"$program\" merge --missing --shards " +
           count +
           " \"$parts\")\n"
           "if [ -z \"$missing\" ]; then\n"
           "  exec \"$program\" merge \"$parts\" -o " +
           Word(AbsolutePath(options_.outfile)) +
           "\n"
           "fi\n"
           "if [ \"$round\" -ge " +
           std::to_string(options_.rounds) +
           " ]; then\n"
           "  echo \"parts $missing are missing after $round rounds; see " +
           Logs() +
           "\" >&2\n"
           "  exit 1\n"
           "fi\n"
           "job=$(sbatch --parsable --array=\"$missing\" " +
           Word(ShardPath()) +
           ")\n"
           "job=${job%%;*}\n"
           "echo \"submitted shards $missing as job $job\"\n"
           "sbatch --dependency=afterany:\"$job\" " +
           Word(MergePath()) + " $((round + 1))\n";
  }

 private:
  std::string Head(const std::string& purpose) const {
    std::string text = "#!/bin/sh\n" + std::string(kSlurmMark) + " This script " + purpose + ".\n" +
                       "#SBATCH --job-name=exphoton\n#SBATCH --output=\"" + Logs() +
                       "/%x-%j.txt\"\n";
    for (const std::string& option : options_.sbatch) text += "#SBATCH " + option + "\n";
    return text;
  }

  const ClusterOptions& options_;
  std::string folder_, program_;
};

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

// Throws for options of exphoton render that are wrong, before any job fails for them.
void CheckRenderOptions(const ClusterOptions& options) {
  std::vector<std::string> words{options.scene, "--shard", "1/" + std::to_string(options.shards),
                                 "-o", options.folder + "/parts"};
  words.insert(words.end(), options.render.begin(), options.render.end());
  const RenderCommand command = ParseRenderCommand(words, RenderMode::Render);
  if (!std::filesystem::is_regular_file(options.scene))
    throw Error(ExitStatus::File, "cannot read the scene \"" + options.scene + "\": no such file");
  if (command.scenes.size() != 1) FailUsage("a cluster renders one scene");
  CheckWritable(options.outfile);
}

void Submit(const SlurmScripts& scripts) {
  const int status = std::system(("sh " + Word(scripts.MergePath())).c_str());
  if (status == 0) return;
  throw Error(ExitStatus::Resource,
              "the jobs could not be submitted: \"" + scripts.MergePath() + "\" failed", {},
              "sbatch must be in the PATH and reach the cluster");
}

}  // namespace

int RunCluster(const std::vector<std::string>& arguments) {
  return Guarded([&] {
    const ClusterOptions options = ParseClusterOptions(arguments);
    CheckRenderOptions(options);
    const SlurmScripts scripts(options);
    CheckOwnScript(scripts.ShardPath());
    CheckOwnScript(scripts.MergePath());
    MakeFolder(scripts.Parts());
    MakeFolder(scripts.Logs());
    WriteTextFile(scripts.ShardPath(), scripts.Shard());
    WriteTextFile(scripts.MergePath(), scripts.Merge());
    Log log(options.isQuiet ? Log::Level::Quiet : Log::Level::Normal);
    if (options.submits) return Submit(scripts);
    log.Notice("wrote \"" + scripts.ShardPath() + "\" and \"" + scripts.MergePath() + "\"");
    log.Notice("sh " + Word(scripts.MergePath()) + " submits the jobs");
  });
}

}  // namespace exphoton::cli
