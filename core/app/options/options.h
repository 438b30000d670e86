// SPDX-License-Identifier: BSD-2-Clause
// RenderCommand holds the command line of `exphoton render` and of its modes that do not render
// (--check, --explain). Other commands have few options and parse them themselves.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "core/app/dial/dial_settings.h"
#include "core/app/dial/omitted_effect.h"
#include "core/app/options/frames.h"
#include "core/app/options/limits.h"
#include "core/app/output/png_output.h"
#include "core/app/process/viewer_connection.h"
#include "core/base/log.h"
#include "core/imaging/film/aovs.h"
#include "core/parser/render_setup.h"
#include "core/render/passes/progressive.h"
#include "core/render/shards/shard_tiles.h"

namespace exphoton::cli {

enum class RenderMode { Render, Check, Explain };

// A picture for an accuracy that was given up, because it had more noise than its pilots suggested.
struct GivenUp {
  std::string integrator;
  double samples = 0;  // per pixel, that the accuracy needs at least
  int looks = 0;       // at pictures that were given up
};

// What --accuracy chose for a scene, beyond the options of the command.
struct DialChoice {
  std::int64_t firstSamples = 1;  // as in StoppingRule::Accuracy
  double biasShare = 0;           // the same
  double photonSamples = 0;       // the same
  DialSettings settings;
  std::vector<OmittedEffect> omitted;
  double lackingShare = 0;       // of the light that exphotonmap finds, what is missing; 0: unknown
  std::string text;              // what changed
  double expectedSamples = 0;    // as in StoppingRule::Accuracy
  std::int64_t mostSamples = 0;  // that the picture may take, if its passes are not limited
  // Whether the picture may begin again with more photons.
  bool mayRaisePhotons = false;
  int earlierLooks = 0;                                           // as in StoppingRule::Accuracy
  double rivalSamples = std::numeric_limits<double>::infinity();  // the same
};

// What a render for an accuracy has chosen after its pilots, or by a clock.
struct LaterChoice {
  std::int64_t firstSamples = 1;  // as in DialChoice
  double photons = 1;             // as in DialSettings
  std::vector<GivenUp> givenUp = {};
};

struct RenderCommand {
  std::vector<std::string> scenes;  // "-": standard input
  RenderMode mode = RenderMode::Render;
  bool measuresEffects = false;  // explain --measure
  LoadOptions load;
  std::string outfile;                           // "": the name from the scene
  std::string previewFile;                       // "": none
  PngOptions png;                                // for the picture, if it is a PNG, and the preview
  std::string statsFile;                         // "": none; "-": standard output
  AovSet aovs;                                   // --aov
  std::optional<double> timeLimit, targetError;  // seconds; noise part of relMSE
  bool asTwoHalves = false;
  bool certifies = false;            // --certify
  double certifiedShare = 1. / 128;  // --certify-share
  int maxPasses = 0;                 // --max-passes; 0: not given
  std::optional<double> accuracy;    // --accuracy: root of relMSE
  bool keepsSettings = false;        // --keep
  std::optional<DialChoice> dial;    // of --accuracy
  std::vector<GivenUp> givenUp;      // by --accuracy
  bool isProgressive = false;        // --progressive
  double progressiveAlpha = kProgressiveAlpha;
  std::optional<Shard> shard;        // --shard: outfile is a folder
  std::optional<Frames> frames;      // --frames: names hold "%d"
  bool resumes = false;              // --resume
  std::string stateFile;             // "": the picture's name with ".state"
  std::optional<double> writeEvery;  // seconds
  std::optional<ViewerAddress> display;
  std::string photonFile;  // --photons; "": photons are shot
  Limits limits;
  std::string resumeOptions = "--resume";  // the options that continue this command after a stop

  bool HasStoppingRule() const { return timeLimit || targetError || isProgressive || accuracy; }
  // A certificate compares independent passes, so without a rule it renders two halves.
  bool RendersTwoHalves() const { return asTwoHalves || (certifies && !HasStoppingRule()); }
  bool printsStatistics = false;
  bool asHalf = true;
  bool isReproducible = false;
  bool showsProgress = true;
  int threadCount = 0;  // 0: all cores
  std::uint64_t seed = 0;
  std::int64_t footprintSamples = 0;  // see RenderOptions
  Log::Level logLevel = Log::Level::Normal;
  std::string commandLine;  // as typed, for the picture's attributes
};

// `arguments` exclude the names of program and command. Throws Error(CommandLine), TextRequest.
RenderCommand ParseRenderCommand(const std::vector<std::string>& arguments, RenderMode mode);

// Returns the names of all commands.
std::vector<std::string> CommandNames();
// Lists the commands and some examples.
const char* ShortUsage();

std::string VersionText();

}  // namespace exphoton::cli
