// SPDX-License-Identifier: BSD-2-Clause
// PassBuffers: the windows of pixels, and the order in which the light of a pass is completed.
#include "core/render/pass_buffers.h"

namespace exphoton {
namespace {

PixelBounds Window(const PassBuffers::Layout& layout, const Film& film) {
  const PixelBounds& crop = film.Crop();
  const int reach = layout.splatWeights ? layout.splatWeights->Reach() : 0;
  return {crop.x0 - reach, crop.y0 - reach, crop.x1 + reach, crop.y1 + reach};
}

}  // namespace

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
                   layout.sharingMemory);
}

void PassBuffers::AddSharedLight(ThreadPool* threads, Statistics* statistics) {
  const PhaseTimer timer(*statistics, "share");
  bands_->AddLight(threads, {film_, aovs_, Splats(), bands_->Current().window,
                             double(layout_.samplesPerPixel), layout_.corrections});
}

std::optional<SharingBias> PassBuffers::Finish(Statistics* statistics) {
  if (bands_)
    statistics->SetCounter("render/sharing radius", bands_->Totals().MeanRadius(),
                           "pixels, mean radius of the windows of shared gathers");
  if (splats_) splats_->Finish();
  return bands_ ? EstimateSharingBias(bands_->Totals().checked, *film_) : std::nullopt;
}

}  // namespace exphoton
