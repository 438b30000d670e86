// SPDX-License-Identifier: BSD-2-Clause
// PassBuffers holds what a pass needs beside its film: the sums of splatted samples, and the
// gathers that neighbouring pixels share. A render fills them with samples, and a merge with the
// sums of several processes.
#pragma once

#include <optional>

#include "core/base/parallel.h"
#include "core/base/statistics.h"
#include "core/render/sharing/passes/gather_batch.h"
#include "core/render/sharing/sharing_bands.h"
#include "core/render/sharing/sharing_estimate.h"
#include "core/render/splat_buffer.h"

namespace exphoton {

class PassBuffers {
 public:
  struct Layout {
    const SplatWeights* splatWeights = nullptr;  // null: samples are not splatted
    bool isShared = false;                       // whether pixels share gathers
    std::int64_t samplesPerPixel = 1;
    double sharingMemory = 0x1p28;       // as in RenderOptions
    GatherBatch* batch = nullptr;        // receives the gathers; null: the pass shares its own
    Corrections* corrections = nullptr;  // as in RenderOptions
    double diskArea = 1;                 // as in RenderPass
    SharingChange* change = nullptr;     // as RenderOptions::sharingChange
    GatherFragments* gathers = nullptr;  // as RenderPass::gathers
  };
  // Returns the pixels to render: those whose samples or gathers reach the film's crop window.
  static PixelBounds Rendered(const Layout& layout, const Film& film);
  // Returns the pixels that get the light of gathers.
  static PixelBounds Window(const Layout& layout, const Film& film);

  // The film and the AOVs (null: none) receive the light. All arguments must outlive this object.
  PassBuffers(const Layout& layout, Film* film, AovFilm* aovs);

  SplatBuffer* Splats() { return splats_ ? &*splats_ : nullptr; }
  SharingBands* Bands() { return bands_ ? &*bands_ : nullptr; }
  GatherFragments* Gathers() { return bands_ ? &bands_->Gathers() : nullptr; }

  // Adds the shared light of the current band of rows to the picture, unless there is a batch. A
  // whole pass whose gathers the caller receives gets their own light.
  void AddSharedLight(bool isWhole, ThreadPool* threads, Statistics* statistics);
  // Completes the film. Returns the estimate for shared gathers, if there is one. A batch has one
  // of its own.
  std::optional<SharingBias> Finish(ThreadPool* threads, Statistics* statistics);

 private:
  Layout layout_;
  Film* film_;
  AovFilm* aovs_;
  std::optional<SplatBuffer> splats_;
  std::optional<SharingBands> bands_;
};

}  // namespace exphoton
