// SPDX-License-Identifier: BSD-2-Clause
// SharedGathers adds diffuse indirect light to a picture after all its pixels are rendered.
// Neighbouring pixels on one surface gather nearly the same light, so each camera sample takes a
// part of its light from a local fit to the gathers around it. The folder windows/ chooses how far
// the fits reach, and how large this part is. docs/decisions/0033-shared-gathers.md has the
// measurements.
#pragma once

#include <optional>
#include <vector>

#include "core/base/parallel.h"
#include "core/imaging/film/aov_film.h"
#include "core/imaging/film/film.h"
#include "core/render/sharing/fragment_rows.h"
#include "core/render/sharing/gather_fragments.h"
#include "core/render/sharing/sharing_bias.h"
#include "core/render/sharing/windows/sharing_choice.h"
#include "core/render/splat_buffer.h"

namespace exphoton {

class Corrections;
struct SharingChange;

// The light of a pixel depends on the gathers within this number of pixels.
int SharingMargin();

// Adds the light of the gathers in the window to the film and to the AOVs, if they are not null. If
// `splats` is not null, it receives the light instead.
struct SharedLightTarget {
  Film* film;
  AovFilm* aovs;
  SplatBuffer* splats;
  PixelBounds window;
  double samplesPerPixel;
  Corrections* corrections = nullptr;  // receives own light minus shared light; null: none
  SharingChange* change = nullptr;     // receives shared light minus own light; needs no splats
};
// SharingTotals adds up the radii of the windows over the fragments, in pixels, and collects the
// checked pixels if they are wanted.
struct SharingTotals {
  double radii = 0, fragments = 0;
  std::vector<CheckedPixel> checked;
  void Add(const SharingTotals& other) {
    radii += other.radii;
    fragments += other.fragments;
    checked.insert(checked.end(), other.checked.begin(), other.checked.end());
  }
  void Transfer(ByteArchive* archive);  // saves or loads
  double MeanRadius() const { return fragments > 0 ? radii / fragments : 0; }
};

// Adds the light of the gathers as it is, without sharing. `target` has a film and no splats.
void AddOwnLight(const GatherFragments& gathers, const SharedLightTarget& target,
                 ThreadPool* threads);

struct SharingRequest {
  PixelBounds window;      // the pixels that get their light
  double windowArea = 1;   // as in SharingChoice::Request
  bool isChecked = false;  // whether the totals have the results of Check
};

// The gathers, the threads and a choice that is passed must outlive this object.
class SharedGathers {
 public:
  SharedGathers(const GatherFragments& gathers, const SharingRequest& request, ThreadPool* threads);

  // Shares in `window` as other gathers have chosen.
  SharedGathers(const GatherFragments& gathers, const SharingChoice& choice,
                const PixelBounds& window, ThreadPool* threads);
  SharedGathers(const SharedGathers&) = delete;
  SharedGathers& operator=(const SharedGathers&) = delete;

  // Returns the radii of the windows, and the checked pixels if they are wanted. The window of the
  // target must be the one of this object.
  SharingTotals AddLight(const SharedLightTarget& target) const;
  // Returns what EstimateSharingBias needs. It collects the neighbours of three pixels of four
  // again and fits their light. A request that is checked does it with the neighbours at hand, at
  // half of this cost.
  std::vector<CheckedPixel> Check(const PixelBounds& window, double samplesPerPixel) const;

 private:
  // Fills the differences of the row if they are not null.
  SharingTotals AddRow(const SharedLightTarget& target, int y, PixelDifferences* differences,
                       FitNeighbours* scratch) const;
  SharingChecker CheckerOf(double samplesPerPixel) const;
  std::vector<CheckedPixel> CheckRows(const PixelBounds& window, double samplesPerPixel,
                                      const PixelDifferences* known) const;

  const GatherFragments& gathers_;
  ThreadPool* threads_;
  FragmentRows rows_;
  std::optional<SharingChoice> own_;  // if these gathers have chosen
  const SharingChoice& choice_;
  std::optional<FragmentFits> others_;  // fits to these gathers, if others have chosen
  const FragmentFits& fits_;
  bool isChecked_ = false;
};

}  // namespace exphoton
