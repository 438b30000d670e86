// SPDX-License-Identifier: BSD-2-Clause
// From a scene file to a picture: load, check the output, render, write, report.
#include "core/cli/render_command.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <new>
#include <set>

#include "core/base/memory.h"
#include "core/base/progress.h"
#include "core/cli/errors.h"
#include "core/cli/interrupt_watch.h"
#include "core/cli/output_files.h"
#include "core/cli/picture.h"
#include "core/cli/run_record.h"
#include "core/cli/signals.h"
#include "core/imaging/exr.h"
#include "core/imaging/png.h"

namespace exphoton::cli {
namespace {

using Clock = std::chrono::steady_clock;
using Setups = std::vector<std::unique_ptr<RenderSetup>>;

double SecondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// When the work for a picture began, and what of it was reading the scene.
struct Begin {
  Clock::time_point wall = Clock::now();
  double cpu = ProcessCpuSeconds();
  double loadWall = 0, loadCpu = 0;
};

// Thrown after an interrupted picture has been written.
struct Interrupted {};

// Renders the scenes of one file.
class FileRenderer {
 public:
  FileRenderer(const RenderCommand& command, Log& log) : command_(command), log_(log) {}

  void Run(const std::string& path) {
    Setups setups = Load(path);
    if (command_.mode == RenderMode::Check) return log_.Verbose("\"" + path + "\" has no errors");
    if (command_.mode == RenderMode::Explain) {
      for (const auto& setup : setups) PrintOut(ExplainText(*setup));
      return;
    }
    CheckOutputs(setups, path);
    for (std::unique_ptr<RenderSetup>& setup : setups) {
      watch_.MustFinish() = false;
      RenderOne(*setup);
      setup.reset();
    }
  }

 private:
  // What has been written.
  struct Picture {
    std::string path;
    Image image;
    ExrWriteReport report;
  };

  Setups Load(const std::string& path);
  std::string OutputOf(const RenderSetup& setup) const;
  void CheckOutputs(const Setups& setups, const std::string& scenePath) const;
  void RenderOne(const RenderSetup& setup);
  void AddLoadingTimes(const RenderSetup& setup, const Begin& begin, Statistics* statistics) const;
  void TakeResult(const PassesResult& result, RunRecord* run) const;
  Picture Write(const RunRecord& run, Image image, Statistics& statistics);
  void Announce(const RunRecord& run, const Picture& picture);
  void Report(const RunRecord& run) const;

