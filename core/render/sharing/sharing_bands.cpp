// SPDX-License-Identifier: BSD-2-Clause
// SharingBands: bands of equal height.
#include "core/render/sharing/sharing_bands.h"

#include <algorithm>

#include "core/files/byte_archive.h"

namespace exphoton {
namespace {

constexpr int kMinRows = 16;

}  // namespace

PixelBounds WithSharingMargin(const PixelBounds& window, const PixelBounds& full, int reach) {
  const int margin = SharingMargin();
  return {
      std::max(window.x0 - margin, full.x0 - reach), std::max(window.y0 - margin, full.y0 - reach),
      std::min(window.x1 + margin, full.x1 + reach), std::min(window.y1 + margin, full.y1 + reach)};
}

std::vector<SharingBand> PlanBands(const PixelBounds& window, const PixelBounds& gathered,
                                   std::int64_t samplesPerPixel, double memory) {
  const double row = GatherFragments::BytesPerPixel(samplesPerPixel) * gathered.Width();
  const int margin = SharingMargin();
  const double affordable = memory / std::max(row, 1.) - 2 * margin;
  const int rows = int(std::clamp(affordable, double(kMinRows),
                                  std::max(double(window.Height()), double(kMinRows))));
  std::vector<SharingBand> bands;
  for (int y = window.y0; y < window.y1; y += rows) {
    SharingBand band{window, gathered};
    band.window.y0 = y;
    band.window.y1 = std::min(y + rows, window.y1);
    band.gathered.y0 = std::max(y - margin, gathered.y0);
    band.gathered.y1 = std::min(band.window.y1 + margin, gathered.y1);
    bands.push_back(band);
  }
  return bands;
}

SharingBands::SharingBands(const PixelBounds& window, const PixelBounds& gathered,
                           std::int64_t samplesPerPixel, double memory)
    : bands_(PlanBands(window, gathered, samplesPerPixel, memory)),
      gathers_(bands_.front().gathered, samplesPerPixel) {}

void SharingBands::AddLight(ThreadPool* threads, double windowArea,
                            const SharedLightTarget& target) {
  // The picture with and without sharing shows the bias without checks.
  const SharedGathers shared(gathers_, {target.window, windowArea, !target.change}, threads);
  totals_.Add(shared.AddLight(target));
}

void SharingBands::GoToNext() {
  ++current_;
  if (!IsAtEnd()) gathers_.MoveDown(Current().gathered.y0, Current().gathered.y1);
}

void SharingBands::Transfer(ByteArchive* archive) {
  std::uint64_t current = current_;
  archive->Values(&current);
  totals_.Transfer(archive);
  if (current >= bands_.size()) throw ArchiveError("the picture has fewer bands");
  current_ = std::size_t(current);
  gathers_.MoveDown(Current().gathered.y0, Current().gathered.y1);
}

}  // namespace exphoton
