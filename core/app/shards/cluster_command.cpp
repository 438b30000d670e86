// SPDX-License-Identifier: BSD-2-Clause
// RunCluster divides a picture into shards, or an animation into frames.
#include "core/app/shards/cluster_command.h"

#include <algorithm>
#include <filesystem>

#include "core/app/options/arguments.h"
#include "core/app/options/errors.h"
#include "core/app/options/option_parser.h"
#include "core/app/options/options.h"
#include "core/app/options/values.h"
#include "core/app/output/output_files.h"
#include "core/app/output/output_names.h"
#include "core/app/process/signals.h"
#include "core/app/shards/part_set.h"
#include "core/app/shards/slurm_scripts.h"
#include "core/base/error.h"
#include "core/parser/frame_name.h"
#include "core/parser/render_setup.h"

namespace exphoton::cli {
namespace {

namespace fs = std::filesystem;

// MaxArraySize of Slurm is at most 4,000,001.
constexpr int kMaxTasks = 100000;

struct ClusterOptions {
  std::string scene, outfile, folder, frames;
  std::vector<std::string> render;
  ArrayOptions array;
  int shards = 0;
  bool isQuiet = false;
};

// Arguments after "--" are options of exphoton render.
ClusterOptions ParseClusterOptions(const std::vector<std::string>& arguments) {
  ClusterOptions options;
  const auto end = std::find(arguments.begin(), arguments.end(), "--");
  if (end != arguments.end()) options.render.assign(end + 1, arguments.end());
  OptionParser app("Writes scripts that render a scene in shards, or frames, with a scheduler.",
                   "exphoton cluster");
  app.Add("scene", options.scene, "the scene").Required();
  app.Add("--shards", options.shards, "render one picture in this number of shards")
      .Between(1, kMaxTasks);
  app.Add("--frames", options.frames,
          "render an animation, a frame in each task; %d in names stands for a frame's number")
      .TypeName("A-B");
  app.Add("-o,--outfile", options.outfile, "the picture; with --frames, NAME%d.exr")
      .Required()
      .TypeName("FILE");
  app.Add("--folder", options.folder, "the folder of scripts and parts (default FILE.parts)")
      .TypeName("DIR");
  AddArrayOptions(app, &options.array);
  app.AddFlag("--quiet", options.isQuiet, "errors and warnings only");
  app.Footer(
      "Options of exphoton render follow after --: exphoton cluster room.pbrt --shards 64 -o "
      "room.exr -- --spp 256");
  app.Parse({arguments.begin(), end});
  CheckArrayOptions(options.array);
  if ((options.shards > 0) == !options.frames.empty())
    FailUsage("exphoton cluster needs either --shards N or --frames A-B",
              "--shards divides one picture, --frames an animation");
  if (options.folder.empty()) options.folder = NameWithoutNumber(options.outfile) + ".parts";
  return options;
}

// Returns the command of the tasks, without what differs between them.
std::string RenderText(const ClusterOptions& options) {
  std::vector<std::string> words{ProgramPath(), "render", AbsolutePath(options.scene)};
  words.insert(words.end(), options.render.begin(), options.render.end());
  return "exec " + CommandLineText(words);
}

bool HasOption(const std::vector<std::string>& words, const std::string& option) {
  return std::any_of(words.begin(), words.end(), [&](const std::string& word) {
    return word.substr(0, word.find('=')) == option;
  });
}

// Returns the last options of a task. A number of threads that the user states takes precedence.
std::string TaskEnd(const ClusterOptions& options) {
  const bool statesThreads =
      HasOption(options.render, "--nthreads") || HasOption(options.render, "--ncores");
  return std::string(" \\\n  ") +
         (statesThreads ? "" : "--nthreads \"${SLURM_CPUS_ON_NODE:-0}\" ") + "--no-progress";
}

ArrayJob ShardJob(const ClusterOptions& options) {
  const std::string count = std::to_string(options.shards);
  const std::string folder = AbsolutePath(options.folder);
  const std::string program = ShellWord(ProgramPath()), parts = ShellWord(folder + "/parts");
  ArrayJob job;
  job.folder = folder;
  job.noun = "shards";
  job.task = RenderText(options) + " \\\n  --shard \"$SLURM_ARRAY_TASK_ID/" + count + "\" -o " +
             parts + TaskEnd(options);
  job.missing = "missing=$(" + program + " merge --missing --shards " + count + " " + parts + ")";
  job.finish = program + " merge " + parts + " -o " + ShellWord(AbsolutePath(options.outfile));
  return job;
}

// A picture is written as a whole or not at all, so a frame whose picture exists is done.
ArrayJob FrameJob(const ClusterOptions& options) {
  const Frames frames = ParseFrames(options.frames);
  const std::string outfile = AbsolutePath(options.outfile);
  ArrayJob job;
  job.folder = AbsolutePath(options.folder);
  job.noun = "frames";
  job.task = RenderText(options) + " \\\n  --frames \"$SLURM_ARRAY_TASK_ID\" -o " +
             ShellWord(outfile) + TaskEnd(options);
  job.missing = "missing=\nframe=" + std::to_string(frames.first) + "\nwhile [ $frame -le " +
                std::to_string(frames.last) +
                " ]; do\n"
                "  picture=$(printf " +
                ShellWord(FrameFormat(outfile)) +
                " $frame)\n"
                "  [ -s \"$picture\" ] || missing=$missing${missing:+,}$frame\n"
                "  frame=$((frame + 1))\n"
                "done";
  job.finish = "echo 'all frames are rendered'";
  return job;
}

// Pictures of an earlier run would count as frames that are done.
void CheckNoFrameExists(const ClusterOptions& options) {
  const Frames frames = ParseFrames(options.frames);
  if (frames.last - frames.first >= kMaxTasks)
    FailUsage("--frames " + options.frames + " has more than " + std::to_string(kMaxTasks) +
              " frames");
  for (int frame = frames.first; frame <= frames.last; ++frame) {
    const std::string name = FrameName(options.outfile, frame);
    if (!fs::exists(fs::symlink_status(name))) continue;
    throw Error(ExitStatus::File,
                "the picture \"" + name + "\" exists, so its frame would not be rendered", {},
                "remove it, or name others with -o; to render what is missing after a failure, run "
                "merge.sh again");
  }
}

// Parts of an earlier run would count as shards that are done, even if they are of another render.
void CheckNoPartExists(const ClusterOptions& options) {
  const std::string folder = options.folder + "/parts";
  if (!fs::is_directory(folder)) return;
  const std::vector<std::string> parts = PartFilesAt(folder);
  if (parts.empty()) return;
  throw Error(ExitStatus::File,
              "the part \"" + parts.front() + "\" exists, so its shard would not be rendered", {},
              "remove all old parts, or name another folder with --folder; to render the missing "
              "shards after a failure, run merge.sh again");
}

// Parses the command of a task. `own` are the options that the scripts add.
RenderCommand ParseTask(const ClusterOptions& options, const std::vector<std::string>& own) {
  std::vector<std::string> words{options.scene};
  words.insert(words.end(), own.begin(), own.end());
  words.insert(words.end(), options.render.begin(), options.render.end());
  return ParseRenderCommand(words, RenderMode::Render);
}

// A shard does not get the name of the picture. Therefore the options are also checked with it.
RenderCommand ParseTasks(const ClusterOptions& options) {
  if (options.shards == 0)
    return ParseTask(options, {"--frames", options.frames, "-o", options.outfile});
  if (HasOption(options.render, "--shard"))
    FailUsage("--shard is not for the options after --: each task has a shard of its own");
  RenderCommand picture = ParseTask(options, {"-o", options.outfile});
  if (picture.png.IsGiven())
    FailUsage("--exposure and --tone-curve are for a whole picture, but a shard is a part of one",
              "-o NAME.exr keeps all values, and exphoton convert makes a PNG of it");
  if (!picture.statsFile.empty() && picture.statsFile != "-")
    FailUsage("--stats-json names one file, but every shard would write it",
              "exphoton merge PARTS -o PICTURE --stats-json FILE writes the sum of all parts");
  ParseTask(options,
            {"--shard", "1/" + std::to_string(options.shards), "-o", options.folder + "/parts"});
  return picture;
}

// Loads the scene, so that its errors show here and not in each task.
void CheckScene(const RenderCommand& command, const std::string& path) {
  LoadOptions load = command.load;
  load.stop = &StopFlag();
  Log log(command.logLevel);
  FileSource source;
  const std::size_t count = LoadScenes(source, path, load, log).size();
  if (count == 1) return;
  throw Error(ExitStatus::CommandLine, "a cluster renders one picture, but \"" + path +
                                           "\" holds " + std::to_string(count) + " scenes");
}

// Throws for options of exphoton render that are wrong, before any job fails for them.
void CheckRenderOptions(const ClusterOptions& options) {
  const RenderCommand command = ParseTasks(options);
  OutputNames(command).CheckEndings();
  if (command.scenes.size() != 1) FailUsage("a cluster renders one scene");
  for (const char* option : {"--check", "--explain"})
    if (HasOption(options.render, option))
      FailUsage(std::string(option) + " is not for the options after --: the tasks make pictures");
  const bool isNumbered = command.frames && HasFrameNumber(options.scene);
  const std::string scene =
      isNumbered ? FrameName(options.scene, command.frames->first) : options.scene;
  if (!fs::is_regular_file(scene))
    throw Error(ExitStatus::File, "cannot read the scene \"" + scene + "\": no such file");
  CheckScene(command, scene);
  CheckWritable(command.frames ? FrameName(options.outfile, command.frames->first)
                               : options.outfile);
}

}  // namespace

int RunCluster(const std::vector<std::string>& arguments) {
  return Guarded([&] {
    const ClusterOptions options = ParseClusterOptions(arguments);
    CheckRenderOptions(options);
    ArrayJob job = options.shards > 0 ? ShardJob(options) : FrameJob(options);
    job.sbatch = options.array.sbatch;
    job.rounds = options.array.rounds;
    const SlurmScripts scripts(std::move(job));
    if (options.shards > 0)
      CheckNoPartExists(options);
    else
      CheckNoFrameExists(options);
    scripts.Write();
    if (options.shards > 0) MakeFolder(options.folder + "/parts");
    Log log(options.isQuiet ? Log::Level::Quiet : Log::Level::Normal);
    if (options.array.submits) return scripts.Submit();
    scripts.Announce(log);
  });
}

}  // namespace exphoton::cli
