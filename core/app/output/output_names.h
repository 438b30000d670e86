// SPDX-License-Identifier: BSD-2-Clause
// OutputNames lists the files that a render command writes for each picture and who named them.
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

  // Both count from 0: the scene file on the command line, and the picture in that file.
  struct Place {
    std::size_t file, picture;
  };
  // Adds the picture's output files. `name` is the file name from Film, or empty.
  void AddTo(RunFiles& files, const Place& place, const std::string& name) const;

  // Returns the picture's file, with links resolved.
  std::string Picture(const std::string& name) const;

 private:
  std::optional<std::string> NameFromUser() const;  // from -o or --set Film.filename
  std::string LineWithOutput(const std::string& scene, const std::string& name) const;

  const RenderCommand& command_;
};

}  // namespace exphoton::cli
