// SPDX-License-Identifier: BSD-2-Clause
#include "core/app/commands/render_frames.h"

#include "core/app/commands/render_command.h"
#include "core/app/options/errors.h"
#include "core/app/process/signals.h"

namespace exphoton::cli {

int RunFrames(const RenderCommand& command) {
  int status = 0;
  const Frames frames = *command.frames;
  Log log(command.logLevel);
  for (int frame = frames.first; frame <= frames.last; ++frame) {
    if (frames.last > frames.first)
      log.Notice("frame " + std::to_string(frame) + " of " + frames.Text());
    int result = 0;
    const int failure = Guarded([&] { result = RunRender(FrameCommand(command, frame)); });
    if (status == 0) status = failure ? failure : result;
    if (SignalNumber() != 0) return 128 + SignalNumber();
  }
  return status;
}

}  // namespace exphoton::cli
