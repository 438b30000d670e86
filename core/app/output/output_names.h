// SPDX-License-Identifier: BSD-2-Clause
// OutputNames: what a render command writes for each picture, and who has named it.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "core/app/options/options.h"
#include "core/app/output/run_files.h"

namespace exphoton::cli {

class OutputNames {
 public:
  explicit OutputNames(const RenderCommand& command) : command_(command) {}

  // Both count from 0: the file among the command line's, and the picture among the file's.
  struct Place {
    std::size_t file, picture;
  };
  // `name`: what the picture's Film says, or nothing.
  void AddTo(RunFiles& files, const Place& place, const std::string& name) const;

  // The file of the picture, at the end of links.
  std::string Picture(const std::string& name) const;

 private:
  std::optional<std::string> NameFromUser() const;  // -o, or --set Film.filename
  std::string LineWithOutput(const std::string& scene, const std::string& name) const;

  const RenderCommand& command_;
};

}  // namespace exphoton::cli
