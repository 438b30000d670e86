// SPDX-License-Identifier: BSD-2-Clause
// RunMerge: nothing is written unless all parts are there and fit.
#include "core/app/shards/merge_command.h"

#include <chrono>
#include <cstdio>

#include "core/app/options/errors.h"
#include "core/app/options/option_parser.h"
#include "core/app/options/values.h"
#include "core/app/output/exr_output.h"
#include "core/app/output/output_files.h"
#include "core/app/output/picture.h"
#include "core/app/output/png_output.h"
#include "core/app/output/run_files.h"
#include "core/app/output/run_record.h"
#include "core/app/process/interrupt_watch.h"
#include "core/app/shards/part_set.h"
#include "core/base/format.h"
#include "core/base/terminal.h"
#include "core/plugins/registry.h"
#include "core/render/shards/merge_shards.h"

namespace exphoton::cli {
namespace {

constexpr int kMostErrors = 20;

struct MergeOptions {
  std::vector<std::string> paths, pluginFolders;
  std::string outfile, statsFile, commandLine;
  PngOptions png;
  bool listsMissing = false, asHalf = false, asFloat = false, isReproducible = false;
  bool printsStatistics = false, isQuiet = false;
  int threads = 0, shards = 0;

  bool HasPictureOptions() const {
    return asHalf || asFloat || isReproducible || printsStatistics || !statsFile.empty() ||
           png.IsGiven();
  }
};

// A PNG has no 32-bit channels, and an EXR no tone curve.
void CheckMergedPicture(const MergeOptions& options) {
  if (options.outfile.empty()) FailUsage("merge needs -o PICTURE", "for example -o picture.exr");
  const bool isPng = IsPngName(options.outfile);
  if (!isPng && !IsExrName(options.outfile))
    FailUsage("the picture \"" + options.outfile + "\" ends neither in .exr nor in .png");
  if (isPng && (options.asHalf || options.asFloat))
    FailUsage("--half and --float are for EXR: a PNG has 8 bits");
  if (!isPng && options.png.IsGiven())
    FailUsage("--exposure and --tone-curve are for PNG: an EXR stays linear",
              "-o NAME.png writes one");
}

MergeOptions ParseMergeOptions(const std::vector<std::string>& arguments) {
  MergeOptions options;
  OptionParser app("Makes a picture from the parts that exphoton render --shard I/N wrote.",
                   "exphoton merge");
  app.Add("parts", options.paths, "folders of parts, or parts").Required();
  app.Add("-o,--outfile", options.outfile, "the picture: NAME.exr or NAME.png").TypeName("FILE");
  app.AddFlag(
      "--missing", options.listsMissing,
      "print the indices of the parts that are missing or damaged, in the form that --array "
      "of Slurm takes, and write no picture");
  app.Add("--shards", options.shards,
          "with --missing: the number of parts, for a folder that may be empty")
      .Between(1, Shard::kMaxCount)
      .TypeName("N");
  AddPngOptions(app, &options.png);
  app.AddFlag("--half", options.asHalf, "16-bit channels (default: as the parts were rendered)");
  app.AddFlag("--float", options.asFloat, "32-bit channels");
  app.AddFlag("--reproducible", options.isReproducible,
              "leave times, dates, threads and command line out of the picture's file (default: as "
              "the parts were rendered)");
  app.AddFlag("--stats", options.printsStatistics, "print times, rays and counts of all parts");
  app.Add("--stats-json", options.statsFile, "write them to this file (-: print them)")
      .TypeName("FILE");
  app.Add("--nthreads,--ncores", options.threads, "threads; 0: all cores").Between(0, 4096);
  app.Add("--plugin-dir", options.pluginFolders, "look for plugins in this folder first")
      .TypeName("DIR")
      .OnePerUse();
  app.AddFlag("--quiet", options.isQuiet, "errors and warnings only");
  app.Parse(arguments);
  if (options.listsMissing && !options.outfile.empty())
    FailUsage("--missing and --outfile exclude each other");
  if (options.listsMissing && options.HasPictureOptions())
    FailUsage("--missing makes no picture, so it excludes all options of a picture");
  if (options.shards > 0 && !options.listsMissing) FailUsage("--shards needs --missing");
  if (options.asHalf && options.asFloat) FailUsage("--half and --float exclude each other");
  CheckPngOptions(options.png);
  if (!options.listsMissing) CheckMergedPicture(options);
  options.pluginFolders = PluginRegistry::DefaultFolders(options.pluginFolders);
  return options;
}

// Throws the first error, with the others behind it. The last one is always listed.
[[noreturn]] void FailOfParts(std::vector<Error> errors, Log& log) {
  if (errors.size() > kMostErrors) {
    const std::size_t more = errors.size() - kMostErrors;
    errors.erase(errors.begin() + kMostErrors, errors.end() - 1);
    log.Warning(Counted(std::int64_t(more), "error") + " of further parts " +
                (more == 1 ? "is" : "are") + " not listed");
  }
  Error first = errors.front();
  first.AddOthers({errors.begin() + 1, errors.end()});
  throw first;
}

// Throws the problems that remain when all missing parts have been rendered: parts of another
// picture, and any problem of a part if none is missing.
void CheckLastingProblems(const PartSet& parts, bool isComplete, Log& log) {
  std::vector<Error> lasting;
  for (const Error& problem : parts.Problems()) {
    if (isComplete || problem.Status() == ExitStatus::CommandLine)
      lasting.push_back(problem);
    else
      log.Warning(problem.what(), {}, problem.Hint());
  }
  if (!lasting.empty()) FailOfParts(lasting, log);
}

void ListMissing(const MergeOptions& options, const PartSet& parts, Log& log) {
  const int count = options.shards > 0 ? options.shards : parts.Count();
  if (count == 0)
    throw Error(ExitStatus::File, "there is no part, so the number of parts is not known", {},
                "--shards N states it");
  if (parts.Count() > 0 && parts.Count() != count)
    throw Error(ExitStatus::CommandLine,
                "--shards is " + std::to_string(count) + ", but the parts are of " +
                    std::to_string(parts.Count()),
                {}, "divide the picture into the same number of shards every time");
  const std::vector<int> missing = parts.Missing(count);
  CheckLastingProblems(parts, missing.empty(), log);
  if (!missing.empty()) PrintOut(IndexRanges(missing) + "\n");
}

void CheckParts(const MergeOptions& options, const PartSet& parts, Log& log) {
  std::vector<Error> errors = parts.Problems();
  const int count = parts.Count();
  if (parts.Paths().empty())
    errors.emplace_back(ExitStatus::File, "there are no parts in \"" + options.paths.front() + "\"",
                        SourceLocation(),
                        "exphoton render SCENE --shard I/N -o FOLDER writes them");
  else if (const std::vector<int> missing = parts.Missing(count); !missing.empty())
    errors.emplace_back(ExitStatus::File, MissingText(missing, count, "part") + " or unusable",
                        SourceLocation(),
                        "exphoton render SCENE --shard " + std::to_string(missing.front()) + "/" +
                            std::to_string(count) + " -o FOLDER renders " +
                            (missing.size() == 1 ? "it" : "the first of them"));
  if (!errors.empty()) FailOfParts(errors, log);
}

// Prints the messages of the parts, each once.
void RepeatMessages(const PartSet& parts, bool isQuiet) {
  for (const std::string& message : parts.Messages()) {
    const bool isWarning = message.find("warning: ") != std::string::npos;
    if (isQuiet && !isWarning) continue;
    const std::string text = Colored(message, isWarning ? "warning" : "note");
    std::fwrite(text.data(), 1, text.size(), stderr);
  }
}

class Merge {
 public:
  Merge(const MergeOptions& options, const PartSet& parts, Log& log)
      : options_(options),
        parts_(parts),
        record_(parts.Record()),
        log_(log),
        isReproducible_(options.isReproducible || record_.isReproducible) {}

