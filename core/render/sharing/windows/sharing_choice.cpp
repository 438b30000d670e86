// SPDX-License-Identifier: BSD-2-Clause
// SharingChoice: first the windows, then the shares of their fits.
#include "core/render/sharing/windows/sharing_choice.h"

namespace exphoton {
namespace {

SharingWindows WindowsOf(const GatherFragments& gathers, const FragmentRows& rows, double area,
                         ThreadPool* threads) {
  SharingWindows windows(gathers, rows, threads);
  windows.Shrink(area);
  return windows;
}

PixelBounds RegionOf(const PixelBounds& window) {
  constexpr int kReach = SharingShares::kReach;
  return {window.x0 - kReach, window.y0 - kReach, window.x1 + kReach, window.y1 + kReach};
}

}  // namespace

SharingChoice::SharingChoice(const GatherFragments& gathers, const FragmentRows& rows,
                             const Request& request, ThreadPool* threads)
    : windows_(WindowsOf(gathers, rows, request.windowArea, threads)),
      fits_({gathers, rows, windows_}, RegionOf(request.window), request.groupOf, threads),
      shares_({gathers, rows, windows_}, fits_, threads) {}

}  // namespace exphoton
