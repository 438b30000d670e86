// SPDX-License-Identifier: BSD-2-Clause
// PassBuffers: the windows of pixels, and the order in which the light of a pass is completed.
#include "core/render/pass_buffers.h"

#include <limits>
#include <utility>

#include "core/render/render_totals.h"

namespace exphoton {
namespace {

constexpr double kOneBand = std::numeric_limits<double>::infinity();

}  // namespace

PixelBounds PassBuffers::Window(const Layout& layout, const Film& film) {
  const PixelBounds& crop = film.Crop();
  const int reach = layout.splatWeights ? layout.splatWeights->Reach() : 0;
  return {crop.x0 - reach, crop.y0 - reach, crop.x1 + reach, crop.y1 + reach};
}

PixelBounds PassBuffers::Rendered(const Layout& layout, const Film& film) {
  const PixelBounds window = Window(layout, film);
  if (!layout.isShared) return window;
  return WithSharingMargin(window, film.Full(),
                           layout.splatWeights ? layout.splatWeights->Reach() : 0);
}

PassBuffers::PassBuffers(const Layout& layout, Film* film, AovFilm* aovs)
    : layout_(layout), film_(film), aovs_(aovs) {
  if (layout.splatWeights) splats_.emplace(*layout.splatWeights, film, aovs);
  if (layout.isShared)
    bands_.emplace(Window(layout, *film), Rendered(layout, *film), layout.samplesPerPixel,
                   layout.batch || layout.gathers ? kOneBand : layout.sharingMemory);
}

void PassBuffers::AddSharedLight(bool isWhole, ThreadPool* threads, Statistics* statistics) {
  if (layout_.batch) return;
  const PhaseTimer timer(*statistics, "share");
  const SharedLightTarget target{film_,
                                 aovs_,
                                 Splats(),
                                 bands_->Current().window,
                                 double(layout_.samplesPerPixel),
                                 layout_.corrections,
                                 layout_.change};
  if (layout_.gathers && isWhole)
    AddOwnLight(bands_->Gathers(), target, threads);
  else
    bands_->AddLight(threads, layout_.diskArea, target);
}

std::optional<SharingBias> PassBuffers::Finish(ThreadPool* threads, Statistics* statistics) {
  if (splats_) splats_->Finish();
  if (!bands_) return std::nullopt;
  GatherBatch* const batch = layout_.batch;
  if (batch) {
    const PhaseTimer timer(*statistics, "share");
    batch->AddPass(bands_->Gathers(), layout_.samplesPerPixel, threads, film_, aovs_);
  }
  if (layout_.gathers) {
    *layout_.gathers = std::move(bands_->Gathers());
    return std::nullopt;
  }
  SetSharingRadius(batch ? batch->MeanRadius() : bands_->Totals().MeanRadius(), statistics);
  return batch ? std::nullopt : EstimateSharingBias(bands_->Totals().checked, *film_);
}

}  // namespace exphoton