  const RenderCommand& command_;
  Log& log_;
  InterruptWatch watch_;
  std::optional<Begin> begin_;  // of the first picture
};

Setups FileRenderer::Load(const std::string& path) {
  Begin& begin = begin_.emplace();
  LoadOptions options = command_.load;
  options.stop = &StopFlag();
  options.threads = command_.threadCount;
  FileSource source;
  Setups setups = LoadScenes(source, path, options, log_);
  begin.loadWall = SecondsSince(begin.wall);
  begin.loadCpu = ProcessCpuSeconds() - begin.cpu;
  return setups;
}

std::string FileRenderer::OutputOf(const RenderSetup& setup) const {
  return ResolveOutput(command_.outfile.empty() ? setup.film.filename : command_.outfile);
}

void FileRenderer::CheckOutputs(const Setups& setups, const std::string& scenePath) const {
  if (!command_.outfile.empty() && setups.size() > 1)
    throw Error(ExitStatus::CommandLine, "--outfile names one picture, but \"" + scenePath +
                                             "\" holds " + std::to_string(setups.size()) +
                                             " scenes");
  std::set<std::string> outputs;
  for (const auto& setup : setups) {
    CheckLayers(command_, *setup);
    const std::string output = OutputOf(*setup);
    CheckWritable(output);
    std::error_code ignored;
    for (const std::string& input : setup->inputFiles)
      if (std::filesystem::equivalent(output, input, ignored))
        throw Error(ExitStatus::File, "cannot write \"" + output + "\": the scene reads this file");
    const std::string extension = std::filesystem::path(output).extension().string();
    if (extension != ".exr")
      log_.Warning("the picture \"" + output + "\" is written as OpenEXR, whatever its name");
    if (!outputs.insert(output).second)
      log_.Warning("several scenes write \"" + output + "\": the last one stays");
  }
  if (!command_.previewFile.empty()) CheckWritable(ResolveOutput(command_.previewFile));
  if (!command_.statsFile.empty() && command_.statsFile != "-")
    CheckWritable(ResolveOutput(command_.statsFile));
}

void FileRenderer::RenderOne(const RenderSetup& setup) {
  const Begin begin = std::exchange(begin_, std::nullopt).value_or(Begin());
  log_.Notice("effects:\n" + setup.scene->Effects().Describe());
  PictureFilms films(command_, setup);
  ThreadPool threads(command_.threadCount);
  if (threads.Count() < command_.threadCount)
    log_.Warning("only " + std::to_string(threads.Count()) + " of " +
                 std::to_string(command_.threadCount) + " threads could be started");
  ProgressReporter progress(command_.showsProgress ? ProgressReporter::Mode::Auto
                                                   : ProgressReporter::Mode::Quiet);
  Statistics statistics;
  AddLoadingTimes(setup, begin, &statistics);
  RenderOptions options;
  options.seed = command_.seed;
  options.isStrict = command_.load.isStrict;
  options.stop = &StopFlag();
  options.pixelsBegun = &watch_.MustFinish();
  options.layers = films.layers.get();

  const Clock::time_point start = Clock::now();
  const PassesResult result =
      RenderPicture(command_,
                    {*setup.scene, *setup.integrator, *setup.sampler, *setup.filter, *setup.camera,
                     films.film, threads, log_, progress, statistics, setup.volumeIntegrator.get()},
                    options, begin.wall, &films);
  watch_.MustFinish() = true;
  RunRecord run(setup, statistics);
  run.commandLine = command_.commandLine;
  run.threads = threads.Count();
  run.renderSeconds = SecondsSince(start);
  TakeResult(result, &run);
  const Picture picture =
      Write(run, MakeImage(films, result, setup.film.premultiplyAlpha), statistics);
  try {
    Announce(run, picture);
    run.wallSeconds = SecondsSince(begin.wall);
    run.cpuSeconds = ProcessCpuSeconds() - begin.cpu;
    run.peakMemory = PeakMemoryBytes();
    statistics.SetCounter("memory/peak", run.peakMemory, "most bytes of memory held at any time");
    Report(run);
  } catch (const std::bad_alloc&) {
    throw Error(ExitStatus::Resource, "out of memory after the picture \"" + picture.path +
                                          "\" was written; " + MemoryLimit());
  }
  if (!run.isComplete) throw Interrupted();
}

// Reading the scene is work for the first picture of a file.
void FileRenderer::AddLoadingTimes(const RenderSetup& setup, const Begin& begin,
                                   Statistics* statistics) const {
  const double wall = begin.loadWall - setup.acceleratorSeconds;
  const double cpu = begin.loadCpu - setup.acceleratorCpuSeconds;
  statistics->AddPhase("parse", std::max(wall, 0.), std::max(cpu, 0.));
  statistics->AddPhase("accelerator", setup.acceleratorSeconds, setup.acceleratorCpuSeconds);
}

void FileRenderer::TakeResult(const PassesResult& result, RunRecord* run) const {
  run->seed = command_.seed;
  run->isComplete = result.render.isComplete;
  run->nonFiniteSamples = result.render.nonFiniteSamples;
  run->samplesPerPixel = result.samplesPerPixel;
  run->passes = result.passes;
  run->stoppedBy = StopReasonName(result.reason);
  run->noise = result.noise;
  run->timeLimit = command_.timeLimit;
  run->targetError = command_.targetError;
  run->layers = LayerNames(command_);
  if (command_.asTwoHalves || command_.HasStoppingRule()) log_.Notice(StoppingText(*run));
}

FileRenderer::Picture FileRenderer::Write(const RunRecord& run, Image image,
                                          Statistics& statistics) {
  const PhaseTimer timer(statistics, "write");
  Picture picture{OutputOf(run.setup), std::move(image), {}};
  if (!run.isComplete) picture.path = PartialName(picture.path);
  picture.image.attributes = PictureAttributes(run, command_.isReproducible);
  picture.report = WriteExr(picture.path, picture.image, command_.asHalf);
  return picture;
}

// What follows once there is a picture.
void FileRenderer::Announce(const RunRecord& run, const Picture& picture) {
  if (picture.report.clampedToHalf > 0)
    log_.Warning(std::to_string(picture.report.clampedToHalf) +
                 " values above 65504 were written as 65504; --float stores them as they are");
  if (!command_.previewFile.empty() && run.isComplete)
    WritePng(ResolveOutput(command_.previewFile), picture.image);
  char seconds[32];
  std::snprintf(seconds, sizeof seconds, "%.2f s", run.renderSeconds);
  log_.Notice((run.isComplete ? "wrote \"" : "interrupted; wrote what is finished to \"") +
              picture.path + "\" (rendered in " + seconds + ")");
}

void FileRenderer::Report(const RunRecord& run) const {
  if (command_.printsStatistics) PrintOut(StatisticsTable(run));
  if (command_.statsFile == "-")
    PrintOut(StatisticsJson(run));
  else if (!command_.statsFile.empty())
    WriteTextFile(ResolveOutput(command_.statsFile), StatisticsJson(run));
}

}  // namespace

int RunRender(const RenderCommand& command) {
  int status = 0;
  for (const std::string& path : command.scenes) {
    Log log(command.logLevel);
    const int result = Guarded([&] {
      try {
        FileRenderer(command, log).Run(path);
      } catch (const Interrupted&) {
        // Its picture is written; the status says the rest.
      }
    });
    log.Summarize();
    if (status == 0) status = result;
    if (SignalNumber() != 0) return 128 + SignalNumber();
  }
  return status;
}

}  // namespace exphoton::cli
