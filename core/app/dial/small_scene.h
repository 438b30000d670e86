// SPDX-License-Identifier: BSD-2-Clause
// SmallScene loads a file with one scene at a low resolution, for pilots and measurements.
#pragma once

#include <memory>
#include <string>

#include "core/app/options/options.h"
#include "core/parser/syntax/source.h"

namespace exphoton::cli {

class SmallScene {
 public:
  // `option` is named in the message about a file with several scenes.
  SmallScene(std::string path, std::string option, FileSource::Streams* streams)
      : path_(std::move(path)), option_(std::move(option)), streams_(streams) {}

  // Returns the options of the command, at a resolution of about 3000 pixels. `full`, if not null,
  // receives the scene at its own resolution. Throws Error.
  LoadOptions Options(const RenderCommand& command, std::unique_ptr<RenderSetup>* full = nullptr);
  // Throws Error, also if the file does not hold one scene.
  std::unique_ptr<RenderSetup> Load(const LoadOptions& options);

  Log& Messages() { return log_; }  // of small renders, which are not shown

 private:
  std::string path_, option_;
  FileSource::Streams* streams_;
  Log log_{Log::Level::Quiet, Log::Sink::Memory};
};

}  // namespace exphoton::cli
