// SPDX-License-Identifier: BSD-2-Clause
// RunRender checks all files of the run first. It then loads, renders and writes one scene file
// after the other.
#include "core/app/commands/render_command.h"

#include <chrono>
#include <new>

#include "core/app/commands/output_checks.h"
#include "core/app/commands/scene_names.h"
#include "core/app/dial/dial.h"
#include "core/app/effects/measured_effects.h"
#include "core/app/loading/picture_begin.h"
#include "core/app/loading/scene_loader.h"
#include "core/app/options/errors.h"
#include "core/app/output/exr_output.h"
#include "core/app/output/live_view.h"
#include "core/app/output/output_files.h"
#include "core/app/output/output_names.h"
#include "core/app/output/picture.h"
#include "core/app/output/png_output.h"
#include "core/app/output/run_files.h"
#include "core/app/output/run_record.h"
#include "core/app/output/state_keeper.h"
#include "core/app/photons/photon_use.h"
#include "core/app/process/interrupt_watch.h"
#include "core/app/process/signals.h"
#include "core/app/shards/part_writer.h"
#include "core/base/format.h"
#include "core/base/memory.h"
#include "core/base/progress.h"
#include "core/imaging/files/exr.h"

namespace exphoton::cli {
namespace {

using Clock = std::chrono::steady_clock;
using Setups = SceneLoader::Setups;

// Thrown after an interrupted picture has been written, or if it has no pixel to write.
struct Interrupted {};

// Run is the state shared by all scene files of a command line.
struct Run {
  RunFiles files;
  std::string statistics;  // JSON lines of all pictures so far
  FileSource::Streams streams;
};

// Renders the scenes of one file.
class FileRenderer {
 public:
  FileRenderer(const RenderCommand& command, Run& run, Log& log)
      : command_(command),
        names_(command_),
        run_(run),
        log_(log),
        watch_(command.limits.seconds),
        loader_(&command_, names_, &run.streams, log) {}

  // `index` is the position of the file on the command line.
  void Render(std::size_t index) {
    const std::string path = command_.scenes[index];
    Setups setups = Load(path);
    if (command_.mode == RenderMode::Check) return log_.Verbose("\"" + path + "\" has no errors");
    if (command_.mode == RenderMode::Explain) {
      for (const auto& setup : setups) PrintOut(ExplainText(*setup));
      if (command_.measuresEffects)
        PrintOut(MeasuredText(MeasureEffects(command_, path, &run_.streams)));
      return;
    }
    CheckOutputs(command_, setups, index, &run_.files, log_);
    for (std::unique_ptr<RenderSetup>& setup : setups) {
      if (setup != setups.front()) watch_.Restart();
      while (!RenderOne(*setup)) {
        watch_.MustFinish() = false;
        setup.reset();  // it refers to objects of the pilots
        setup = std::move(Load(path).front());
      }
      begin_.reset();
      attempt_.reset();
      setup.reset();
    }
  }

 private:
  // Picture is an image that has been written.
  struct Picture {
    std::string path;
    Image image;
    ExrWriteReport report;
  };

  Setups Load(const std::string& path) {
    // There is a beginning if the picture begins again.
    return loader_.Load(path, begin_ ? &*begin_ : &begin_.emplace());
  }
  RenderOptions MakeOptions(const PictureFilms& films, const RenderSetup& setup);
  RenderJob MakeJob(const RenderSetup& setup, PictureFilms* films, ThreadPool& threads,
                    ProgressReporter& progress, Statistics& statistics);
  void WarnOfFewThreads(const ThreadPool& threads) const;
  Begin BeginAttempt();
  bool RenderOne(const RenderSetup& setup);
  bool BeginsAgain(const PassesResult& result, const StateKeeper& keeper);
  bool HasTimeForAnother(double earlierSeconds) const;  // seconds of stopped runs
  void RenderPart(const PartJob& part, const Begin& begin);
  RunRecord NewRecord(const RenderSetup& setup, const Statistics& statistics) const;
  void TakeResult(const PassesResult& result, RunRecord* run) const;
  Picture Write(const RunRecord& run, Image image, Statistics& statistics);
  void Conclude(RunRecord* run, const Picture& picture, const Begin& begin, Statistics* statistics);
  void WriteSoFar(const RenderSetup& setup, const PictureSoFar& soFar, Statistics& statistics);
  void EndState(const RunRecord& run, StateKeeper* keeper);
  [[noreturn]] void EndBeforePixels(const RenderSetup& setup, const StateKeeper& keeper) const;
  void Announce(const RunRecord& run, const Picture& picture);
  void Report(const RunRecord& run);

