// SPDX-License-Identifier: BSD-2-Clause
// RunRecord: what is known of a finished render, and its three forms: attributes of the picture, a
// table for people, a line of JSON for programs.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "core/base/statistics.h"
#include "core/imaging/image.h"
#include "core/parser/render_setup.h"

namespace exphoton::cli {

struct RunRecord {
  RunRecord(const RenderSetup& aSetup, const Statistics& someStatistics)
      : setup(aSetup), statistics(someStatistics) {}

  const RenderSetup& setup;
  const Statistics& statistics;
  std::uint64_t seed = 0;
  int threads = 1;
  double renderSeconds = 0;                // wall, without reading the scene
  double wallSeconds = 0, cpuSeconds = 0;  // from reading the scene to writing the picture
  double peakMemory = 0;                   // bytes
  bool isComplete = true;
  std::int64_t nonFiniteSamples = 0;
  std::int64_t samplesPerPixel = 0;
  std::int64_t footprintSamples = 0;  // 0: samplesPerPixel
  // How it was decided how much to render.
  int passes = 1;
  std::string stoppedBy;        // StopReasonName
  std::optional<double> noise;  // estimated noise part of relMSE
  std::optional<double> timeLimit, targetError;
  std::string aovs;  // "Albedo, N"
  std::string commandLine;
};

// isReproducible: without times, dates, user, threads and command line, so that equal renders are
// equal files.
std::map<std::string, ImageAttribute> PictureAttributes(const RunRecord& run, bool isReproducible);

std::string StatisticsTable(const RunRecord& run);
std::string StatisticsJson(const RunRecord& run);  // one line

// One line: what a stopping rule reached, or how far two halves lie apart.
std::string StoppingText(const RunRecord& run);

// Scene, plugins and plan of effects, without rendering.
std::string ExplainText(const RenderSetup& setup);

std::string HashText(std::uint64_t hash);  // 16 hexadecimal digits

}  // namespace exphoton::cli
