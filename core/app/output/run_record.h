// SPDX-License-Identifier: BSD-2-Clause
// RunRecord describes a finished render. It has three output forms: attributes of the picture, a
// table for people, and a line of JSON for programs.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/app/dial/omitted_effect.h"
#include "core/app/dial/pilots/counted_cost.h"
#include "core/app/shards/scene_record.h"
#include "core/base/statistics.h"
#include "core/imaging/image.h"
#include "core/parser/render_setup.h"
#include "core/render/certificate/certificate.h"
#include "core/render/passes/pass_sum.h"
#include "core/render/sharing/sharing_estimate.h"

namespace exphoton::cli {

struct RunRecord {
  RunRecord(const RenderSetup& aSetup, const Statistics& someStatistics)
      : RunRecord(SceneRecord(aSetup), someStatistics) {}
  RunRecord(SceneRecord aScene, const Statistics& someStatistics)
      : scene(std::move(aScene)), statistics(someStatistics) {}

  SceneRecord scene;
  const Statistics& statistics;
  std::uint64_t seed = 0;
  int threads = 1;
  double renderSeconds = 0;                // wall time, without loading the scene
  int givenUp = 0;                         // attempts before this picture
  double givenUpSeconds = 0;               // their wall time
  double wallSeconds = 0, cpuSeconds = 0;  // from loading the scene to writing the picture
  double peakMemory = 0;                   // bytes
  bool isComplete = true;
  std::int64_t nonFiniteSamples = 0;
  std::int64_t samplesPerPixel = 0;
  std::int64_t footprintSamples = 0;  // 0: equal to samplesPerPixel
  // The amount of rendering, and the rule that stopped it.
  int passes = 1;
  std::string stoppedBy;        // from StopReasonName
  std::optional<double> noise;  // estimated noise part of relMSE
  double noiseError = 0;        // its standard error
  std::optional<SharingBias> sharingBias;
  std::optional<Certificate> certificate;
  std::optional<double> timeLimit, targetError;
  std::optional<double> accuracy;      // --accuracy
  std::optional<double> upperError;    // relMSE; the upper end of its interval (AccuracyRule)
  std::string choice;                  // what --accuracy chose
  std::vector<OmittedEffect> omitted;  // what it left out
  std::vector<std::string> unseen;     // light that neither picture nor error contains
  std::optional<PilotWork> pilots;     // what its pilots traced and stored
  std::optional<double> lastDiskArea;  // of the last progressive pass, relative to the first
  std::string aovs;                    // "albedo, N"
  std::string commandLine;
};

// isReproducible: omits times, dates, user, threads and command line, so that equal renders give
// identical files.
std::map<std::string, ImageAttribute> PictureAttributes(const RunRecord& run, bool isReproducible);
// Sets the attributes of an EXR picture, and the ids of its Cryptomatte layers.
void FinishExr(const RunRecord& run, bool isReproducible, Image* image);

// Takes over the amount of rendering and its results. Adds changed settings to the choice.
void RecordPasses(const PassesResult& result, RunRecord* run);

std::string StatisticsTable(const RunRecord& run);
std::string StatisticsJson(const RunRecord& run);  // one line

// Returns the times of the picture and of the attempts before it.
std::string RenderTimes(const RunRecord& run);
// Returns one line: the result of a stopping rule, or the difference between two halves.
std::string StoppingText(const RunRecord& run);

// Describes scene, plugins and effects without rendering.
std::string ExplainText(const RenderSetup& setup);

}  // namespace exphoton::cli
