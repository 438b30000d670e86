// SPDX-License-Identifier: BSD-2-Clause
// WindowFit: a fit, except for details.
#include "core/render/sharing/windows/window_fit.h"

#include <algorithm>

#include "core/render/sharing/windows/squared_difference.h"

namespace exphoton {
namespace {

// Returns whether the light of a group differs from a fit by more than its noise, and not against
// this direction.
bool StandsOut(const GatherFragment& fragment, int group, const Spectrum& fit,
               const Spectrum& direction, Real noise) {
  constexpr double kDeviations = 3;
  const Spectrum own = fragment.Mean(group), both = (own - fit) * direction;
  // Brighter light has more noise, so the brighter one of both counts.
  const double variance =
      double(noise) *
      std::max(SquaredDifference(fit, Spectrum()), SquaredDifference(own, Spectrum())) /
      double(fragment.count[std::size_t(group)]);
  return noise > 0 && both[0] + both[1] + both[2] > 0 &&
         SquaredDifference(own, fit) > kDeviations * kDeviations * variance;
}

}  // namespace

WindowFit::WindowFit(const FragmentRows& rows, const SharingWindows& windows, const Place& place,
                     FitNeighbours* scratch)
    : fragment_(place.fragment),
      target_(place.fragment),
      window_(windows.At(place.pixel, target_, scratch)),
      neighbours_(*scratch) {
  if (window_.share > 0) LocalFit::Collect(rows, {target_, place.pixel, window_.radius}, scratch);
}

std::optional<LocalFit> WindowFit::To(FragmentRows::Column set) const {
  if (!(window_.share > 0)) return std::nullopt;
  const LocalFit fit(neighbours_, window_.radius, set);
  if (IsDetail(fit.AtTarget())) return std::nullopt;
  return fit;
}

Spectrum WindowFit::Difference(int group) const {
  const auto fitted = To(FragmentRows::OfGroup(group));
  return fitted ? fitted->AtTarget() - fragment_.Mean(group) : Spectrum();
}

bool WindowFit::IsDetail(const Spectrum& fit) const {
  const Real noise = window_.noise;
  if (!fragment_.HasGroup(kChoosingGroups[0]) || !fragment_.HasGroup(kChoosingGroups[1]))
    return false;
  const Spectrum direction = fragment_.Mean(kChoosingGroups[0]) - fit;
  for (int group = 0; group < kGatherGroups; ++group)
    if (fragment_.HasGroup(group) && !StandsOut(fragment_, group, fit, direction, noise))
      return false;
  for (std::size_t set = 0; set < 2; ++set) {
    const LocalFit other(neighbours_, window_.radius, FragmentRows::OfGroup(kChoosingGroups[set]));
    if (!StandsOut(fragment_, kChoosingGroups[1 - set], other.AtTarget(), direction, noise))
      return false;
  }
  return true;
}

}  // namespace exphoton
