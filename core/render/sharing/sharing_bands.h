// SPDX-License-Identifier: BSD-2-Clause
// SharingBands divides the rows of a picture into bands, so that only the gathers of one band and
// of a margin about it are in memory at once. The picture does not depend on the bands.
#pragma once

#include <cstdint>
#include <vector>

#include "core/imaging/image.h"
#include "core/render/sharing/gather_fragments.h"
#include "core/render/sharing/shared_gathers.h"

namespace exphoton {

// The memory for the gathers of several passes, in units of a band's.
constexpr double kBandsOfPasses = 4;

// Returns the pixels whose gathers the window needs. `reach` is the number of pixels that samples
// are splatted over; those beyond the full image count, too.
PixelBounds WithSharingMargin(const PixelBounds& window, const PixelBounds& full, int reach);

struct SharingBand {
  PixelBounds window;    // the pixels that get their light
  PixelBounds gathered;  // the pixels whose gathers they need
};

// `window` holds all pixels that get light, `gathered` all pixels whose gathers they need. The
// gathers of a band take about `memory` bytes, if 16 rows beside the margins need no more.
std::vector<SharingBand> PlanBands(const PixelBounds& window, const PixelBounds& gathered,
                                   std::int64_t samplesPerPixel, double memory);

// SharingBands goes through the bands of one pass, from the top to the bottom.
class SharingBands {
 public:
  // Arguments are those of PlanBands.
  SharingBands(const PixelBounds& window, const PixelBounds& gathered, std::int64_t samplesPerPixel,
               double memory);

  GatherFragments& Gathers() { return gathers_; }  // of the current band; the address stays
  bool IsAtEnd() const { return current_ == bands_.size(); }
  const SharingBand& Current() const { return bands_[current_]; }

  // Adds the light of the current band to the picture, with windows of this relative area.
  void AddLight(ThreadPool* threads, double windowArea, const SharedLightTarget& target);
  void GoToNext();

  const SharingTotals& Totals() const { return totals_; }
  // Saves or loads the number of the current band and the totals, but not the gathers.
  void Transfer(ByteArchive* archive);

 private:
  std::vector<SharingBand> bands_;
  GatherFragments gathers_;
  std::size_t current_ = 0;
  SharingTotals totals_;
};

}  // namespace exphoton
