// SPDX-License-Identifier: BSD-2-Clause
// RunPhotons shoots without a camera: photons that are aimed at what one camera sees would be wrong
// for another.
#include "core/app/photons/shoot_photons.h"

#include "core/app/options/errors.h"
#include "core/app/options/limits.h"
#include "core/app/options/option_parser.h"
#include "core/app/options/values.h"
#include "core/app/output/output_files.h"
#include "core/app/output/run_files.h"
#include "core/app/photons/photon_parts.h"
#include "core/app/photons/photon_use.h"
#include "core/app/process/interrupt_watch.h"
#include "core/app/process/signals.h"
#include "core/app/shards/part_set.h"
#include "core/base/log.h"
#include "core/base/parallel.h"
#include "core/base/progress.h"
#include "core/plugins/registry.h"
#include "core/transport/volume_integrator.h"

namespace exphoton::cli {
namespace {

struct PhotonOptions {
  std::string scene, outfile, limits, shardText, partsFolder;
  std::optional<Shard> shard;
  bool listsMissing = false, allowsMissing = false;
  std::vector<std::string> sets, pluginFolders;
  LoadOptions load;
  int threads = 0;
  std::uint64_t seed = 0;
  bool isQuiet = false, hidesProgress = false;
};

void CheckShares(const PhotonOptions& options) {
  const bool merges = !options.partsFolder.empty();
  if (options.shard && merges) FailUsage("--shard and --merge exclude each other");
  if (options.listsMissing && !merges)
    FailUsage("--missing needs --merge DIR, the folder of the shares");
  if (options.allowsMissing && !merges)
    FailUsage("--incomplete needs --merge DIR, the folder of the shares");
  if (options.listsMissing && !options.outfile.empty())
    FailUsage("--missing and --outfile exclude each other");
  if (options.outfile.empty() && !options.listsMissing)
    FailUsage("exphoton photons needs -o FILE", "for example -o room.expm");
}

PhotonOptions ParsePhotonOptions(const std::vector<std::string>& arguments) {
  PhotonOptions options;
  OptionParser app(
      "Shoots the photons of a scene into a file. exphoton render --photons FILE uses them from "
      "any "
      "camera, with any sampler and any gather.",
      "exphoton photons");
  app.Add("scene", options.scene, "the scene").Required();
  app.Add("-o,--outfile", options.outfile, "the file of the photons; with --shard, a folder")
      .TypeName("FILE");
  app.Add("--shard", options.shardText,
          "shoot share I of N into the folder -o, as photons-I-of-N.state")
      .TypeName("I/N");
  app.Add("--merge", options.partsFolder, "take the shares in this folder over").TypeName("DIR");
  app.AddFlag("--missing", options.listsMissing,
              "with --merge: print which shares are missing or damaged, and stop");
  app.AddFlag("--incomplete", options.allowsMissing,
              "with --merge: shoot what missing shares would have, instead of stopping");
  app.Add("--integrator", options.load.integrator, "as in exphoton render").TypeName("NAME");
  app.Add("--set", options.sets, "as in exphoton render")
      .TypeName("Directive.parameter=value")
      .OnePerUse();
  app.Add("--effects", options.load.effects, "as in exphoton render").TypeName("LIST");
  app.Add("--seed", options.seed, "seed of the random numbers").TypeName("N");
  app.Add("--nthreads,--ncores", options.threads, "threads; 0: all cores").Between(0, 4096);
  app.Add("--plugin-dir", options.pluginFolders, "look for plugins in this folder first")
      .TypeName("DIR")
      .OnePerUse();
  AddScenePluginsOption(app, &options.load.allowsScenePlugins);
  AddLimitsOption(app, &options.limits);
  app.AddFlag("--quiet", options.isQuiet, "errors and warnings only");
  app.AddFlag("--no-progress", options.hidesProgress, "no progress bar");
  app.Parse(arguments);
  if (!options.shardText.empty()) options.shard = ParseShard(options.shardText);
  CheckShares(options);
  for (const std::string& set : options.sets) options.load.parameters.push_back(ParseOverride(set));
  options.load.pluginFolders = PluginRegistry::DefaultFolders(options.pluginFolders);
  options.load.stop = &StopFlag();
  options.load.threads = options.threads;
  return options;
}

void CheckFiles(const PhotonOptions& options, const RenderSetup& setup, Log& log) {
  RunFiles files;
  files.AddPluginFolders(PluginRegistry::DefaultFolders(options.pluginFolders));
  files.AddScene(setup);
  files.AddOutput("photons", {options.outfile, "the photons", "-o FILE names another file"});
  files.Check(log);
}

// Returns the files of the shares that are taken over.
std::vector<std::string> FindParts(const PhotonOptions& options) {
  if (options.partsFolder.empty()) return {};
  const PhotonParts found(options.partsFolder);
  if (!options.allowsMissing) found.CheckComplete();
  return found.Paths();
}

void ListMissingParts(const PhotonOptions& options) {
  const std::string missing = IndexRanges(PhotonParts(options.partsFolder).Missing());
  PrintOut(missing.empty() ? "" : missing + "\n");
}

// Makes the folder of the share, and names its file.
void NameShare(PhotonOptions* options) {
  if (!options->shard) return;
  MakeFolder(options->outfile);
  options->outfile = PhotonPartPath(options->outfile, *options->shard);
}

PhotonFileUse MakeUse(const PhotonOptions& options, const RenderSetup& setup) {
  PhotonFileUse use = MakePhotonFileUse(options.outfile, true, options.load, setup);
  use.parts = FindParts(options);
  if (options.shard) {
    use.shardIndex = options.shard->index;
    use.shardCount = options.shard->count;
  }
  return use;
}

void Shoot(PhotonOptions options) {
  if (options.listsMissing) return ListMissingParts(options);
  NameShare(&options);
  const Limits limits = ParseLimits(options.limits);
  options.load.limits = limits.scene;
  LimitMemory(limits);
  Log log(options.isQuiet ? Log::Level::Quiet : Log::Level::Normal);
  const InterruptWatch watch(limits.seconds);
  FileSource source;
  const auto setups = LoadScenes(source, options.scene, options.load, log);
  if (setups.size() > 1)
    throw Error(ExitStatus::CommandLine, "photons are of one scene, but \"" + options.scene +
                                             "\" holds " + std::to_string(setups.size()));
  RenderSetup& setup = *setups.front();
  const PhotonFileUse use = MakeUse(options, setup);
  CheckFiles(options, setup, log);
  ThreadPool threads(options.threads);
  ProgressReporter progress(options.isQuiet || options.hidesProgress
                                ? ProgressReporter::Mode::Quiet
                                : ProgressReporter::Mode::Auto);
  Statistics statistics;
  SampleLayout layout;
  setup.integrator->RequestSamples(*setup.scene, *setup.sampler, &layout);
  PreprocessContext context{threads,     options.seed,
                            log,         progress,
                            statistics,  options.load.isStrict,
                            nullptr,  // no camera
                            {},          setup.volumeIntegrator.get(),
                            &StopFlag(), &use};
  if (setup.volumeIntegrator) setup.volumeIntegrator->Preprocess(*setup.scene);
  try {
    setup.integrator->Preprocess(*setup.scene, context);
  } catch (const PhotonsWritten&) {
    if (!options.shard) log.Notice("wrote photons to \"" + options.outfile + "\"");
  } catch (const PreprocessStopped&) {
    throw LoadingStopped();  // to the user it is the same: nothing was written
  }
}

}  // namespace

int RunPhotons(const std::vector<std::string>& arguments) {
  return Guarded([&] { Shoot(ParsePhotonOptions(arguments)); });
}

}  // namespace exphoton::cli
