// SPDX-License-Identifier: BSD-2-Clause
#include "core/render/passes/pass_parts.h"

#include <utility>

namespace exphoton {

RenderPass PatternPass(std::uint64_t seed, std::uint64_t group, std::int64_t first,
                       std::int64_t count) {
  return {HashKey({seed, kPassSeed, group}),
          HashKey({seed, kGroupSeed, group, std::uint64_t(first), kPassSeed}), 0, count};
}

PassParts::PassParts(const RenderJob& job, const RenderOptions& options,
                     OuterCheckpoints::Wrap wrap)
    : all_(options.aovs),
      one_(all_ ? std::make_unique<AovFilm>(job.film.Crop(), all_->Wanted()) : nullptr),
      checkpoints_(options.checkpoints, std::move(wrap)),
      view_(options.view),
      options_(options) {
  options_.aovs = one_.get();
  if (options_.checkpoints) options_.checkpoints = &checkpoints_;
}

void PassParts::TakeAovs(bool isKept) {
  if (!all_) return;
  if (isKept) all_->Add(*one_);
  one_->Clear();
}

void PassParts::AddAovs(PictureSoFar* picture) const {
  if (all_) picture->aovs->Add(*all_);
}

void PassParts::SaveAovs(StateWriter* writer) {
  if (all_) SaveSection("aovs", *all_, writer);
}

void PassParts::LoadAovs(const StateFile& file) {
  if (all_) LoadSection("aovs", all_, file);
}

void PassParts::Show(const Film& film) {
  if (view_) view_->Show(film, film.Crop());
  options_.view = nullptr;
}

void PassParts::TakeLast(const Checkpoint& between) {
  if (options_.checkpoints) checkpoints_.Take(between, true);
}

}  // namespace exphoton
