// SPDX-License-Identifier: BSD-2-Clause
// SmallScene loads a file with one scene at a low resolution, for pilots and measurements, and
// SmallRender renders it without messages.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/app/options/options.h"
#include "core/base/parallel.h"
#include "core/base/progress.h"
#include "core/base/statistics.h"
#include "core/parser/syntax/source.h"
#include "core/render/render.h"

namespace exphoton::cli {

inline constexpr double kPilotPixels = 3000;  // of a small picture, at most about

class SmallScene {
 public:
  // `option` is named in the message about a file with several scenes.
  SmallScene(std::string path, std::string option, FileSource::Streams* streams)
      : path_(std::move(path)), option_(std::move(option)), streams_(streams) {}

  // Shows the messages about the text and the world of the first scene. Later ones know it.
  void ShowMessages(Log* log) { sceneLog_ = log; }

  // Returns the options of the command, at a resolution of about 3000 pixels. `full`, if not null,
  // receives the scene at its own resolution. Throws Error.
  LoadOptions Options(const RenderCommand& command, std::unique_ptr<RenderSetup>* full = nullptr);
  // Sets a resolution of about this number of pixels. It is not above the one of the full scene.
  static void SetPixels(const RenderSetup& full, double pixels, LoadOptions* options);
  // Throws Error, also if the file does not hold one scene.
  std::unique_ptr<RenderSetup> Load(const LoadOptions& options);

 private:
  std::string path_, option_;
  FileSource::Streams* streams_;
  Log* sceneLog_ = nullptr;
  Log log_{Log::Level::Quiet, Log::Sink::Memory};  // the messages of small scenes are not shown
};

// What one render needs beside its scene.
class SmallRender {
 public:
  // threads: as in RenderCommand.
  explicit SmallRender(int threads) : threads_(threads) {}

  // The job refers to all arguments and to this object.
  RenderJob Job(const RenderSetup& setup, const Sampler& sampler, Film* film);
  const Statistics& Counts() const { return statistics_; }
  // Returns the messages of the render, as they would be printed.
  std::vector<std::string> Messages() const { return log_.Messages(); }

 private:
  ThreadPool threads_;
  Log log_{Log::Level::Quiet, Log::Sink::Memory};
  ProgressReporter progress_{ProgressReporter::Mode::Quiet};
  Statistics statistics_;
};

// Returns the means of R, G and B of each pixel of the film's crop window, row by row.
std::vector<double> ValuesOf(const Film& film);

}  // namespace exphoton::cli
