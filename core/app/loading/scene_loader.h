// SPDX-License-Identifier: BSD-2-Clause
// SceneLoader loads the scenes of a file for rendering. With --accuracy it first chooses the
// settings, and takes over what a stopped render has chosen since.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/app/dial/pilots/pilot.h"
#include "core/app/loading/picture_begin.h"
#include "core/app/options/options.h"
#include "core/app/output/output_names.h"

namespace exphoton::cli {

class SceneLoader {
 public:
  using Setups = std::vector<std::unique_ptr<RenderSetup>>;

  // command: receives the settings that --accuracy chooses. All arguments must outlive the loader.
  SceneLoader(RenderCommand* command, const OutputNames& names, FileSource::Streams* streams,
              Log& log)
      : command_(*command), names_(names), streams_(streams), log_(log) {}

  // Throws Error. `begin` receives the times.
  Setups Load(const std::string& path, Begin* begin);

  // Gives up the picture of the choice, which needs at least this number of samples per pixel, or
  // as much time. `reason` is a phrase before this number. The next Load chooses again, and
  // compares the rivals with what is known now. looks: at this picture and earlier ones.
  void GiveUp(const std::string& reason, double neededSamples, int looks);

  // Returns the seed of the photons that the last loaded scene has from a pilot; nullopt: none.
  std::optional<std::uint64_t> PreparedSeed() const { return preparedSeed_; }
  // Returns the work of the pilots of --accuracy; nullopt: there were none.
  std::optional<PilotWork> Pilots() const {
    if (!pilots_) return std::nullopt;
    PilotWork work = pilots_->Work();
    work.Add(earlierWork_);
    return work;
  }

 private:
  // `known` is as in LoadOptions. Messages about text and world appear once.
  Setups LoadFile(const std::string& path, RenderSetup* known);
  Setups LoadAgain(const std::string& path, Setups setups);
  void Choose(const std::string& path, Begin* begin);
  void ForgetChoice(std::vector<GivenUp> givenUp);
  std::optional<LaterChoice> StoppedChoice(const Setups& setups) const;
  bool ContinueChoice(const Setups& setups, const LaterChoice& stopped);

  RenderCommand& command_;
  const OutputNames& names_;
  FileSource::Streams* streams_;
  Log& log_;
  Log silent_{Log::Level::Quiet, Log::Sink::Memory};
  bool hasShownWorld_ = false;                 // its messages
  std::optional<RenderCommand> asked_;         // the command before the choice of --accuracy
  std::shared_ptr<PilotRenderer> pilots_;      // of that choice
  PilotWork earlierWork_;                      // of pilots for earlier choices
  std::optional<std::uint64_t> preparedSeed_;  // of photons that the pilots shot
};

}  // namespace exphoton::cli
