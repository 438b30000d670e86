// SPDX-License-Identifier: BSD-2-Clause
// FrameCommand puts the number into all names of files. If the scenes themselves are numbered, each
// has times of its own, and the exposure stays.
#include "core/app/options/frames.h"

#include <charconv>

#include "core/app/options/options.h"
#include "core/app/options/values.h"
#include "core/app/output/output_names.h"
#include "core/parser/frame_name.h"

namespace exphoton::cli {
namespace {

constexpr int kLastFrame = 1000000;

// Returns whether the text is a number from 0 to kLastFrame.
bool ReadFrame(std::string_view text, int* frame) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), *frame);
  return error == std::errc() && end == text.data() + text.size() && *frame >= 0 &&
         *frame <= kLastFrame;
}

void NeedNumber(const char* option, const std::string& name, const std::string& frames) {
  if (name.empty() || name == "-" || HasFrameNumber(name)) return;
  FailUsage("--frames " + frames + " writes one file for each frame, but " + option + " \"" + name +
                "\" has no place for the number",
            "%d stands for the number of the frame, %04d for one with leading zeros");
}

}  // namespace

std::string Frames::Text() const {
  return std::to_string(first) + (last == first ? "" : "-" + std::to_string(last));
}

Frames ParseFrames(const std::string& text) {
  Frames frames;
  const std::string_view all = text;
  const std::size_t dash = all.find('-');
  const bool isNumber = ReadFrame(all.substr(0, dash), &frames.first) &&
                        ReadFrame(dash == all.npos ? all : all.substr(dash + 1), &frames.last);
  if (!isNumber)
    FailUsage("--frames takes a frame or a range of frames from 0 to " +
                  std::to_string(kLastFrame) + ", not \"" + text + '"',
              "for example --frames 1-240");
  if (frames.last < frames.first)
    FailUsage(
        "--frames " + text + " ends before it begins",
        "for example --frames " + std::to_string(frames.last) + "-" + std::to_string(frames.first));
  return frames;
}

void CheckFrames(const RenderCommand& command) {
  if (!command.frames) return;
  const std::string text = command.frames->Text();
  if (command.scenes.size() != 1)
    FailUsage("--frames renders one scene, but several are named",
              "numbered scenes are one name: exphoton room%03d.pbrt --frames 1-240");
  if (command.scenes[0] == "-") FailUsage("--frames cannot read its scene from standard input");
  NeedNumber(command.outfile.empty() ? "--set Film.filename" : "-o",
             OutputNames(command).NameFromUser().value_or(""), text);
  NeedNumber("--preview", command.previewFile, text);
  NeedNumber("--stats-json", command.statsFile, text);
  NeedNumber("--state", command.stateFile, text);
}

RenderCommand FrameCommand(const RenderCommand& command, int frame) {
  RenderCommand one = command;
  const bool hasOwnScenes = HasFrameNumber(command.scenes[0]);
  one.frames.reset();
  // With --resume alone, the frames before this one would be rendered again.
  if (frame > command.frames->first)
    one.resumeOptions = "--frames " + Frames{frame, command.frames->last, {}}.Text() + " --resume";
  if (!OutputNames(command).NameFromUser() && !command.shard) one.load.frame = frame;
  one.load.timeOffset = Real((frame - 1) * command.frames->apart.value_or(hasOwnScenes ? 0. : 1.));
  for (std::string* name : {&one.scenes[0], &one.outfile, &one.previewFile, &one.statsFile,
                            &one.stateFile, &one.photonFile})
    *name = FrameName(*name, frame);
  for (ParameterOverride& set : one.load.parameters)
    if (set.directive == "Film" && set.parameter == "filename")
      set.value = FrameName(set.value, frame);
  return one;
}

}  // namespace exphoton::cli
