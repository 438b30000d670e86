// SPDX-License-Identifier: BSD-2-Clause
// PassParts adds up the AOVs of the passes of one picture and gives a pass the options it renders
// with: a film of its own for AOVs, and checkpoints that contain the whole picture.
#pragma once

#include <cstdint>
#include <memory>

#include "core/render/render.h"
#include "core/render/state/checkpoints.h"

namespace exphoton {

// Seeds of passes differ by this key.
constexpr std::uint64_t kPassSeed = 0x70617373ull;
constexpr std::uint64_t kGroupSeed = 0x7265706cull;

// Returns a pass with a complete sample pattern. `first` is the number of samples that the group
// has before it.
RenderPass PatternPass(std::uint64_t seed, std::uint64_t group, std::int64_t first,
                       std::int64_t count);

class PassParts {
 public:
  // `options` are those of the whole picture. `wrap` adds the other passes to a checkpoint.
  PassParts(const RenderJob& job, const RenderOptions& options, OuterCheckpoints::Wrap wrap);
  PassParts(const PassParts&) = delete;
  PassParts& operator=(const PassParts&) = delete;

  const RenderOptions& Options() const { return options_; }  // of one pass

  // Names the receiver of what sharing changes in each pass; null: none.
  void SetSharingChange(SharingChange* change) { options_.sharingChange = change; }

  AovFilm* Aovs() const { return all_; }  // of all passes so far; null: none
  bool NeedsVariances() const { return all_ && all_->Wanted().Has(Aov::Variance); }
  void TakeAovs(bool isKept);                 // ends the AOVs of a pass, and adds them if kept
  void AddAovs(PictureSoFar* picture) const;  // adds the AOVs of earlier passes
  void SaveAovs(StateWriter* writer);
  void LoadAovs(const StateFile& file);

  // Shows the picture of all passes so far. Tiles of later passes are not shown: one pass is
  // noisier than the picture.
  void Show(const Film& film);
  // Hands over the state of a render that is stopped between passes.
  void TakeLast(const Checkpoint& between);

 private:
  AovFilm* all_;                  // of all passes; null: no AOVs
  std::unique_ptr<AovFilm> one_;  // of one pass
  OuterCheckpoints checkpoints_;
  RenderView* view_;
  RenderOptions options_;
};

}  // namespace exphoton
