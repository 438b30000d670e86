// SPDX-License-Identifier: BSD-2-Clause
// PassState: each part of the pass is a section of the file.
#include "core/render/state/pass_state.h"

#include "core/render/certificate/corrections.h"
#include "core/render/photon_noise.h"

namespace exphoton {

void PassState::TransferPass(ByteArchive* archive) {
  archive->Same(parts_.pass.preprocessSeed);
  archive->Same(parts_.pass.sampleSeed);
  archive->Same(parts_.pass.firstSample);
  archive->Same(parts_.pass.sampleCount);
  done_.Transfer(archive);
}

void PassState::TransferGathers(ByteArchive* archive) {
  parts_.shared->Transfer(archive);
  GatherFragments& gathers = parts_.shared->Gathers();
  const PixelBounds& window = gathers.Bounds();
  for (int y = window.y0; y < window.y1; ++y)
    for (int x = window.x0; x < window.x1; ++x)
      if (done_.Has({x, y})) gathers.At({x, y}).Transfer(archive);
}

void PassState::Save(StateWriter* writer) {
  writer->AddArchive("pass", [this](ByteArchive* archive) { TransferPass(archive); });
  SaveSection("pass film", *parts_.film, writer);
  if (parts_.aovs) SaveSection("pass aovs", *parts_.aovs, writer);
  if (parts_.splats) SaveSection("pass splats", *parts_.splats, writer);
  if (parts_.shared)
    writer->AddArchive("pass gathers", [this](ByteArchive* archive) { TransferGathers(archive); });
}

void PassState::Load(const StateFile& file) {
  file.Read("pass", [this](ByteArchive* archive) { TransferPass(archive); });
  LoadSection("pass film", parts_.film, file);
  if (parts_.aovs) LoadSection("pass aovs", parts_.aovs, file);
  if (parts_.splats) LoadSection("pass splats", parts_.splats, file);
  if (parts_.shared)
    file.Read("pass gathers", [this](ByteArchive* archive) { TransferGathers(archive); });
  ClearOpenPixels();
}

// A pixel that was being rendered may have some of its samples in the film.
void PassState::ClearOpenPixels() {
  const PixelBounds& crop = parts_.film->Crop();
  for (int y = crop.y0; y < crop.y1; ++y) {
    for (int x = crop.x0; x < crop.x1; ++x) {
      if (done_.Has({x, y})) continue;
      parts_.film->ClearPixel({x, y});
      if (parts_.aovs) parts_.aovs->ClearPixel({x, y});
      if (parts_.pass.photonNoise) parts_.pass.photonNoise->ClearPixel({x, y});
      if (parts_.corrections) parts_.corrections->ClearPixel({x, y});
    }
  }
}

PictureSoFar PassState::Picture(ThreadPool* threads) const {
  PictureSoFar picture{*parts_.film, nullptr, {}};
  if (parts_.aovs) picture.aovs = std::make_unique<AovFilm>(*parts_.aovs);
  std::optional<SplatBuffer> splats;
  if (parts_.splats) splats.emplace(*parts_.splats, &picture.film, picture.aovs.get());
  SplatBuffer* const buffer = splats ? &*splats : nullptr;
  if (parts_.shared)
    SharedGathers(parts_.shared->Gathers(), {parts_.shared->Current().window, parts_.pass.diskArea},
                  threads)
        .AddLight({&picture.film, picture.aovs.get(), buffer, parts_.shared->Current().window,
                   double(parts_.pass.sampleCount)});
  if (buffer) buffer->Finish();
  return picture;
}

}  // namespace exphoton
