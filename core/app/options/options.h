// SPDX-License-Identifier: BSD-2-Clause
// What the command line of `exphoton render` says, and of its forms that do not render (--check,
// --explain). The other commands have few options and read them themselves.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/app/options/limits.h"
#include "core/base/log.h"
#include "core/imaging/film/aovs.h"
#include "core/parser/render_setup.h"

namespace exphoton::cli {

enum class RenderMode { Render, Check, Explain };

struct RenderCommand {
  std::vector<std::string> scenes;  // "-": standard input
  RenderMode mode = RenderMode::Render;
  LoadOptions load;
  std::string outfile;                           // "": what the scene says
  std::string previewFile;                       // "": none
  std::string statsFile;                         // "": none; "-": standard output
  AovSet aovs;                                   // --aov
  std::optional<double> timeLimit, targetError;  // seconds; noise part of relMSE
  bool asTwoHalves = false;
  Limits limits;

  bool HasStoppingRule() const { return timeLimit || targetError; }
  bool printsStatistics = false;
  bool asHalf = true;
  bool isReproducible = false;
  bool showsProgress = true;
  int threadCount = 0;  // 0: all cores
  std::uint64_t seed = 0;
  std::int64_t footprintSamples = 0;  // RenderOptions
  Log::Level logLevel = Log::Level::Normal;
  std::string commandLine;  // as it was typed, for the picture's attributes
};

// `arguments` without the program's and the command's name. Throws Error(CommandLine), TextRequest.
RenderCommand ParseRenderCommand(const std::vector<std::string>& arguments, RenderMode mode);

std::string VersionText();

}  // namespace exphoton::cli