  void Run() {
    ThreadPool threads(options_.threads);
    CheckFiles();
    WarnOfLayers();
    PictureFilms films(parts_.Layout().full, parts_.Layout().crop, parts_.Layout().aovs,
                       record_.passes.kind == PicturePasses::Kind::TwoHalves);
    const PicturePasses::Accuracy& accuracy = record_.passes.accuracy;
    if (accuracy.correctedShare > 0)
      films.corrections =
          std::make_unique<Corrections>(parts_.Layout().crop, accuracy.correctedShare);
    Statistics statistics;
    const PassesResult result = MergeInto(&films, &statistics, &threads);
    RunRecord run(record_.scene, statistics);
    for (const Statistics::Phase& phase : statistics.Phases()) {  // until now, of the parts alone
      run.wallSeconds += phase.wallSeconds;
      run.cpuSeconds += phase.cpuSeconds;
    }
    Fill(result, &run);
    run.certificate = CertificateOf(films, result, record_.notCovered);
    run.threads = threads.Count();
    if (record_.passes.kind != PicturePasses::Kind::Single) log_.Notice(StoppingText(run));
    WarnOfUnseenLight(run.unseen, run.scene.integrator, log_);
    if (films.corrections) ReportCertificate(run.certificate, log_);
    Write(run, MakeImage(films, result, record_.premultipliesAlpha), &statistics);
    run.wallSeconds += SecondsSoFar();
    run.cpuSeconds += ProcessCpuSeconds();
    run.peakMemory = PeakMemoryBytes();
    statistics.SetCounter("memory/peak", run.peakMemory, "largest memory of the process");
    if (options_.printsStatistics) PrintOut(StatisticsTable(run));
    if (options_.statsFile == "-")
      PrintOut(StatisticsJson(run));
    else if (!options_.statsFile.empty())
      WriteTextFile(options_.statsFile, StatisticsJson(run));
  }

