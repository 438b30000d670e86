// SPDX-License-Identifier: BSD-2-Clause
// JointWindows shares the gathers of several passes with windows and shares of fits that all of
// them choose together. Few samples choose windows badly, and the mean of several passes has less
// noise than one pass, so that smaller windows are better for it. Each pass keeps a fit of its own,
// because the differences between passes show the noise of the picture.
// docs/decisions/0099-joint-windows.md has the derivation and the measurements.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>

#include "core/files/state_file.h"
#include "core/render/sharing/shared_gathers.h"
#include "core/render/sharing_change.h"

namespace exphoton {

class JointWindows {
 public:
  // The fits take time that grows with the square of the number of passes.
  static constexpr std::size_t kMostPasses = 8;

  // `picture` and `aovs` (null: none) have the bounds of pixels and the AOVs of the passes. All
  // takes about `memory` bytes at most, without AOVs.
  JointWindows(const Film& picture, const AovFilm* aovs, double memory);
  JointWindows(const JointWindows&) = delete;
  JointWindows& operator=(const JointWindows&) = delete;

  // Returns whether another pass has room. The answer depends neither on a crop window nor on AOVs,
  // because the picture is the same with and without them.
  bool HasRoomFor(std::int64_t samplesPerPixel) const;
  GatherFragments* OfPass() { return &next_; }  // receives the gathers of the next pass
  // Adds this pass, whose gathers must be there, and whose picture has their own light. Groups are
  // those of PassSum.
  void Add(std::int64_t samplesPerPixel, int group);

  // Fits the light of all passes again. Calls use(group, difference) for each pass, with its new
  // light minus its former one. Returns the mean radius of the windows in pixels.
  using Use = std::function<void(int group, const SharingChange& difference)>;
  double Fit(ThreadPool* threads, const Use& use);
  std::size_t Passes() const { return passes_.size(); }
  std::int64_t SamplesPerPixel() const;  // of all passes

  // Save and load the passes. Load throws Error(File) if the state has a pass of a group from
  // `groups` on.
  void Save(StateWriter* writer);
  void Load(const StateFile& file, int groups);

 private:
  struct Pass {
    int group;
    std::int64_t samples;
    GatherFragments gathers;
    SharingChange change;  // of the present fit
  };

  void Transfer(ByteArchive* archive);
  void TransferPass(ByteArchive* archive, Pass* pass, int groups);
  void TransferRow(ByteArchive* archive, Pass* pass, int y) const;
  void JoinNewPasses(ThreadPool* threads);

  const Film& picture_;
  const AovFilm* aovs_;
  double memory_;
  PixelBounds gathered_;
  std::deque<Pass> passes_;
  GatherFragments next_;    // of the next pass
  GatherFragments all_;     // fragments of the first passes, without their samples
  std::size_t joined_ = 0;  // the number of these passes
};

}  // namespace exphoton