  RenderCommand command_;  // with the settings that --accuracy chose
  const OutputNames names_;
  Run& run_;
  Log& log_;
  InterruptWatch watch_;
  SceneLoader loader_;
  std::string filmName_;                         // of the picture that is being rendered
  std::optional<PhotonFileUse> photons_;         // of this picture (--photons)
  std::optional<Begin> begin_;                   // of the current picture, also if it begins again
  std::optional<StateKeeper::Attempt> attempt_;  // at this picture, before it began again
};

RenderOptions FileRenderer::MakeOptions(const PictureFilms& films, const RenderSetup& setup) {
  RenderOptions options;
  options.seed = command_.seed;
  options.isStrict = command_.load.isStrict;
  options.footprintSamples = command_.footprintSamples;
  options.stop = &StopFlag();
  options.pixelsBegun = &watch_.MustFinish();
  options.aovs = films.aovs.get();
  photons_.reset();
  if (!command_.photonFile.empty())
    photons_ = MakePhotonFileUse(command_.photonFile, false, command_.load, setup);
  options.photonFile = photons_ ? &*photons_ : nullptr;
  options.corrections = films.corrections.get();
  options.preparedSeed = loader_.PreparedSeed();
  return options;
}

RenderJob FileRenderer::MakeJob(const RenderSetup& setup, PictureFilms* films, ThreadPool& threads,
                                ProgressReporter& progress, Statistics& statistics) {
  return {*setup.scene,
          *setup.integrator,
          *setup.sampler,
          *setup.filter,
          *setup.camera,
          films->film,
          threads,
          log_,
          progress,
          statistics,
          setup.volumeIntegrator.get(),
          setup.integratorName};
}

void FileRenderer::WarnOfFewThreads(const ThreadPool& threads) const {
  if (threads.Count() < command_.threadCount)
    log_.Warning("only " + std::to_string(threads.Count()) + " of " +
                 std::to_string(command_.threadCount) + " threads could be started");
}

// Begins the picture, or another attempt at it.
Begin FileRenderer::BeginAttempt() {
  if (!begin_) begin_.emplace();
  begin_->BeginAttempt();
  return *begin_;
}

// Returns false if --accuracy needs other settings.
bool FileRenderer::RenderOne(const RenderSetup& setup) {
  const Begin begin = BeginAttempt();
  filmName_ = setup.film.filename;
  log_.Notice("effects: " + EffectNames(setup));
  log_.Verbose("effects:\n" + setup.scene->Features().Describe());
  PictureFilms films(command_, setup);
  ThreadPool threads(command_.threadCount);
  WarnOfFewThreads(threads);
  ProgressReporter progress(command_.showsProgress ? ProgressReporter::Mode::Auto
                                                   : ProgressReporter::Mode::Quiet);
  Statistics statistics;
  begin.AddLoadingTimes(setup, &statistics);
  RenderOptions options = MakeOptions(films, setup);
  const Clock::time_point start = Clock::now();
  const StateIdentity identity(command_, setup);
  const RenderJob job = MakeJob(setup, &films, threads, progress, statistics);
  if (command_.shard)
    return RenderPart({command_, setup, job, options, identity, names_.Part(), log_}, begin), true;
  const std::string picturePath = names_.Picture(setup.film.filename);
  StateKeeper keeper({names_.State(setup.film.filename), command_.resumes, command_.writeEvery,
                      begin.wall, run_.files.PartialPicture(picturePath), attempt_,
                      [&](const PictureSoFar& soFar) { WriteSoFar(setup, soFar, statistics); }},
                     identity, log_);
  options.resumed = keeper.Resume();
  std::optional<LiveView> view;
  if (command_.display)
    view.emplace(*command_.display,
                 LiveView::Picture{picturePath, setup.crop, setup.film.premultiplyAlpha}, log_);
  options.view = view ? &*view : nullptr;
  options.checkpoints = &keeper;
  const PassesResult result = RenderPicture(
      command_, job, options, begin.wall - AsDuration(keeper.EarlierSeconds()), &films);
  if (BeginsAgain(result, keeper)) return false;
  watch_.MustFinish() = true;
  if (!result.render.isComplete && !films.film.HasSamples()) EndBeforePixels(setup, keeper);
  if (view) view->Show(films.film, setup.crop);
  RunRecord run = NewRecord(setup, statistics);
  run.threads = threads.Count();
  run.renderSeconds = ElapsedSince(start);
  run.certificate = CertificateOf(films, result, NotCovered(setup, FootprintSamples(job, options)));
  TakeResult(result, &run);
  const Picture picture =
      Write(run, MakeImage(films, result, setup.film.premultiplyAlpha), statistics);
  Conclude(&run, picture, begin, &statistics);
  EndState(run, &keeper);
  if (!run.isComplete) throw Interrupted();
  return true;
}

// With a time limit, the next attempt must have time for two groups of passes, without which its
// error would not be known. The photons alone take four times as long.
bool FileRenderer::HasTimeForAnother(double earlierSeconds) const {
  constexpr double kMostSpent = 1 / 3.;  // of the time limit
  return !command_.timeLimit ||
         ElapsedSince(begin_->wall) + earlierSeconds < kMostSpent * *command_.timeLimit;
}

// Returns whether the picture begins again: with more photons, because its bias is too large, or
// with another choice, because of its noise or the price of more photons.
bool FileRenderer::BeginsAgain(const PassesResult& result, const StateKeeper& keeper) {
  const auto dear = result.reason == StopReason::Bias ? TooManySamples(command_) : std::nullopt;
  if (result.reason == StopReason::Price)
    loader_.GiveUp("needs at least", result.leastSamples, result.looks);
  else if (dear)
    loader_.GiveUp("needs more photons for its bias, and would cost as much as", *dear,
                   result.looks);
  else if (result.reason != StopReason::Bias || !HasTimeForAnother(keeper.EarlierSeconds()) ||
           !RaisePhotons(result.looks, &command_, log_))
    return false;
  attempt_ = keeper.ThisAttempt();
  begin_->GiveUpAttempt();
  return true;
}

// Returns a record of the command's settings.
RunRecord FileRenderer::NewRecord(const RenderSetup& setup, const Statistics& statistics) const {
  RunRecord run(setup, statistics);
  run.givenUp = begin_->givenUp, run.givenUpSeconds = begin_->givenUpWall;
  run.commandLine = command_.commandLine;
  run.seed = command_.seed;
  run.footprintSamples = command_.footprintSamples;
  run.aovs = AovNames(command_);
  run.unseen = UnseenLight(command_, setup);
  return run;
}

// Renders one shard (--shard).
void FileRenderer::RenderPart(const PartJob& part, const Begin& begin) {
  if (!WritePart(part, [&] { watch_.MustFinish() = true; })) return;
  RunRecord run = NewRecord(part.setup, part.job.statistics);
  run.threads = part.job.threads.Count();
  run.samplesPerPixel = part.job.sampler.SamplesPerPixel();
  run.passes = PassesOf(command_).count;
  run.stoppedBy = StopReasonName(StopReason::Samples);
  run.wallSeconds = run.renderSeconds = ElapsedSince(begin.wall);
  run.cpuSeconds = ProcessCpuSeconds() - begin.cpu;
  run.peakMemory = PeakMemoryBytes();
  Report(run);
}

// Reports a picture that has been written.
void FileRenderer::Conclude(RunRecord* run, const Picture& picture, const Begin& begin,
                            Statistics* statistics) {
  try {
    Announce(*run, picture);
    run->wallSeconds = ElapsedSince(begin.wall);
    run->cpuSeconds = ProcessCpuSeconds() - begin.cpu;
    run->peakMemory = PeakMemoryBytes();
    statistics->SetCounter("memory/peak", run->peakMemory, "largest memory of the process");
    Report(*run);
  } catch (const std::bad_alloc&) {
    throw Error(ExitStatus::Resource, "out of memory after the picture \"" + picture.path +
                                          "\" was written; " + MemoryLimit());
  }
}

// Writes a picture that is not finished (--write-every).
void FileRenderer::WriteSoFar(const RenderSetup& setup, const PictureSoFar& soFar,
                              Statistics& statistics) {
  RunRecord run = NewRecord(setup, statistics);
  run.isComplete = false;
  run.passes = 0;
  run.stoppedBy = "not stopped yet";
  Write(run, MakeImage(command_, soFar, setup.film.premultiplyAlpha), statistics);
}

// A complete picture needs neither its state nor the picture so far.
void FileRenderer::EndState(const RunRecord& run, StateKeeper* keeper) {
  if (run.isComplete)
    keeper->Remove();
  else if (keeper->HasWritten())
    log_.Notice(ResumeText(command_, run.scene.name, *keeper));
}

// A black picture would replace the partial picture of an earlier run, so none is written.
void FileRenderer::EndBeforePixels(const RenderSetup& setup, const StateKeeper& keeper) const {
  log_.Notice("interrupted before the first pixel; no picture was written");
  if (keeper.HasWritten()) log_.Notice(ResumeText(command_, setup.sceneName, keeper));
  throw Interrupted();
}

void FileRenderer::TakeResult(const PassesResult& result, RunRecord* run) const {
  if (command_.dial) run->choice = command_.dial->text, run->omitted = command_.dial->omitted;
  RecordPasses(result, run);
  run->timeLimit = command_.timeLimit;
  run->targetError = command_.targetError;
  run->accuracy = command_.accuracy;
  run->pilots = loader_.Pilots();
  if (command_.RendersTwoHalves() || command_.HasStoppingRule()) log_.Notice(StoppingText(*run));
  WarnOfUnseenLight(run->unseen, run->scene.integrator, log_);
  if (command_.certifies) ReportCertificate(run->certificate, log_);
}

FileRenderer::Picture FileRenderer::Write(const RunRecord& run, Image image,
                                          Statistics& statistics) {
  const PhaseTimer timer(statistics, "write");
  Picture picture{names_.Picture(filmName_), std::move(image), {}};
  if (!run.isComplete) picture.path = run_.files.PartialPicture(picture.path);
  if (!IsPngName(picture.path)) FinishExr(run, command_.isReproducible, &picture.image);
  const auto write = [&](const std::string& path) {
    if (IsPngName(path))
      WritePngPicture(path, picture.image, command_.png, log_);
    else
      picture.report = WriteExr(path, picture.image, command_.asHalf);
  };
  run.isComplete ? WriteOrKeepElsewhere(picture.path, write) : write(picture.path);
  return picture;
}

// Runs after the picture is written: warnings, the preview and a message.
void FileRenderer::Announce(const RunRecord& run, const Picture& picture) {
  WarnOfClamping(picture.report, log_);
  if (!command_.previewFile.empty() && run.isComplete)
    WritePngPicture(command_.previewFile, picture.image, command_.png, log_);
  log_.Notice((run.isComplete ? "wrote \"" : "interrupted; wrote what is finished to \"") +
              picture.path + "\" (rendered in " + RenderTimes(run) + ")");
}

// Rewrites the file with one line per picture so far, so that an interrupted run keeps them.
void FileRenderer::Report(const RunRecord& run) {
  if (command_.printsStatistics) PrintOut(StatisticsTable(run));
  if (command_.statsFile.empty()) return;
  const std::string line = StatisticsJson(run);
  if (command_.statsFile == "-") return PrintOut(line);
  run_.statistics += line;
  WriteOrKeepElsewhere(command_.statsFile,
                       [this](const std::string& path) { WriteTextFile(path, run_.statistics); });
}

// Renders one file after the other. Returns the status of the first file that failed.
int RenderFiles(const RenderCommand& command, Run& run) {
  int status = 0;
  for (std::size_t index = 0; index < command.scenes.size(); ++index) {
    Log log(command.logLevel);
    const int result = Guarded([&] {
      try {
        FileRenderer(command, run, log).Render(index);
      } catch (const Interrupted&) {
        // What there is of the picture is written; SignalNumber gives the exit status.
      }
    });
    log.Summarize();
    if (status == 0) status = result;
    if (SignalNumber() != 0) return 128 + SignalNumber();
  }
  return status;
}

}  // namespace

int RunRender(const RenderCommand& command) {
  LimitMemory(command.limits);
  CheckScenesExist(command);
  Run run;
  run.files.AddPluginFolders(command.load.pluginFolders);
  Log log(command.logLevel);
  CheckAllOutputs(command, &run.files, &run.streams, log);
  log.Summarize();
  return RenderFiles(command, run);
}

}  // namespace exphoton::cli