 private:
  double SecondsSoFar() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
  }

  void CheckFiles() {
    RunFiles files;
    for (const std::string& path : parts_.Paths()) files.AddInput(path, "the merge");
    files.AddOutput("1", {options_.outfile, "the picture", "-o FILE names another file"});
    if (!options_.statsFile.empty() && options_.statsFile != "-")
      files.AddOutput("2", {options_.statsFile, "the statistics",
                            "--stats-json FILE names another file for them"});
    files.Check(log_);
  }

  void WarnOfLayers() {
    if (record_.aovs.empty() || !IsPngName(options_.outfile)) return;
    log_.Warning("a PNG has no layers, so \"" + options_.outfile + "\" lacks " + record_.aovs, {},
                 "-o NAME.exr writes them");
  }

  PassesResult MergeInto(PictureFilms* films, Statistics* statistics, ThreadPool* threads) {
    std::unique_ptr<Filter> filter;
    std::unique_ptr<const SplatWeights> weights;
    if (parts_.Layout().isSplatted) {
      PluginRegistry registry(options_.pluginFolders, &log_);
      BindContext bind;
      bind.log = &log_;
      bind.what = "filter \"" + record_.scene.filter + "\"";
      filter = registry.Create<PluginKind::Filter>(record_.scene.filter, record_.filter,
                                                   std::move(bind), NoContext{});
      weights = SplatWeights::Of(*filter);
      if (!weights)
        throw Error(ExitStatus::File,
                    "the parts do not fit their filter \"" + record_.scene.filter + "\"");
    }
    const ShardMerge merge{parts_.Files(), parts_.Layout(), record_.passes, weights.get()};
    const MergedFilms merged{&films->film,
                             films->aovs.get(),
                             {films->halves[0].get(), films->halves[1].get()},
                             films->corrections.get()};
    return MergeShards(merge, merged,
                       {*statistics,
                        log_,
                        record_.scene.integrator,
                        {record_.cameraDepth.c_str(), record_.gatherDepth.c_str()}},
                       threads);
  }

  void Fill(const PassesResult& result, RunRecord* run) const {
    run->seed = record_.seed;
    run->commandLine = options_.commandLine;
    run->footprintSamples = record_.footprintSamples;
    run->choice = record_.choice;
    run->omitted = record_.omitted;
    run->unseen = record_.unseen;
    RecordPasses(result, run);
    if (record_.passes.targetError > 0) run->targetError = record_.passes.targetError;
    if (record_.passes.accuracy.error > 0) run->accuracy = record_.passes.accuracy.error;
    run->aovs = record_.aovs;
    run->renderSeconds = run->wallSeconds + SecondsSoFar();
  }

  void Write(const RunRecord& run, Image image, Statistics* statistics) {
    const PhaseTimer timer(*statistics, "write");
    if (IsPngName(options_.outfile)) {
      WritePngPicture(options_.outfile, image, options_.png, log_);
    } else {
      const bool asHalf = !options_.asFloat && (options_.asHalf || record_.asHalf);
      FinishExr(run, isReproducible_, &image);
      WriteExrPicture(options_.outfile, image, asHalf, log_);
    }
    log_.Notice("wrote \"" + options_.outfile + "\" from " +
                Counted(std::int64_t(parts_.Files().size()), "part"));
  }

  const MergeOptions& options_;
  const PartSet& parts_;
  const PartRecord& record_;
  Log& log_;
  bool isReproducible_;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

}  // namespace

int RunMerge(const std::vector<std::string>& arguments, const std::string& commandLine) {
  return Guarded([&] {
    MergeOptions options = ParseMergeOptions(arguments);
    options.commandLine = commandLine;
    Log log(options.isQuiet ? Log::Level::Quiet : Log::Level::Normal);
    const InterruptWatch watch(std::nullopt);
    const PartSet parts(options.paths);
    if (options.listsMissing) {
      ListMissing(options, parts, log);
    } else {
      CheckParts(options, parts, log);
      RepeatMessages(parts, options.isQuiet);
      Merge(options, parts, log).Run();
    }
    log.Summarize();
  });
}

}  // namespace exphoton::cli
