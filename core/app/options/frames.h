// SPDX-License-Identifier: BSD-2-Clause
// Frames are the pictures of an animation (--frames). Frame n shows the scene's exposure, later by
// (n - 1) times the time between two frames.
#pragma once

#include <optional>
#include <string>

namespace exphoton::cli {

struct RenderCommand;

struct Frames {
  int first = 1, last = 1;      // 0 <= first <= last
  std::optional<double> apart;  // time between two frames, in the scene's unit of time

  std::string Text() const;  // "1-240"
};

// "1-240", or "7" for one frame.
Frames ParseFrames(const std::string& text);

// Checks the options that --frames needs or excludes. Throws Error(CommandLine).
void CheckFrames(const RenderCommand& command);

// Returns the command for one frame, without --frames: names with the frame's number, and the
// frame's exposure.
RenderCommand FrameCommand(const RenderCommand& command, int frame);

}  // namespace exphoton::cli
