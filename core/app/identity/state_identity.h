// SPDX-License-Identifier: BSD-2-Clause
// StateIdentity describes the program, scene and settings that decide the bytes of a picture. A
// stopped render can be continued only if all of them are the same.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/app/identity/input_hashes.h"
#include "core/app/options/options.h"
#include "core/files/state_file.h"

namespace exphoton::cli {

class StateIdentity {
 public:
  // Reads the files that the scene names, to know their contents.
  StateIdentity(const RenderCommand& command, const RenderSetup& setup);

  void Save(StateWriter* writer) const;
  static StateIdentity Of(const StateFile& file);
  // Throws Error(CommandLine), which names everything that differs.
  void Check(const StateFile& file) const;
  // Names everything that differs in `other`; "" if nothing does.
  std::string Differences(const StateIdentity& other) const;
  const std::string& Program() const { return program_; }  // "exphoton 0.1.0"
  // Returns the later choice of a render with --accuracy; nullopt: it is of another render.
  std::optional<LaterChoice> Choice() const;

 private:
  struct Setting {
    std::string name, value;  // "--spp", "16"
  };
  StateIdentity() = default;
  void Add(const std::string& name, const std::string& value);
  void AddAccuracy(const RenderCommand& command);
  void Transfer(ByteArchive* archive);

  std::string program_;
  std::vector<InputHash> inputs_;  // the scene comes first
  std::vector<Setting> settings_;
};

}  // namespace exphoton::cli
