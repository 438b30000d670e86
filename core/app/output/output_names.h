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

  // Throws Error(CommandLine) if the user names a picture or preview with an unknown ending.
  void CheckEndings() const;

  // Returns the picture's file, with links resolved. A name from the scene becomes one that ends
  // in .exr.
  std::string Picture(const std::string& name) const;
  // Returns the file of the part that --shard names.
  std::string Part() const;
  // Returns the file for the state of the picture `name`.
  std::string State(const std::string& name) const;
  std::optional<std::string> NameFromUser() const;  // from -o or --set Film.filename

 private:
  std::string LineWithOutput(const std::string& scene, const std::string& name) const;

  const RenderCommand& command_;
};

}  // namespace exphoton::cli
