// SPDX-License-Identifier: BSD-2-Clause
// GatherBatch: the light of all gathers replaces the light of the gathers before.
#include "core/render/sharing/passes/gather_batch.h"

#include <string>

#include "core/files/byte_archive.h"

namespace exphoton {
namespace {

std::string RowSection(int y) { return "batch gathers of row " + std::to_string(y); }

}  // namespace

GatherBatch::GatherBatch(const Layout& layout)
    : window_(layout.window),
      splatWeights_(layout.splatWeights),
      gathers_(layout.gathered, 0),
      own_(layout.film.Full(), layout.film.Crop()),
      light_(own_) {
  if (layout.aovs)
    lightAovs_ = std::make_unique<AovFilm>(layout.aovs->Crop(), layout.aovs->Wanted());
}

bool GatherBatch::Fits(const PixelBounds& full, std::int64_t samplesPerPixel, double memory) {
  const double pixels = double(full.Width()) * full.Height();
  return pixels * GatherFragments::BytesPerPixel(samplesPerPixel) <= memory;
}

void GatherBatch::AddPass(const GatherFragments& gathers, std::int64_t samplesPerPixel,
                          ThreadPool* threads, Film* film, AovFilm* aovs) {
  ForgetFit();
  own_.Add(*film);
  samples_ += samplesPerPixel;
  const PixelBounds& bounds = gathers_.Bounds();
  threads->For(bounds.Height(), [&](std::int64_t row, int) {
    for (int x = bounds.x0; x < bounds.x1; ++x) {
      const Point2i pixel{x, bounds.y0 + int(row)};
      gathers_.At(pixel).Join(gathers.At(pixel));
    }
  });
  film->SubtractLight(light_);
  if (aovs) aovs->SubtractLight(*lightAovs_);
  FitLight(threads);
  film->Add(light_);
  if (aovs) aovs->Add(*lightAovs_);
}

void GatherBatch::FitLight(ThreadPool* threads) {
  light_.Clear();
  if (lightAovs_) lightAovs_->Clear();
  std::optional<SplatBuffer> splats;
  if (splatWeights_) splats.emplace(*splatWeights_, &light_, lightAovs_.get());
  SplatBuffer* const buffer = splats ? &*splats : nullptr;
  shared_.emplace(gathers_, SharingRequest{window_}, threads);
  totals_ = shared_->AddLight({&light_, lightAovs_.get(), buffer, window_, double(samples_)});
  if (buffer) buffer->Finish();
}

std::optional<SharingBias> GatherBatch::Bias(ThreadPool* threads) {
  if (!shared_) shared_.emplace(gathers_, SharingRequest{window_}, threads);
  Film picture = own_;
  picture.Add(light_);
  return EstimateSharingBias(shared_->Check(window_, double(samples_)), picture);
}

void GatherBatch::Transfer(ByteArchive* archive) {
  const PixelBounds& bounds = gathers_.Bounds();
  for (const int edge : {bounds.x0, bounds.y0, bounds.x1, bounds.y1}) archive->Same(edge);
  archive->Values(&samples_);
  if (samples_ < 1) throw ArchiveError("a batch has no samples");
  own_.Transfer(archive);
}

void GatherBatch::TransferRow(ByteArchive* archive, int y) {
  for (int x = gathers_.Bounds().x0; x < gathers_.Bounds().x1; ++x)
    gathers_.At({x, y}).Transfer(archive);
}

void GatherBatch::Save(StateWriter* writer) {
  if (samples_ == 0) return;
  writer->AddArchive(kSection, [this](ByteArchive* archive) { Transfer(archive); });
  for (int y = gathers_.Bounds().y0; y < gathers_.Bounds().y1; ++y)
    writer->AddArchive(RowSection(y), [&](ByteArchive* archive) { TransferRow(archive, y); });
}

void GatherBatch::Load(const StateFile& file, ThreadPool* threads) {
  file.Read(kSection, [this](ByteArchive* archive) { Transfer(archive); });
  for (int y = gathers_.Bounds().y0; y < gathers_.Bounds().y1; ++y)
    file.Read(RowSection(y), [&](ByteArchive* archive) { TransferRow(archive, y); });
  FitLight(threads);
}

}  // namespace exphoton
