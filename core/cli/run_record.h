// SPDX-License-Identifier: BSD-2-Clause
// RunRecord: what is known of a finished render, and its three forms: attributes of the picture, a
// table for people, a line of JSON for programs.
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "core/base/statistics.h"
#include "core/imaging/image.h"
#include "core/parser/render_setup.h"

namespace exphoton::cli {

struct RunRecord {
  const RenderSetup& setup;
  const Statistics& statistics;
  std::uint64_t seed = 0;
  int threads = 1;
  double renderSeconds = 0;  // wall, without reading the scene
  bool isComplete = true;
  std::int64_t nonFiniteSamples = 0;
  std::string commandLine;
};

// isReproducible: without times, dates, user, threads and command line, so that equal renders are
// equal files.
std::map<std::string, ImageAttribute> PictureAttributes(const RunRecord& run, bool isReproducible);

std::string StatisticsTable(const RunRecord& run);
std::string StatisticsJson(const RunRecord& run);  // one line

// Scene, plugins and plan of effects, without rendering.
std::string ExplainText(const RenderSetup& setup);

std::string HashText(std::uint64_t hash);  // 16 hexadecimal digits

}  // namespace exphoton::cli
