// SPDX-License-Identifier: BSD-2-Clause
// GatherBatch keeps the gathers of successive passes that read the same photon maps. After each
// pass, light is fitted to all of them again. A fit to the gathers of several passes has less noise
// than the mean of one fit for each pass. docs/decisions/0046-gathers-of-several-passes.md has the
// measurements.
#pragma once

#include <memory>
#include <optional>

#include "core/files/state_file.h"
#include "core/render/sharing/shared_gathers.h"

namespace exphoton {

class GatherBatch {
 public:
  // The films of a pass state the picture and the AOVs (null: none). `window` holds the pixels that
  // get light, `gathered` those whose gathers they need. If `splatWeights` is null, samples are not
  // splatted.
  struct Layout {
    const Film& film;
    const AovFilm* aovs;
    PixelBounds window, gathered;
    const SplatWeights* splatWeights;
  };
  explicit GatherBatch(const Layout& layout);
  GatherBatch(const GatherBatch&) = delete;
  GatherBatch& operator=(const GatherBatch&) = delete;

  // Returns whether the gathers of the full picture with this number of samples a pixel fit into
  // the memory. A crop does not change the answer.
  static bool Fits(const PixelBounds& full, std::int64_t samplesPerPixel, double memory);

  std::int64_t SamplesPerPixel() const { return samples_; }

  // Adds a pass whose film and AOVs have no light of gathers. They receive the difference between
  // the light of all gathers and the light that earlier passes received.
  void AddPass(const GatherFragments& gathers, std::int64_t samplesPerPixel, ThreadPool* threads,
               Film* film, AovFilm* aovs);

  // These are results for all passes of the batch.
  double MeanRadius() const { return totals_.MeanRadius(); }  // of the windows, in pixels
  // Estimates the bias anew with each call, which takes nearly as long as a fit. Needs a pass.
  std::optional<SharingBias> Bias(ThreadPool* threads);
  // Frees the memory of the last fit, which Bias can use.
  void ForgetFit() { shared_.reset(); }

  static bool IsIn(const StateFile& file) { return file.Has(kSection); }
  void Save(StateWriter* writer);
  void Load(const StateFile& file, ThreadPool* threads);

 private:
  static constexpr const char* kSection = "batch";

  void Transfer(ByteArchive* archive);
  void TransferRow(ByteArchive* archive, int y);
  void FitLight(ThreadPool* threads);

  PixelBounds window_;
  const SplatWeights* splatWeights_;
  GatherFragments gathers_;
  std::optional<SharedGathers> shared_;  // the last fit; it refers to gathers_
  std::int64_t samples_ = 0;
  Film own_;    // the passes without the light of gathers
  Film light_;  // the light of all gathers
  std::unique_ptr<AovFilm> lightAovs_;
  SharingTotals totals_;
};

}  // namespace exphoton
